// SPDX-License-Identifier: MIT
#include "models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "shapes.h"
#include "tubes.h"

namespace meshrepair::bench {
namespace {

using testing::append;
using testing::box;
using testing::moved;
using testing::Random;
using testing::sphere;
using testing::transformed;

constexpr double kTurn = 2 * std::numbers::pi;

TriangleSoup ellipsoid(const Vec3d& centre, const Vec3d& radii, std::size_t triangles) {
  return moved(transformed(sphere(triangles), radii.asDiagonal().toDenseMatrix()), centre);
}

// From a point inside one part to a point inside another, sagging a little.
Strand rope(const Vec3d& from, const Vec3d& to, double radius, double sag, std::size_t pieces) {
  Strand strand{{}, radius};
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(pieces);
    strand.line.push_back((1 - t) * from + t * to - Vec3d(0, 0, 4 * sag * t * (1 - t)));
  }
  return strand;
}

void add_strands(Model& model, std::uint32_t sides) {
  for (const Strand& strand : model.strands) {
    append(model.soup, tube(strand.line, strand.radius, sides));
  }
}

TriangleSoup leg(const Vec3d& hip, const Vec3d& knee, const Vec3d& foot, double radius,
                 std::size_t pieces, std::uint32_t sides) {
  std::vector<Vec3d> line;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(pieces);
    line.push_back((1 - t) * (1 - t) * hip + 2 * t * (1 - t) * knee + t * t * foot);
  }
  return tube(line, radius, sides);
}

}  // namespace

TriangleSoup bumpy(TriangleSoup soup, double height, std::uint64_t seed) {
  Random random(seed);
  std::array<Vec3d, 12> waves;
  for (Vec3d& wave : waves) {
    wave = {random.real(-9, 9), random.real(-9, 9), random.real(-9, 9)};
  }
  for (Vec3d& p : soup.points) {
    double sum = 0;
    for (const Vec3d& wave : waves) sum += std::sin(wave.dot(p) + wave.x());
    p *= 1 + height * sum / static_cast<double>(waves.size());
  }
  return soup;
}

Model spider() {
  Model model{"spider", "Spider", ellipsoid({0, 0, 1}, {1.3, 0.9, 0.8}, 1000), {}};
  append(model.soup, ellipsoid({1.7, 0.02, 0.9}, {0.7, 0.6, 0.5}, 600));
  for (int i = 0; i < 8; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    const int pair = i / 2;
    const double along = 0.5 * pair + 0.3;
    const Vec3d hip(along, 0.2 * side, 1);
    append(model.soup, leg(hip, hip + Vec3d(along - 1, 2 * side, 2.5),
                           hip + Vec3d(2 * along - 2, 3 * side, -1.2), 0.09, 21, 10));
  }
  return model;
}

Model turtle() {
  Model model{"turtle", "Turtle", ellipsoid({0, 0, 0.6}, {1.5, 1.2, 0.6}, 3200), {}};
  append(model.soup, ellipsoid({1.6, 0.01, 0.7}, {0.5, 0.3, 0.3}, 700));
  append(model.soup, ellipsoid({-1.6, 0.02, 0.4}, {0.4, 0.1, 0.1}, 150));
  for (const double x : {-1.0, 0.95}) {
    for (const double y : {-0.9, 0.92}) {
      append(model.soup, ellipsoid({x, y, 0.35}, {0.55, 0.3, 0.25}, 360));
    }
  }
  return model;
}

Model cow() {
  Model model{"cow", "Cow", bumpy(ellipsoid({0, 0, 1.6}, {1.6, 0.7, 0.8}, 2500), 0.04, 3), {}};
  append(model.soup, ellipsoid({1.9, 0.01, 2.2}, {0.6, 0.3, 0.35}, 1000));
  for (const double x : {-1.05, 1.0}) {
    for (const double y : {-0.35, 0.36}) {
      append(model.soup, leg({x, y, 1.5}, {x + 0.1, y, 0.8}, {x, 1.1 * y, 0}, 0.16, 16, 12));
    }
  }
  for (const double y : {-0.2, 0.21}) {
    append(model.soup, leg({1.9, y, 2.4}, {1.9, 2 * y, 2.7}, {2.1, 2.2 * y, 2.9}, 0.05, 12, 8));
  }
  append(model.soup, leg({-1.5, 0, 1.9}, {-2.2, 0.05, 1.7}, {-1.8, 0.1, 0.8}, 0.05, 20, 8));
  return model;
}

