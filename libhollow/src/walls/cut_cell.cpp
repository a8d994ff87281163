// SPDX-License-Identifier: MIT
#include "walls/cut_cell.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace meshrepair::internal {
namespace {

// Points keep this share away from the ends of edges and the sides of faces and tetrahedra, so that
// rounding to single precision leaves triangles that have an area.
constexpr double kMargin = 0x1p-10;
constexpr double kMarginWithin = 0x1p-7;
constexpr int kMostSteps = 40;
constexpr double kFlat = 0.25;    // a ridge that is lower than this share of the error is left out
constexpr double kAlmost = 1e-2;  // of the error: near enough

// The shares of the corners, which add up to 1.
std::array<double, 3> shares_in(const std::array<Vec3d, 3>& face, const Vec3d& p) {
  const Vec3d normal = (face[1] - face[0]).cross(face[2] - face[0]);
  const double whole = normal.squaredNorm();
  const double b = (p - face[0]).cross(face[2] - face[0]).dot(normal) / whole;
  const double c = (face[1] - face[0]).cross(p - face[0]).dot(normal) / whole;
  return {1 - b - c, b, c};
}

double volume_of(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

bool is_within(const std::array<Vec3d, 4>& cell, const Vec3d& p) {
  const auto& [a, b, c, d] = cell;
  const double least = kMarginWithin * volume_of(a, b, c, d);
  return volume_of(p, b, c, d) > least && volume_of(a, p, c, d) > least &&
         volume_of(a, b, p, d) > least && volume_of(a, b, c, p) > least;
}

FaceKey key_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  FaceKey key = {a, b, c};
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace

double WallFinder::misfit(const Place& place) const {
  return std::abs(place.distance - thickness_);
}

// By the false position, where the old end counts less each time that it stays (Illinois). The
// depth beyond the surface counts as none.
Place WallFinder::on_edge(const Place& in, const Place& out) const {
  Place low = in, high = out;
  double low_share = 0, high_share = 1;
  double low_by = in.distance - thickness_;
  double high_by = std::min(out.distance, thickness_) - thickness_;
  if (out.distance > thickness_) high_by = -thickness_;
  double share = 0.5;
  Place found = low;
  int kept = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    share = low_share + (high_share - low_share) * low_by / (low_by - high_by);
    if (!(share > low_share && share < high_share)) share = 0.5 * (low_share + high_share);
    share = std::clamp(share, kMargin, 1 - kMargin);
    found = depth_.place(in.at + share * (out.at - in.at), low.nearest);
    double by = found.distance - thickness_;
    if (std::abs(by) <= kAlmost * error_) break;
    const bool is_near = (found.at - low.at).squaredNorm() < low.distance * low.distance;
    if (by > 0 && !is_near && !depth_.is_inside(found.at)) by = -thickness_;
    if (by > 0) {
      if (share >= 1 - kMargin) break;
      low = found;
      low_share = share;
      low_by = by;
      if (++kept > 1) high_by *= 0.5;
      kept = std::max(kept, 1);
    } else {
      if (share <= kMargin) break;
      high = found;
      high_share = share;
      high_by = by;
      if (--kept < -1) low_by *= 0.5;
      kept = std::min(kept, -1);
    }
  }
  return found;
}

// Between the two, where the depth is that of walls, if it is between those of the two; else the
// far one.
Place WallFinder::at_depth(const Place& from, const Vec3d& to) const {
  Place low = from, high = depth_.place(to, from.nearest);
  if (misfit(high) <= kAlmost * error_) return high;
  const bool below = low.distance < thickness_;
  if (below == (high.distance < thickness_)) return high;
  for (int step = 0; step < kMostSteps; ++step) {
    Place middle = depth_.place(0.5 * low.at + 0.5 * high.at, low.nearest);
    if (misfit(middle) <= kAlmost * error_) return middle;
    ((middle.distance < thickness_) == below ? low : high) = middle;
  }
  return high;
}

// Where the planes along the wall through the two points meet in the face.
std::optional<Place> WallFinder::in_face(const std::array<Vec3d, 3>& face, const Place& p,
                                         const Place& q) const {
  const Vec3d along = q.at - p.at;
  const double length = along.norm();
  if (!(length > 0)) return std::nullopt;
  const Vec3d x = along / length;
  const Vec3d normal = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
  const Vec3d y = normal.cross(x);
  const Vec3d u = depth_.inward(p), v = depth_.inward(q);
  // u (r - p) = 0 and v (r - q) = 0 for r = p + s x + t y.
  const double ux = u.dot(x), uy = u.dot(y), vx = v.dot(x), vy = v.dot(y);
  const double det = ux * vy - uy * vx;
  if (!(std::abs(det) > 1e-9)) return std::nullopt;
  const double s = -uy * vx * length / det, t = ux * vx * length / det;
  const Vec3d foot = p.at + std::clamp(s, 0.0, length) * x;
  if (!(std::abs(t) > kFlat * error_)) return std::nullopt;
  const Vec3d middle = 0.5 * p.at + 0.5 * q.at;
  const Vec3d tip = p.at + s * x + t * y;
  const auto fits = [&](const Vec3d& r) {
    const auto shares = shares_in(face, r);
    return *std::min_element(shares.begin(), shares.end()) > kMarginWithin;
  };
  Place found;
  if (fits(tip)) {
    found = at_depth(depth_.place(foot, p.nearest), tip);
    const Place straight = at_depth(depth_.place(middle, p.nearest), tip);
    if (misfit(straight) < misfit(found)) found = straight;
  } else {
    return std::nullopt;
  }
  if (!fits(found.at) || misfit(found) > misfit(depth_.place(middle, p.nearest))) {
    return std::nullopt;
  }
  return found;
}

namespace {

// Where three planes through points, with these normals, meet.
std::optional<Vec3d> corner_of(const std::vector<Place>& loop, const std::vector<Vec3d>& normals) {
  std::array<std::size_t, 3> best{};
  double most = 0.05;  // of 1, that of a cube's corner
  for (std::size_t i = 0; i < loop.size(); ++i) {
    for (std::size_t j = i + 1; j < loop.size(); ++j) {
      const Vec3d cross = normals[i].cross(normals[j]);
      for (std::size_t k = j + 1; k < loop.size(); ++k) {
        const double det = std::abs(cross.dot(normals[k]));
        if (det > most) {
          most = det;
          best = {i, j, k};
        }
      }
    }
  }
  const auto& [i, j, k] = best;
  if (k == 0) return std::nullopt;
  const Vec3d jk = normals[j].cross(normals[k]), ki = normals[k].cross(normals[i]),
              ij = normals[i].cross(normals[j]);
  // Seen from one of them, so that less is rounded.
  const Vec3d& o = loop[i].at;
  const double b = normals[j].dot(loop[j].at - o), c = normals[k].dot(loop[k].at - o);
  return o + (b * ki + c * ij) / normals[i].dot(jk);
}

}  // namespace

Place WallFinder::in_cell(const std::array<Vec3d, 4>& cell, const std::vector<Place>& loop,
                          const std::vector<Place>& ridges) const {
  std::vector<Vec3d> candidates(2, Vec3d::Zero());
  for (const Place& p : ridges) candidates[0] += p.at / static_cast<double>(ridges.size());
  for (const Place& p : loop) candidates[1] += p.at / static_cast<double>(loop.size());
  std::vector<Vec3d> normals;
  normals.reserve(loop.size());
  for (const Place& p : loop) normals.push_back(depth_.inward(p));
  if (const auto corner = corner_of(loop, normals)) candidates.push_back(*corner);
  std::optional<Place> best;
  const Place middle = depth_.place(candidates[1], loop[0].nearest);
  for (const Vec3d& candidate : candidates) {
    if (!is_within(cell, candidate)) continue;
    const Place found = at_depth(middle, candidate);
    if (is_within(cell, found.at) && (!best || misfit(found) < misfit(*best))) best = found;
  }
  return best ? *best : middle;
}

namespace {

class CellCutter {
 public:
  CellCutter(const CutCell& cell, const WallPoints& points, const WallFinder& finder)
      : cell_(cell), points_(points), finder_(finder) {}

