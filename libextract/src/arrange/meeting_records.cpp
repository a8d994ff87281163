// SPDX-License-Identifier: MIT
#include "meeting_records.h"

#include <algorithm>

#include <base/parallel.h>
#include <base/shared_progress.h>

#include "meeting_places.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kPairsPerTask = 1024;

// The side on which two places lie, 3 if there is none.
std::size_t common_side(Place p, Place q) {
  const auto is_on = [](Place place, std::size_t k) {
    if (place.is_side()) return place.number() == k;
    return place.is_corner() && (place.number() == k || place.number() == (k + 1) % 3);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_on(p, k) && is_on(q, k)) return k;
  }
  return 3;
}

class MeetingRecorder {
 public:
  MeetingRecorder(const CutSet& cut, MeetingRecords& records) : cut_(cut), records_(records) {}

  void add(std::uint32_t a, std::uint32_t b) {
    const TriangleMeeting meeting = meet_triangles(corners_of(a), corners_of(b));
    if (!meeting.coplanar) {
      add_points(a, b, meeting.across);
      add_segment(a, b, meeting.across, cut_.plane(b), false);
      add_segment(b, a, meeting.across, cut_.plane(a), true);
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      add_points(a, b, meeting.sides_of_a[k]);
      add_points(a, b, meeting.sides_of_b[k]);
      add_segment(b, a, meeting.sides_of_a[k], cut_.plane_across(cut_.edge(a, k), cut_.plane(b)),
                  true);
      add_segment(a, b, meeting.sides_of_b[k], cut_.plane_across(cut_.edge(b, k), cut_.plane(a)),
                  false);
    }
  }

 private:
  [[nodiscard]] TriangleCorners corners_of(std::uint32_t cut) const {
    const auto& c = cut_.corners(cut);
    const auto& at = cut_.soup().grid_points;
    return {as_vector(at[PointId(c[0])]), as_vector(at[PointId(c[1])]),
            as_vector(at[PointId(c[2])])};
  }

  [[nodiscard]] PointName name_of(std::uint32_t a, std::uint32_t b, const MeetingPoint& p) const {
    if (p.in_a.is_corner()) return PointName::corner(cut_.corners(a)[p.in_a.number()]);
    if (p.in_b.is_corner()) return PointName::corner(cut_.corners(b)[p.in_b.number()]);
    if (!p.in_b.is_side()) return PointName::edge_and_triangle(cut_.edge(a, p.in_a.number()), b);
    if (!p.in_a.is_side()) return PointName::edge_and_triangle(cut_.edge(b, p.in_b.number()), a);
    return PointName::two_edges(cut_.edge(a, p.in_a.number()), cut_.edge(b, p.in_b.number()));
  }

  void add_points(std::uint32_t a, std::uint32_t b, const CommonSegment& common) {
    for (std::size_t i = 0; i < common.count; ++i) {
      const MeetingPoint& p = common.ends[i];
      const PointName name = name_of(a, b, p);
      if (p.in_a.is_side()) records_.on_edges.push_back({cut_.edge(a, p.in_a.number()), name});
      if (p.in_b.is_side()) records_.on_edges.push_back({cut_.edge(b, p.in_b.number()), name});
      if (common.count > 1) continue;
      if (p.in_a.is_inside()) records_.contacts.push_back({a, name});
      if (p.in_b.is_inside()) records_.contacts.push_back({b, name});
    }
  }

  // In triangle `in`. If `swapped` that is the b of the meeting.
  void add_segment(std::uint32_t in, std::uint32_t by, const CommonSegment& common, PlaneId plane,
                   bool swapped) {
    if (common.count < 2) return;
    const auto& [p, q] = common.ends;
    const std::size_t own = swapped ? common_side(p.in_b, q.in_b) : common_side(p.in_a, q.in_a);
    if (own < 3) return;
    const std::size_t of_other =
        swapped ? common_side(p.in_a, q.in_a) : common_side(p.in_b, q.in_b);
    const std::uint32_t a = swapped ? by : in, b = swapped ? in : by;
    records_.segments.push_back({in, by, of_other < 3 ? cut_.edge(by, of_other) : kNone, plane,
                                 name_of(a, b, p), name_of(a, b, q)});
  }

  const CutSet& cut_;
  MeetingRecords& records_;
};

template <class Item>
void append(std::vector<Item>& to, const std::vector<Item>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

MeetingRecords record_meetings(const CutSet& cut, std::span<const CutSet::Pair> pairs,
                               ProgressObserver* progress) {
  CancelOnly quiet(progress);
  SharedProgress shared(&quiet, tasks_of(pairs.size(), kPairsPerTask));
  const auto records_of = [&](std::size_t first, std::size_t last) {
    MeetingRecords records;
    MeetingRecorder recorder(cut, records);
    for (std::size_t i = first; i < last; ++i) {
      recorder.add(cut.number_of(pairs[i][0]), cut.number_of(pairs[i][1]));
    }
    shared.done();
    return records;
  };
  return parallel_reduce(pairs.size(), kPairsPerTask, records_of,
                         [](MeetingRecords& all, const MeetingRecords& part) {
                           append(all.segments, part.segments);
                           append(all.on_edges, part.on_edges);
                           append(all.contacts, part.contacts);
                         });
}

}  // namespace meshrepair::internal
