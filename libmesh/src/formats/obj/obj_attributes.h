// SPDX-License-Identifier: MIT
// What an OBJ file says of faces besides their points.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <mesh/attributes.h>

#include "formats/common/face_list.h"
#include "formats/common/text_scanner.h"

namespace meshrepair {

// Takes lines as the reader meets them. Indices are checked at the end, as what they name may come
// later in the file; those that name nothing leave their corner without a value.
class ObjAttributes {
 public:
  // A line that is no point and no face, behind its first word. False if it says nothing of
  // attributes.
  bool read_line(std::string_view word, TextScanner& text);
  // The colour behind the coordinates of the point that was read last, if there is one.
  void read_colour(TextScanner& text, std::size_t points);
  // A corner "7/3/9", "7//9" or "7/3" of the face that is read.
  void add_corner(std::string_view token);
  // Corners beyond the first so many are forgotten.
  void keep_corners(std::size_t corners);
  void end_face();

  // Of files that say what the materials are, as the lines name them.
  [[nodiscard]] const std::vector<std::string>& libraries() const { return libraries_; }

  // Corners that name texture coordinates or normals that are not there; of take().
  [[nodiscard]] std::size_t bad_corners() const { return texture_.bad + normals_.bad; }

  // For triangles with these origins, and corners at these points.
  [[nodiscard]] Attributes take(const std::vector<FaceList::Origin>& origins,
                                const std::vector<std::array<std::uint32_t, 3>>& triangles);

 private:
  // Numbers of names, and which one holds now.
  struct Labels {
    TriangleLabels labels;  // of_triangle is of faces here
    std::unordered_map<std::string, std::uint32_t> number;
    std::uint32_t current = kNoLabel;
    static constexpr std::uint32_t kNoLabel = ~std::uint32_t{0};

    void choose(std::string_view name);
    [[nodiscard]] TriangleLabels take(const std::vector<FaceList::Origin>& origins);
  };
  // Values, and of each corner of a face one of them.
  struct Corners {
    std::vector<double> values;
    std::size_t components = 0;
    std::vector<std::int64_t> of_corner;  // 0-based, maybe of none that is there
    std::size_t bad = 0;                  // corners that name none of the values

    void add(TextScanner& text, std::size_t most);
    [[nodiscard]] CornerAttribute take(CornerAttribute::Kind kind,
                                       const std::vector<FaceList::Origin>& origins);
    // Where there are no values at all.
    void count_bad(const std::vector<FaceList::Origin>& origins);
  };

  Corners texture_, normals_;
  std::vector<double> colours_;  // three for each point so far, NaN where there are none
  Labels materials_, groups_, objects_, smoothing_;
  std::vector<std::string> libraries_;
};

// The whole mesh with all of it.
void append_obj(std::string& text, const TriangleSoup& soup, const Attributes& attributes);

}  // namespace meshrepair
