// SPDX-License-Identifier: MIT
#include "beam_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include <base/ids.h>

#include "common/model_values.h"

namespace meshrepair {
namespace {

BeamCap cap_of(std::string_view word, BeamCap otherwise) {
  if (word == "sphere") return BeamCap::sphere;
  if (word == "hemisphere") return BeamCap::hemisphere;
  return word == "butt" ? BeamCap::butt : otherwise;
}

// Of the extension's own attributes; those of balls are of an extension of it.
std::string_view plain_name(std::string_view name) { return name.substr(name.rfind('|') + 1); }

}  // namespace

BeamLattice read_lattice(const XmlAttributes& attributes) {
  BeamLattice lattice;
  attributes.visit([&](std::string_view full_name, std::string_view value) {
    const std::string_view name = plain_name(full_name);
    if (name == "radius") (void)read_model_number(value, lattice.radius);
    if (name == "minlength") (void)read_model_number(value, lattice.shortest);
    if (name == "ballradius") (void)read_model_number(value, lattice.ball_radius);
    if (name == "ballmode") {
      lattice.has_ball_everywhere = value == "all";
      lattice.has_balls = value == "all" || value == "mixed";
    }
    if (name == "cap") lattice.cap = cap_of(value, BeamCap::sphere);
    if (name == "clippingmode") lattice.is_clipped = value != "none";
  });
  return lattice;
}

Beam read_beam(const XmlAttributes& attributes, const BeamLattice& lattice) {
  Beam beam{{kNone, kNone}, {lattice.radius, lattice.radius}, {lattice.cap, lattice.cap}};
  bool has_second = false;
  attributes.visit([&](std::string_view name, std::string_view value) {
    if (name == "v1") beam.points[0] = read_model_index(value);
    if (name == "v2") beam.points[1] = read_model_index(value);
    if (name == "r1") {
      (void)read_model_number(value, beam.radii[0]);
      if (!has_second) beam.radii[1] = beam.radii[0];
    }
    if (name == "r2") has_second = read_model_number(value, beam.radii[1]);
    if (name == "cap1") beam.caps[0] = cap_of(value, lattice.cap);
    if (name == "cap2") beam.caps[1] = cap_of(value, lattice.cap);
  });
  return beam;
}

BeamBall read_ball(const XmlAttributes& attributes, const BeamLattice& lattice) {
  BeamBall ball{kNone, lattice.ball_radius};
  attributes.visit([&](std::string_view name, std::string_view value) {
    if (name == "vindex") ball.point = read_model_index(value);
    if (name == "r") (void)read_model_number(value, ball.radius);
  });
  return ball;
}

namespace {

using Direction = std::array<double, 2>;  // cosine and sine

// By their series, whose sums are the same on every system; the angle is at most a fourth of pi.
Direction direction_near_zero(double angle) {
  constexpr int kTerms = 18;
  Direction sums = {1, 0};
  double term = 1;
  for (int i = 1; i <= kTerms; ++i) {
    term *= angle / i;
    sums[static_cast<std::size_t>(i % 2)] += i % 4 < 2 ? term : -term;
  }
  return sums;
}

// Of `count` corners evenly around; those of mirrored angles mirror each other bit for bit.
std::vector<Direction> circle_of(std::size_t count) {
  std::vector<Direction> circle(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::size_t eighths = 8 * k;  // of the angle, times count
    const std::size_t quarter = eighths / (2 * count);
    eighths -= quarter * 2 * count;
    const bool is_mirrored = eighths > count;
    if (is_mirrored) eighths = 2 * count - eighths;
    auto [x, y] = direction_near_zero(std::numbers::pi / 4 * static_cast<double>(eighths) /
                                      static_cast<double>(count));
    if (is_mirrored) std::swap(x, y);
    for (std::size_t turn = 0; turn < quarter; ++turn) std::tie(x, y) = std::tuple(-y, x);
    circle[k] = {x, y};
  }
  return circle;
}

std::size_t stacks_of(std::size_t sides) { return std::max<std::size_t>(2, (sides + 1) / 2); }

// Makes closed bodies of rings around an axis.
class RoundBodies {
 public:
  RoundBodies(std::size_t sides, TriangleSoup& mesh)
      : mesh_(mesh), circle_(circle_of(sides)), meridian_(circle_of(2 * stacks_of(sides))) {}

  void add_ball(const Vec3d& centre, double radius) {
    axes_.setIdentity();
    begin_at(centre - radius * axes_.col(2));
    for (std::size_t j = stacks() - 1; j > 0; --j) {
      add_ring(centre + radius * meridian_[j][0] * axes_.col(2), radius * meridian_[j][1]);
    }
    end_at(centre + radius * axes_.col(2));
  }

  void add_beam(const Vec3d& from, const Vec3d& to, const Beam& beam) {
    turn_along(to - from);
    if (beam.caps[0] == BeamCap::hemisphere) {
      begin_at(from - beam.radii[0] * axes_.col(2));
      for (std::size_t j = stacks() - 1; 2 * j > stacks(); --j) add_arc(from, beam.radii[0], j);
      add_ring(from, beam.radii[0]);
    } else {
      begin_flat(from, beam.radii[0]);
    }
    add_ring(to, beam.radii[1]);
    if (beam.caps[1] != BeamCap::hemisphere) return end_flat();
    for (std::size_t j = (stacks() - 1) / 2; j > 0; --j) add_arc(to, beam.radii[1], j);
    end_at(to + beam.radii[1] * axes_.col(2));
  }

 private:
  [[nodiscard]] std::size_t stacks() const { return meridian_.size() / 2; }
  [[nodiscard]] auto sides() const { return static_cast<std::uint32_t>(circle_.size()); }