Model head() {
  Model model{"head", "David-egea", bumpy(sphere(12000), 0.12, 7), {}};
  append(model.soup, bumpy(ellipsoid({0.02, 0, 0.5}, {0.85, 0.8, 0.75}, 3000), 0.2, 11));
  for (const double y : {-0.35, 0.36}) {
    append(model.soup, ellipsoid({0.85, y, 0.15}, {0.2, 0.18, 0.15}, 500));
  }
  append(model.soup, ellipsoid({0.95, 0.01, -0.1}, {0.25, 0.15, 0.3}, 500));
  return model;
}

// Storeys of legs, beams and braces that run through one another.
Model oil_rig() {
  Model model{"oil rig", "Oil-rig", {}, {}};
  constexpr int kBays = 4;
  const auto joint = [](int x, int y, int z) { return Vec3d(x, y, 1.01 * z); };
  const auto bar = [&](const Vec3d& from, const Vec3d& to, double radius) {
    append(model.soup, tube({from, 0.5 * (from + to), to}, radius, 12));
  };
  for (int x = 0; x <= kBays; ++x) {
    for (int y = 0; y <= kBays; ++y) {
      bar(joint(x, y, 0) - Vec3d(0, 0, 0.3), joint(x, y, kBays) + Vec3d(0, 0, 0.2), 0.09);
      for (int z = 0; z <= kBays; ++z) {
        if (x < kBays) bar(joint(x, y, z), joint(x + 1, y, z), 0.05);
        if (y < kBays) bar(joint(x, y, z), joint(x, y + 1, z), 0.045);
        if (x < kBays && z < kBays) bar(joint(x, y, z), joint(x + 1, y, z + 1), 0.03);
        if (y < kBays && z < kBays) bar(joint(x, y + 1, z), joint(x, y, z + 1), 0.028);
      }
    }
  }
  append(model.soup, box({-0.5, -0.45, 4.1}, {4.55, 4.6, 4.3}));
  append(model.soup, ellipsoid({2, 2, 4.9}, {1.2, 1.1, 0.8}, 8000));
  append(model.soup, ellipsoid({1, 3, 4.6}, {0.6, 0.6, 0.5}, 4000));
  append(model.soup, tube({{3.5, 0.5, 4}, {3.6, 0.4, 6}, {3.9, 0, 7.5}}, 0.15, 40));
  return model;
}

Model ship() {
  Model model{"ship", "Dutch-ship", ellipsoid({0, 0, 0}, {3, 0.8, 0.7}, 4900), {}};
  for (const double x : {-1.6, 0.0, 1.5}) {
    const Vec3d foot(x, 0.01, 0);
    const Vec3d top(x + 0.05, 0, 3.4 - 0.2 * std::abs(x));
    append(model.soup, tube({foot, 0.5 * (foot + top), top}, 0.06, 24));
    for (const double z : {1.4, 2.2}) {
      append(model.soup, tube({{x, -0.9, z}, {x, 0, z + 0.01}, {x, 0.92, z}}, 0.03, 16));
    }
    for (int k = 0; k < 15; ++k) {
      const double along = x - 0.7 + 0.1 * k;
      const double height = 1.2 + 0.12 * k;
      for (const double side : {-1.0, 1.0}) {
        model.strands.push_back(
            rope({along, side * 0.3, 0.4}, {x + 0.03, 0.005 * side, height}, 0.003, 0.02, 8));
      }
    }
  }
  add_strands(model, 7);
  return model;
}

