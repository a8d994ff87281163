// SPDX-License-Identifier: MIT
#include "face_list.h"

#include <algorithm>
#include <span>
#include <string>

#include <base/error.h>
#include <mesh/edge_table.h>
#include <mesh/mesh_source.h>
#include <mesh/triangulate_polygon.h>

namespace meshrepair {
namespace {

std::size_t triangles_of(std::size_t corners) { return corners < 3 ? 0 : corners - 2; }

// Faces left out for one reason.
struct Dropped {
  std::size_t count = 0;
  std::size_t first = 0;

  void add(std::size_t face) {
    if (count++ == 0) first = face;
  }

  void report(ReadReport& report, const std::string& reason) const {
    if (count == 0) return;
    report.bad_faces += count;
    report.warnings.push_back({WarningCode::faces_unreadable,
                               counted(count, "face") + " left out: " + reason + " (first: face " +
                                   std::to_string(first + 1) + ")",
                               {{"faces", count}}});
  }
};

}  // namespace

void FaceList::end_face() {
  const std::size_t corners = stream_.size() - last_ - 1;
  if (corners >= kBadIndex) throw LimitError("a face with more than 4294967294 corners");
  stream_[last_] = static_cast<std::uint32_t>(corners);
  open_ = false;
  ++size_;
  triangles_ += triangles_of(corners);
}

void FaceList::drop_face() {
  if (!open_) {
    --size_;
    triangles_ -= triangles_of(stream_[last_]);
  }
  corners_ -= stream_.size() - last_ - 1;
  stream_.resize(last_);
}

void FaceList::append_to(ReadResult& result, ProgressObserver* progress,
                         std::vector<Origin>* origins) {
  CancelCheck cancel(progress);
  TriangleSoup& soup = result.soup;
  Dropped out_of_range;
  Dropped too_small;
  soup.triangles.reserve(soup.triangles.size() + size_);
  std::size_t at = 0;
  std::vector<IndexTriangle> pieces;  // positions in the face
  for (std::size_t face = 0; face < size_; ++face) {
    const std::span<const std::uint32_t> corners(stream_.data() + at + 1, stream_[at]);
    at += 1 + corners.size();
    cancel.tick();
    const auto is_bad = [&](std::uint32_t corner) { return corner >= soup.points.size(); };
    if (std::any_of(corners.begin(), corners.end(), is_bad)) {
      out_of_range.add(face);
    } else if (corners.size() < 3) {
      too_small.add(face);
    } else {
      pieces.assign(1, {0, 1, 2});
      if (corners.size() > 3) {
        ++result.report.polygons;
        pieces.clear();
        triangulate_polygon(soup.points, corners, pieces);
      }
      const std::size_t first_corner = at - corners.size() - 1 - face;
      for (const auto& [a, b, c] : pieces) {
        soup.triangles.push_back({corners[a], corners[b], corners[c]});
        if (origins == nullptr) continue;
        origins->push_back({static_cast<std::uint32_t>(face),
                            {first_corner + a, first_corner + b, first_corner + c}});
      }
    }
  }
  out_of_range.report(result.report, "they name points that do not exist");
  too_small.report(result.report, "fewer than three corners");
  *this = FaceList();
}

}  // namespace meshrepair
