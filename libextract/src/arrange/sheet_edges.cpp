// SPDX-License-Identifier: MIT
#include "sheet_edges.h"

#include <algorithm>

#include <base/ids.h>
#include <base/parallel.h>

namespace meshrepair::internal {
namespace {

// A facet at an edge: its plane, and on which side of that what comes next around the edge lies.
struct HalfPlane {
  std::uint32_t slot = 0;
  std::uint32_t triangle = 0;
  PlaneId plane;  // of the soup
  int sign = 1;
  bool second_half = false;  // beyond half a turn from the first
};

class AroundEdge {
 public:
  AroundEdge(const CleanSoup& soup, const PlaneTable& planes, const Point& low, const Point& high)
      : soup_(soup), planes_(planes), low_(low), high_(high) {}

  // The sign of the angle from a to b.
  [[nodiscard]] int turn(const HalfPlane& a, const HalfPlane& b) const {
    if (a.plane == b.plane) return 0;
    const Direction across = direction_of(soup_.planes[a.plane], soup_.planes[b.plane]);
    return a.sign * b.sign * order_along(across, low_, high_, planes_);
  }

  void sort(std::vector<HalfPlane>& list) const {
    const HalfPlane first = list[0];
    for (HalfPlane& h : list) {
      h.second_half = h.plane == first.plane ? h.sign != first.sign : turn(first, h) < 0;
    }
    std::sort(list.begin(), list.end(), [&](const HalfPlane& a, const HalfPlane& b) {
      if (a.second_half != b.second_half) return b.second_half;
      if (a.plane == b.plane) {
        return a.sign > 0 ? a.triangle < b.triangle : a.triangle > b.triangle;
      }
      return turn(a, b) > 0;
    });
  }

 private:
  const CleanSoup& soup_;
  const PlaneTable& planes_;
  const Point& low_;
  const Point& high_;
};

}  // namespace

Sheets join_sheets(const CutSet& cut, const ArrangedFacets& facets, const ArrangedPoints& points) {
  const CleanSoup& soup = cut.soup();
  Sheets sheets;
  const std::size_t count = soup.triangles.size() - cut.size() + facets.corners.size();
  sheets.corners.reserve(count);
  sheets.triangle.reserve(count);
  sheets.across.reserve(3 * count);
  sheets.first.reserve(soup.triangles.size() + 1);
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(sheets.corners.size());
    sheets.first.push_back(first);
    const std::uint32_t number = cut.number_of(t);
    if (number == kNone) {
      const auto& c = soup.triangles[TriangleId(t)].corners;
      sheets.corners.push_back({c[0].value, c[1].value, c[2].value});
      sheets.across.insert(sheets.across.end(), 3, kNone);
    } else {
      const std::uint32_t from = facets.first[number], to = facets.first[number + 1];
      for (std::uint32_t f = from; f < to; ++f) {
        IndexTriangle corners = facets.corners[f];
        for (std::uint32_t& p : corners) p = points.settled(p);
        sheets.corners.push_back(corners);
      }
      for (std::uint32_t s = 3 * from; s < 3 * to; ++s) {
        const std::uint32_t other = facets.across[s];
        sheets.across.push_back(other == kNone ? kNone : other - 3 * from + 3 * first);
      }
    }
    sheets.triangle.resize(sheets.corners.size(), t);
  }
  sheets.first.push_back(static_cast<std::uint32_t>(sheets.corners.size()));
  return sheets;
}

SheetEdges::SheetEdges(const CutSet& cut, const ArrangedPoints& points, const Sheets& sheets,
                       ProgressObserver* progress)
    : cut_(cut), points_(points), sheets_(sheets) {
  EdgeTable table(sheets.corners, sheets.across);
  slots_ = table.take_sides();
  first_ = table.take_first();
  CancelCheck check(progress);
  std::vector<std::uint32_t> crowded;
  for (std::size_t e = 0; e < size(); ++e) {
    check.tick();
    if (slots(e).size() > 2) crowded.push_back(static_cast<std::uint32_t>(e));
    if (slots(e).size() == 2) {
      const std::uint32_t a = sheets.triangle[slots(e)[0] / 3];
      const std::uint32_t b = sheets.triangle[slots(e)[1] / 3];
      const auto plane_of = [&](std::uint32_t t) {
        return cut.soup().triangles[TriangleId(t)].plane;
      };
      if (plane_of(a) == plane_of(b)) crowded.push_back(static_cast<std::uint32_t>(e));
    }
  }
  on_previous_.assign(slots_.size(), 0);
  parallel_for(crowded.size(), [&](std::size_t i) { sort_around(crowded[i]); });
}

void SheetEdges::sort_around(std::size_t edge) {
  const CleanSoup& soup = cut_.soup();
  std::vector<HalfPlane> list;
  for (const std::uint32_t slot : slots(edge)) {
    const std::uint32_t t = sheets_.triangle[slot / 3];
    const int up = leads_up(slot) ? 1 : -1;
    list.push_back(
        {slot, t, soup.triangles[TriangleId(t)].plane, up * corner_side(soup, t), false});
  }
  const std::uint32_t start = side_start(sheets_.corners, list[0].slot);
  const std::uint32_t end = side_start(sheets_.corners, next_side(list[0].slot));
  const Point at_low = points_.at(std::min(start, end)), at_high = points_.at(std::max(start, end));
  AroundEdge(soup, cut_.planes(), at_low, at_high).sort(list);
  for (std::size_t i = 0; i < list.size(); ++i) {
    slots_[first_[edge] + i] = list[i].slot;
    const bool same =
        i > 0 && list[i].plane == list[i - 1].plane && list[i].sign == list[i - 1].sign;
    on_previous_[first_[edge] + i] = same ? 1 : 0;
  }
}

}  // namespace meshrepair::internal