  WallInCell run() {
    make_loop();
    add_ridges();
    if (ridges_.empty()) {
      cone_from_loop();
    } else {
      cone_from_tip();
    }
    for (std::size_t i = 0; i < 4; ++i) add_pieces_of_face(i);
    return std::move(wall_);
  }

 private:
  [[nodiscard]] WallPoint crossing(std::size_t a, std::size_t b) const {
    if (!cell_.in[a]) std::swap(a, b);
    return points_.on_edge(cell_.corners[a], cell_.corners[b]);
  }

  // Counter-clockwise seen from the side that is in no cavity; two that follow each other are on
  // edges of one face, which is opposite to the corner noted.
  void make_loop() {
    std::array<std::size_t, 4> order = {0, 1, 2, 3};
    const auto inside =
        static_cast<std::size_t>(std::count(cell_.in.begin(), cell_.in.end(), true));
    // Those in cavities first, without a reflection.
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return cell_.in[a] && !cell_.in[b]; });
    if (is_odd(order)) {
      if (inside == 1) {
        std::swap(order[2], order[3]);
      } else {
        std::swap(order[0], order[1]);
      }
    }
    const auto [a, b, c, d] = order;
    if (inside == 1) {
      add(a, b, d), add(a, c, b), add(a, d, c);
    } else if (inside == 3) {
      add(a, d, c), add(b, d, a), add(c, d, b);
    } else {
      add(a, c, b), add(a, d, c), add(b, d, a), add(b, c, d);
    }
  }

