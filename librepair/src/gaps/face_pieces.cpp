// SPDX-License-Identifier: MIT
#include "face_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

#include <base/angles.h>
#include <base/ids.h>
#include <mesh/triangulate_polygon.h>

#include "improve_pieces.h"

namespace meshrepair::internal {
namespace {

using Loop = std::vector<std::uint32_t>;

// Twice the area.
double area_of(const FlatPoints& at, const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    sum += left_turn(at(loop[0]), at(loop[i - 1]), at(loop[i]));
  }
  return sum;
}

bool is_inside(const FlatPoints& at, const Flat& p, const Loop& loop) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Flat a = at(loop[i]), b = at(loop[(i + 1) % loop.size()]);
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

// The regions into which edges divide an outline. Both directions of each edge are there: those
// against the outline bound what is outside.
class Regions {
 public:
  Regions(const FlatPoints& at, std::span<const EdgeEnds> outline, std::span<const EdgeEnds> inside)
      : at_(at) {
    for (const EdgeEnds& edge : outline) add(edge[0], edge[1], true);
    for (const EdgeEnds& edge : inside) add(edge[0], edge[1], false);
    link();
  }

  // False where a loop bounds what is outside, too.
  [[nodiscard]] bool trace(std::vector<Loop>& loops) const {
    bool is_plane = true;
    std::vector<char> passed(from_.size(), 0);
    for (std::uint32_t first = 0; first < from_.size(); ++first) {
      if (passed[first] != 0) continue;
      Loop loop;
      std::size_t outside = 0;
      for (std::uint32_t h = first; passed[h] == 0; h = next_[h]) {
        passed[h] = 1;
        outside += is_outside_[h] != 0 ? 1 : 0;
        loop.push_back(from_[h]);
      }
      if (outside == loop.size()) continue;
      is_plane = is_plane && outside == 0;
      loops.push_back(std::move(loop));
    }
    return is_plane;
  }

 private:
  void add(std::uint32_t a, std::uint32_t b, bool is_outline) {
    from_.push_back(a);
    from_.push_back(b);
    is_outside_.push_back(0);
    is_outside_.push_back(is_outline ? 1 : 0);
  }

  // After an edge comes the next one clockwise at its end.
  void link() {
    std::vector<std::uint32_t> around(from_.size());
    std::iota(around.begin(), around.end(), 0);
    std::vector<double> angle(from_.size());
    for (std::uint32_t h = 0; h < from_.size(); ++h) {
      const Flat along = at_(from_[h ^ 1u]) - at_(from_[h]);
      angle[h] = arc_tangent(along.y(), along.x());
    }
    std::sort(around.begin(), around.end(), [&](std::uint32_t g, std::uint32_t h) {
      return std::tuple(from_[g], angle[g], g) < std::tuple(from_[h], angle[h], h);
    });
    next_.resize(from_.size());
    for (std::size_t first = 0, last = 0; first < around.size(); first = last) {
      while (last < around.size() && from_[around[last]] == from_[around[first]]) ++last;
      for (std::size_t i = first; i < last; ++i) {
        next_[around[i] ^ 1u] = around[i == first ? last - 1 : i - 1];
      }
    }
  }

  const FlatPoints& at_;
  std::vector<std::uint32_t> from_, next_;  // of each direction; the other one is h ^ 1
  std::vector<char> is_outside_;
};

// Where a hole is joined to the loop around it: a position in that.
std::optional<std::size_t> find_bridge(const FlatPoints& at, const Loop& loop, std::uint32_t from) {
  const Flat m = at(from);
  double nearest = -std::numeric_limits<double>::infinity();
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t k = (i + 1) % loop.size();
    const Flat p = at(loop[i]), q = at(loop[k]);
    if (!(p.y() >= m.y() && q.y() <= m.y() && p.y() > q.y())) continue;
    const double x = p.x() + (m.y() - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
    if (x > m.x() || x <= nearest) continue;
    nearest = x;
    best = p.x() < q.x() ? i : k;
  }
  if (!best) return best;
  // Corners of the loop may be in the way: the one that is seen under the smallest angle is not.
  const Flat c = at(loop[*best]), hit(nearest, m.y());
  const double way = c.y() > m.y() ? -1 : 1;
  const auto in_triangle = [&](const Flat& p) {
    return p.x() < m.x() && way * left_turn(m, hit, p) >= 0 && way * left_turn(hit, c, p) >= 0 &&
           way * left_turn(c, m, p) >= 0;
  };
  const auto looks_at = [&](std::size_t i) {
    const std::size_t n = loop.size();
    const Flat before = at(loop[(i + n - 1) % n]), p = at(loop[i]), after = at(loop[(i + 1) % n]);
    const bool left_of_in = left_turn(before, p, m) > 0, left_of_out = left_turn(p, after, m) > 0;
    return left_turn(before, p, after) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
  };
  double slope = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Flat p = at(loop[i]);
    if (!in_triangle(p) || !looks_at(i)) continue;
    const double here = std::abs(p.y() - m.y()) / (m.x() - p.x());
    if (here > slope || (here == slope && p.x() <= at(loop[*best]).x())) continue;
    slope = here;
    best = i;
  }
  return best;
}

