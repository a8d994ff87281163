// SPDX-License-Identifier: MIT
// Faces as a reader of an indexed format meets them: any number of corners, not checked yet,
// because the points may come later in the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <base/progress.h>
#include <mesh/reading.h>

namespace meshrepair {

class FaceList {
 public:
  static constexpr std::int64_t kNoPoint = -1;

  void begin_face();
  // 0-based; anything that no point can have (kNoPoint, too large) makes the face a bad one.
  void add_corner(std::int64_t index);
  void end_face();
  void add_triangle(const std::array<std::uint32_t, 3>& corners);
  // Forgets the face that was begun last, ended or not. At most once for each face.
  void drop_face();

  [[nodiscard]] std::size_t size() const { return size_; }
  // That the faces will become, if none is a bad one.
  [[nodiscard]] std::size_t triangles() const { return triangles_; }

  // Of all faces that are there, in their order.
  [[nodiscard]] std::size_t corners() const { return corners_; }

  // What a triangle was made of.
  struct Origin {
    std::uint32_t face;
    std::array<std::size_t, 3> corners;  // among those of all faces
  };

  // Moves the faces into the soup, triangulated. Those with an index out of range or with fewer
  // than three corners are left out, counted and mentioned in the report. `progress` is asked
  // whether to go on. `origins`, if not null, gets one for each triangle.
  void append_to(ReadResult& result, ProgressObserver* progress,
                 std::vector<Origin>* origins = nullptr);

 private:
  static constexpr std::uint32_t kBadIndex = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> stream_;  // for each face: number of corners, then the corners
  std::size_t last_ = 0;               // where the last face begins in the stream
  std::size_t size_ = 0;               // faces ended
  std::size_t triangles_ = 0;          // of them
  std::size_t corners_ = 0;            // of them, and of the one that is not ended
  bool open_ = false;                  // the last face is not ended
};

inline void FaceList::begin_face() {
  last_ = stream_.size();
  stream_.push_back(0);
  open_ = true;
}

inline void FaceList::add_corner(std::int64_t index) {
  const bool fits = index >= 0 && index < kBadIndex;
  stream_.push_back(fits ? static_cast<std::uint32_t>(index) : kBadIndex);
  ++corners_;
}

inline void FaceList::add_triangle(const std::array<std::uint32_t, 3>& corners) {
  begin_face();
  for (const std::uint32_t corner : corners) add_corner(corner);
  end_face();
}

}  // namespace meshrepair