  void turn_along(const Vec3d& axis) {
    axes_.col(2) = axis.normalized();
    Eigen::Index least = 0;
    axes_.col(2).cwiseAbs().minCoeff(&least);
    axes_.col(0) = axes_.col(2).cross(Vec3d::Unit(least)).normalized();
    axes_.col(1) = axes_.col(2).cross(axes_.col(0));
  }

  std::uint32_t add_point(const Vec3d& point) {
    mesh_.points.push_back(point);
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
  }

  void begin_at(const Vec3d& pole) {
    last_ = add_point(pole);
    is_pole_ = true;
  }

  void begin_flat(const Vec3d& centre, double radius) {
    last_ = append_ring(centre, radius);
    is_pole_ = false;
    for (std::uint32_t k = 2; k < sides(); ++k)
      mesh_.triangles.push_back({last_, last_ + k, last_ + k - 1});
  }

  void end_flat() {
    for (std::uint32_t k = 2; k < sides(); ++k)
      mesh_.triangles.push_back({last_, last_ + k - 1, last_ + k});
  }

  void end_at(const Vec3d& pole) {
    const std::uint32_t top = add_point(pole);
    for (std::uint32_t k = 0; k < sides(); ++k)
      mesh_.triangles.push_back({last_ + k, last_ + (k + 1) % sides(), top});
  }

  void add_arc(const Vec3d& centre, double radius, std::size_t j) {
    add_ring(centre + radius * meridian_[j][0] * axes_.col(2), radius * meridian_[j][1]);
  }

  std::uint32_t append_ring(const Vec3d& centre, double radius) {
    const auto first = static_cast<std::uint32_t>(mesh_.points.size());
    for (const auto& [x, y] : circle_) {
      mesh_.points.emplace_back(centre + radius * (x * axes_.col(0) + y * axes_.col(1)));
    }
    return first;
  }

  // And the triangles from the last one to it.
  void add_ring(const Vec3d& centre, double radius) {
    const std::uint32_t ring = append_ring(centre, radius);
    for (std::uint32_t k = 0; k < sides(); ++k) {
      const std::uint32_t next = (k + 1) % sides();
      if (is_pole_) {
        mesh_.triangles.push_back({last_, ring + next, ring + k});
      } else {
        mesh_.triangles.push_back({last_ + k, last_ + next, ring + next});
        mesh_.triangles.push_back({last_ + k, ring + next, ring + k});
      }
    }
    last_ = ring;
    is_pole_ = false;
  }

  TriangleSoup& mesh_;
  std::vector<Direction> circle_;
  std::vector<Direction> meridian_;  // from the top
  Eigen::Matrix3d axes_;
  std::uint32_t last_ = 0;  // the first point of the last ring
  bool is_pole_ = false;
};

bool is_size(double radius) { return radius > 0 && std::isfinite(radius); }

// Each once, whatever beams end there.
void add_balls(std::vector<BeamBall> balls, RoundBodies& bodies, const std::vector<Vec3d>& points) {
  std::sort(balls.begin(), balls.end(), [](const BeamBall& a, const BeamBall& b) {
    return std::tie(a.point, a.radius) < std::tie(b.point, b.radius);
  });
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const bool is_larger_there = i + 1 < balls.size() && balls[i + 1].point == balls[i].point;
    if (!is_larger_there) bodies.add_ball(Vec3d(points[balls[i].point]), balls[i].radius);
  }
}

}  // namespace

std::size_t most_triangles_of(const BeamLattice& lattice, std::size_t sides) {
  const std::size_t of_ball = 2 * sides * stacks_of(sides);
  return lattice.beams.size() * (2 * sides + of_ball) +
         (2 * lattice.beams.size() + lattice.balls.size()) * of_ball;
}

std::size_t append_lattice(const BeamLattice& lattice, std::size_t sides, TriangleSoup& mesh) {
  const std::size_t points = mesh.points.size();
  const auto is_there = [&](std::uint32_t p) { return p < points && mesh.points[p].allFinite(); };
  RoundBodies bodies(sides, mesh);
  std::vector<BeamBall> balls;
  std::vector<std::uint32_t> ends;
  std::size_t bad = 0;
  for (Beam beam : lattice.beams) {
    const auto [from, to] = beam.points;
    if (!is_there(from) || !is_there(to) || !is_size(beam.radii[0]) || !is_size(beam.radii[1])) {
      ++bad;
      continue;
    }
    const Vec3d a = mesh.points[from], b = mesh.points[to];
    if (a == b || (b - a).norm() < lattice.shortest) continue;
    for (std::size_t end = 0; end < 2; ++end) {
      // Of a cylinder they are the same.
      if (beam.caps[end] == BeamCap::hemisphere && beam.radii[0] == beam.radii[1])
        beam.caps[end] = BeamCap::sphere;
      if (beam.caps[end] == BeamCap::sphere) balls.push_back({beam.points[end], beam.radii[end]});
      ends.push_back(beam.points[end]);
    }
    bodies.add_beam(a, b, beam);
  }
  std::vector<char> has_own(points, 0);
  for (const BeamBall& ball : lattice.balls) {
    if (!lattice.has_balls) break;
    if (!is_there(ball.point) || !is_size(ball.radius)) {
      ++bad;
      continue;
    }
    has_own[ball.point] = 1;
    balls.push_back(ball);
  }
  if (lattice.has_ball_everywhere && is_size(lattice.ball_radius)) {
    for (const std::uint32_t point : ends) {
      if (has_own[point] == 0) balls.push_back({point, lattice.ball_radius});
    }
  }
  add_balls(std::move(balls), bodies, mesh.points);
  return bad;
}

}  // namespace meshrepair