// One loop around all, along a bridge to each hole and back.
Loop with_bridges(const FlatPoints& at, Loop loop, std::vector<Loop> holes) {
  const auto place = [&](std::uint32_t p) { return std::tuple(at(p).x(), at(p).y(), p); };
  for (Loop& hole : holes) {
    const auto leftmost =
        std::min_element(hole.begin(), hole.end(),
                         [&](std::uint32_t p, std::uint32_t q) { return place(p) < place(q); });
    std::rotate(hole.begin(), leftmost, hole.end());
  }
  std::sort(holes.begin(), holes.end(),
            [&](const Loop& a, const Loop& b) { return place(a[0]) < place(b[0]); });
  for (const Loop& hole : holes) {
    const std::optional<std::size_t> bridge = find_bridge(at, loop, hole[0]);
    if (!bridge) continue;
    Loop inserted = hole;
    inserted.push_back(hole[0]);
    inserted.push_back(loop[*bridge]);
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(*bridge) + 1, inserted.begin(),
                inserted.end());
  }
  return loop;
}

// In its direction, without those that it passes back again.
std::vector<EdgeEnds> directed_edges(std::span<const std::uint32_t> outline) {
  std::vector<EdgeEnds> all;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    all.push_back({outline[i], outline[(i + 1) % outline.size()]});
  }
  std::vector<EdgeEnds> edges;
  for (const EdgeEnds& edge : all) {
    if (std::find(all.begin(), all.end(), EdgeEnds{edge[1], edge[0]}) == all.end()) {
      edges.push_back(edge);
    }
  }
  return edges;
}

void list_edges(const Loop& loop, std::vector<EdgeEnds>& edges) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    edges.push_back(ascending(loop[i], loop[(i + 1) % loop.size()]));
  }
}

bool passes(const Loop& loop, std::uint32_t a, std::uint32_t b) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (loop[i] == a && loop[(i + 1) % loop.size()] == b) return true;
  }
  return false;
}

}  // namespace

bool FacePieces::cut(std::span<const std::uint32_t> outline, std::span<const EdgeEnds> inside,
                     const Vec3d& normal, std::vector<IndexTriangle>& pieces) {
  const FlatPoints at(points_, normal);
  std::vector<Loop> loops, holes;
  const std::vector<EdgeEnds> around = directed_edges(outline);
  const bool is_plane = Regions(at, around, inside).trace(loops);
  if (!is_plane) {
    loops.clear();
    (void)Regions(at, around, {}).trace(loops);
  }
  if (loops.size() > 1) {
    const auto first_hole = std::stable_partition(
        loops.begin(), loops.end(), [&](const Loop& loop) { return area_of(at, loop) > 0; });
    holes.assign(first_hole, loops.end());
    loops.erase(first_hole, loops.end());
  }
  std::vector<std::vector<Loop>> holes_of(loops.size());
  for (Loop& hole : holes) {
    std::size_t best = kNone;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const bool is_own = std::find(loops[i].begin(), loops[i].end(), hole[0]) != loops[i].end();
      if (is_own || !is_inside(at, at(hole[0]), loops[i])) continue;
      if (best == kNone || area_of(at, loops[i]) < area_of(at, loops[best])) best = i;
    }
    if (best != kNone) holes_of[best].push_back(std::move(hole));
  }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    fill(loops[i], std::move(holes_of[i]), normal, pieces);
  }
  return is_plane;
}

void FacePieces::fill(const Loop& loop, std::vector<Loop> holes, const Vec3d& normal,
                      std::vector<IndexTriangle>& pieces) {
  if (loop.size() < 3) return;
  std::vector<EdgeEnds> edges;
  list_edges(loop, edges);
  for (const Loop& hole : holes) list_edges(hole, edges);
  std::sort(edges.begin(), edges.end());
  const auto [at, is_new] = known_.try_emplace(std::move(edges));
  Region& region = at->second;
  if (is_new) {
    region.outline = loop;
    const FlatPoints flat(points_, normal);
    const Loop polygon = with_bridges(flat, loop, std::move(holes));
    std::vector<IndexTriangle> triangles;
    triangulate_polygon(points_, polygon, triangles);
    for (const IndexTriangle& t : triangles) {
      region.pieces.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
    }
    improve_pieces(flat, region.pieces);
  }
  bool is_turned = false;
  for (std::size_t i = 0; i < loop.size() && !is_new && !is_turned; ++i) {
    const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
    is_turned = passes(region.outline, b, a) && !passes(loop, b, a);
    if (!is_turned && !passes(region.outline, b, a)) break;
  }
  for (IndexTriangle piece : region.pieces) {
    if (is_turned) std::swap(piece[1], piece[2]);
    pieces.push_back(piece);
  }
}

}  // namespace meshrepair::internal