Model harp() {
  Model model{"harp", "Harp", {}, {}};
  const Vec3d foot(0, 0, 0), shoulder(1.2, 0.01, 1.9), crown(0, 0, 2.3);
  append(model.soup, leg(foot, {0.7, 0, 0.9}, shoulder, 0.14, 40, 20));
  append(model.soup, leg(shoulder, {0.7, 0, 1.6}, crown, 0.09, 40, 16));
  append(model.soup, tube({foot, 0.5 * (foot + crown), crown}, 0.06, 24));
  append(model.soup, ellipsoid({0.02, 0, 0}, {0.35, 0.25, 0.15}, 900));
  constexpr int kStrings = 47;
  const auto curve = [](const Vec3d& a, const Vec3d& b, const Vec3d& c, double t) -> Vec3d {
    return (1 - t) * (1 - t) * a + 2 * t * (1 - t) * b + t * t * c;
  };
  for (int k = 0; k < kStrings; ++k) {
    const double t = 0.1 + 0.75 * k / kStrings;
    model.strands.push_back(rope(curve(foot, {0.7, 0, 0.9}, shoulder, t),
                                 curve(crown, {0.7, 0, 1.6}, shoulder, t), 0.002, 0, 8));
  }
  add_strands(model, 8);
  return model;
}

Model blob() { return {"blob", "Bunny", bumpy(sphere(69500), 0.3, 5), {}}; }

Model bone() {
  TriangleSoup soup = sphere(5000);
  for (Vec3d& p : soup.points) {
    const double z = p.z();
    const double waist = 0.35 + 0.5 * z * z + 0.05 * std::sin(7 * z + 3 * p.x());
    p = {1.1 * waist * p.x(), 0.9 * waist * p.y(), 3 * z};
  }
  return {"bone", "Femur", std::move(soup), {}};
}

Model truss() {
  Random random(2);
  TriangleSoup soup = lattice_truss(11, 0.3);
  for (Vec3d& p : soup.points) p = 0.57 * (p / 11 - Vec3d::Constant(0.5)) * 11;
  return {"truss", "Truss", transformed(std::move(soup), testing::random_rotation(random)), {}};
}

Model pig() {
  return {"pig", "Pig", bumpy(ellipsoid({0, 0, 0}, {1.6, 1, 0.9}, 1300), 0.25, 4), {}};
}

Model helix() {
  std::vector<Vec3d> line;
  constexpr int kPieces = 1850;
  for (int i = 0; i <= kPieces; ++i) {
    const double t = static_cast<double>(i) / kPieces;
    const double angle = 12 * kTurn * t;
    line.emplace_back(-2.2 + 4.4 * t, 0.55 * std::cos(angle), 0.55 * std::sin(angle));
  }
  return {"helix", "Helix", tube(line, 0.06, 20), {}};
}

std::vector<Model> crossing_models() {
  return {ship(), harp(), spider(), turtle(), head(), cow(), oil_rig()};
}

std::vector<Vec3d> probes_of(const Strand& strand) {
  constexpr int kProbes = 64;
  std::vector<Vec3d> probes;
  const auto pieces = static_cast<double>(strand.line.size() - 1);
  for (int i = 0; i <= kProbes; ++i) {
    const double t = (0.1 + 0.8 * i / kProbes) * pieces;
    const auto k = std::min(static_cast<std::size_t>(t), strand.line.size() - 2);
    const double rest = t - static_cast<double>(k);
    probes.push_back((1 - rest) * strand.line[k] + rest * strand.line[k + 1]);
  }
  return probes;
}

bool holds_strand(const TriangleSoup& solid, const Strand& strand) {
  // van Oosterom and Strackee 1983.
  const std::vector<Vec3d> probes = probes_of(strand);
  return std::all_of(probes.begin(), probes.end(), [&](const Vec3d& at) {
    double angle = 0;
    for (const auto& t : solid.triangles) {
      const Vec3d a = solid.points[t[0]] - at, b = solid.points[t[1]] - at,
                  c = solid.points[t[2]] - at;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      angle += std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return angle > std::numbers::pi;
  });
}

std::size_t strands_held(const TriangleSoup& solid, const Model& model) {
  return static_cast<std::size_t>(
      std::count_if(model.strands.begin(), model.strands.end(),
                    [&](const Strand& strand) { return holds_strand(solid, strand); }));
}

}  // namespace meshrepair::bench