  // The point on the edge from a to b; the face to the next one is opposite to `opposite`.
  void add(std::size_t a, std::size_t b, std::size_t opposite) {
    loop_.push_back(crossing(a, b));
    opposite_.push_back(opposite);
  }

  static bool is_odd(const std::array<std::size_t, 4>& order) {
    bool odd = false;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) odd ^= order[i] > order[j];
    }
    return odd;
  }

  [[nodiscard]] std::array<std::size_t, 3> face(std::size_t opposite) const {
    std::array<std::size_t, 3> corners{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i != opposite) corners[n++] = i;
    }
    return corners;
  }

  void add_ridges() {
    std::vector<WallPoint> loop;
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      loop.push_back(loop_[i]);
      const auto [a, b, c] = face(opposite_[i]);
      ridge_[opposite_[i]] =
          points_.in_face(key_of(cell_.corners[a], cell_.corners[b], cell_.corners[c]));
      if (!ridge_[opposite_[i]]) continue;
      loop.push_back(*ridge_[opposite_[i]]);
      ridges_.push_back(ridge_[opposite_[i]]->place);
    }
    whole_ = std::move(loop);
  }

  void cone_from_loop() {
    if (whole_.size() == 4) {
      const auto misfit_between = [&](std::size_t i, std::size_t j) {
        const Place &p = whole_[i].place, &q = whole_[j].place;
        return finder_.misfit(finder_.depth().place(0.5 * p.at + 0.5 * q.at, p.nearest));
      };
      if (misfit_between(1, 3) < misfit_between(0, 2)) {
        std::rotate(whole_.begin(), whole_.begin() + 1, whole_.end());
      }
    }
    tip_ = whole_[0];
    for (std::size_t i = 2; i < whole_.size(); ++i) {
      wall_.triangles.push_back({tip_, whole_[i - 1], whole_[i]});
    }
  }

  void cone_from_tip() {
    std::vector<Place> places;
    for (const WallPoint& p : whole_) places.push_back(p.place);
    const auto& at = cell_.places;
    tip_ = {kTip, finder_.in_cell({at[0].at, at[1].at, at[2].at, at[3].at}, places, ridges_)};
    for (std::size_t i = 0; i < whole_.size(); ++i) {
      wall_.triangles.push_back({tip_, whole_[i], whole_[(i + 1) % whole_.size()]});
    }
  }

  // Cones from the tip over what of the face is on either side.
  void add_pieces_of_face(std::size_t opposite) {
    for (const bool in : {false, true}) {
      std::vector<Place> polygon;
      std::size_t chord = ~std::size_t{0};  // the point before the side along the wall
      const auto corners = face(opposite);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t a = corners[i], b = corners[(i + 1) % 3];
        if (cell_.in[a] == in) polygon.push_back(cell_.places[a]);
        if (cell_.in[a] == cell_.in[b]) continue;
        const WallPoint point = crossing(a, b);
        if (ridges_.empty() && point.number == tip_.number) {
          polygon.clear();  // flat
          break;
        }
        if (cell_.in[a] == in) chord = polygon.size();
        polygon.push_back(point.place);
      }
      add_cones(polygon, chord, ridge_[opposite], in ? wall_.in : wall_.out);
    }
  }

  void add_cones(const std::vector<Place>& polygon, std::size_t chord,
                 const std::optional<WallPoint>& ridge, std::vector<Piece>& pieces) const {
    if (polygon.size() < 3) return;
    if (!ridge) {
      for (std::size_t i = 2; i < polygon.size(); ++i) {
        pieces.push_back({tip_.place, polygon[0], polygon[i - 1], polygon[i]});
      }
      return;
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (i == chord) continue;
      pieces.push_back({tip_.place, ridge->place, polygon[i], polygon[(i + 1) % polygon.size()]});
    }
  }

  const CutCell& cell_;
  const WallPoints& points_;
  const WallFinder& finder_;
  std::vector<WallPoint> loop_;                    // on edges
  std::vector<std::size_t> opposite_;              // for each, to the face behind it
  std::vector<WallPoint> whole_;                   // with the ridges
  std::array<std::optional<WallPoint>, 4> ridge_;  // of each face
  std::vector<Place> ridges_;
  WallPoint tip_;
  WallInCell wall_;
};

}  // namespace

WallInCell wall_in(const CutCell& cell, const WallPoints& points, const WallFinder& finder) {
  return CellCutter(cell, points, finder).run();
}

}  // namespace meshrepair::internal
