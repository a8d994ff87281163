// SPDX-License-Identifier: MIT
// ASCII STL:
//
//   solid NAME
//     facet normal X Y Z
//       outer loop
//         vertex X Y Z      (three times)
//       endloop
//     endfacet              (facets repeat)
//   endsolid NAME
//
// The scan knows four words. `vertex` adds a corner; a word that begins a loop or a facet forgets
// corners that were not closed; a word that ends one makes the corners a face; after `solid` and
// `endsolid` comes a name, which may hold any of the other words. Everything else (normals too) is
// passed over.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <mesh/edge_table.h>
#include <mesh/read_guard.h>
#include <mesh/triangulate_polygon.h>
#include <mesh/weld_points.h>

#include "formats/common/regions.h"
#include "formats/common/text_scanner.h"
#include "formats/common/text_writer.h"
#include "stl_io.h"
#include "stl_regions.h"

namespace meshrepair {
namespace {

class AsciiStlReader {
 public:
  explicit AsciiStlReader(const MeshSource& source)
      : source_(source), text_(source.bytes), guard_(source), welder_(result_.soup.points) {}

  ReadResult run() {
    result_.report.format = SoupFormat::stl_ascii;
    while (text_.next_anywhere()) {
      word_at_ = text_.position();
      guard_.step(result_.soup.triangles.size(), word_at_);
      const std::string_view word = text_.peek_token();
      text_.skip_token();
      if (equals_ignoring_case(word, "vertex")) {
        read_vertex();
      } else if (equals_ignoring_case(word, "endloop") || equals_ignoring_case(word, "endfacet")) {
        close_face();
      } else if (equals_ignoring_case(word, "outer") || equals_ignoring_case(word, "facet")) {
        drop_face();
      } else if (equals_ignoring_case(word, "solid")) {
        drop_face();
        const std::string_view name = take_name();
        if (source_.options.attributes) solids_.begin(name, result_.soup.triangles.size());
      } else if (equals_ignoring_case(word, "endsolid")) {
        drop_face();
        const std::string_view name = take_name();
        if (source_.options.attributes) solids_.end(name, result_.soup.triangles.size());
      }
    }
    guard_.step(result_.soup.triangles.size(), source_.bytes.size());
    drop_face();
    warn_of_bad(result_.report, source_, first_bad_, "facet",
                "cut or with fewer than three vertices", "vertex line");
    solids_.take(result_.soup.triangles.size(), result_.attributes);
    return std::move(result_);
  }

 private:
  void read_vertex() {
    Vec3d point;
    bool good = true;
    for (int i = 0; i < 3; ++i) good = read_coordinate(point[i]) && good;
    if (!good && result_.report.bad_points++ == 0) first_bad_.point = word_at_;
    corners_.push_back(welder_.index_of(point));
  }

  // A word where a number should be is left to the scan: it may be the next keyword.
  bool read_coordinate(double& value) {
    value = std::numeric_limits<double>::quiet_NaN();
    if (!text_.next_anywhere()) return false;
    const std::size_t start = text_.position();
    if (text_.read_real(value)) return true;
    text_.go_to(start);
    if (!is_keyword(text_.peek_token())) text_.skip_token();
    return false;
  }

  static bool is_keyword(std::string_view word) {
    return equals_ignoring_case(word, "vertex") || equals_ignoring_case(word, "endloop") ||
           equals_ignoring_case(word, "endfacet") || equals_ignoring_case(word, "facet") ||
           equals_ignoring_case(word, "endsolid");
  }

  void close_face() {
    if (corners_.size() < 3) return drop_face();
    if (corners_.size() > 3) ++result_.report.polygons;
    auto& triangles = result_.soup.triangles;
    const std::size_t before = triangles.size();
    triangulate_polygon(result_.soup.points, corners_, triangles);
    for (std::size_t t = before; t < triangles.size(); ++t) {
      for (std::uint32_t& corner : triangles[t]) corner = corners_[corner];
    }
    corners_.clear();
  }

  void drop_face() {
    if (corners_.empty()) return;
    corners_.clear();
    if (result_.report.bad_faces++ == 0) first_bad_.face = word_at_;
  }

  // The name goes to the end of the line, unless the line goes on with facets.
  std::string_view take_name() {
    const std::size_t start = text_.position();
    text_.skip_line();
    const std::size_t end = text_.position();
    text_.go_to(start);
    std::size_t first = end, last = end;
    while (text_.position() < end && text_.next_on_line()) {
      const std::size_t word_at = text_.position();
      const bool is_facet = equals_ignoring_case(text_.peek_token(), "facet");
      text_.skip_token();
      const std::size_t word_end = text_.position();
      if (is_facet && text_.next_on_line() && equals_ignoring_case(text_.peek_token(), "normal")) {
        text_.go_to(word_at);
        return source_.bytes.substr(first, last - first);
      }
      first = std::min(first, word_at);
      last = word_end;
    }
    text_.go_to(end);
    return source_.bytes.substr(first, last - first);
  }

  const MeshSource& source_;
  TextScanner text_;
  ReadGuard guard_;
  ReadResult result_;
  PointWelder welder_;
  std::vector<std::uint32_t> corners_;
  std::size_t word_at_ = 0;
  FirstBad first_bad_;
  StlSolids solids_;
};

// No -0: as it will be read back.
template <class Vector>
Eigen::Vector3<typename Vector::Scalar> without_minus(const Vector& v) {
  return v + Vector::Zero();
}

void append_facet(std::string& out, const TriangleSoup& soup, const IndexTriangle& triangle) {
  const Vec3d& a = soup.points[triangle[0]];
  const Vec3d& b = soup.points[triangle[1]];
  const Vec3d& c = soup.points[triangle[2]];
  out += "  facet normal ";
  append_triple(out, without_minus(stl_normal(a, b, c).cast<float>()));
  out += "\n    outer loop\n";
  for (const std::uint32_t corner : triangle) {
    out += "      vertex ";
    append_triple(out, without_minus(soup.points[corner]));
    out += '\n';
  }
  out += "    endloop\n  endfacet\n";
}

}  // namespace

ReadResult read_stl_ascii(const MeshSource& source) { return AsciiStlReader(source).run(); }

std::string format_stl_ascii(const TriangleSoup& soup, const Attributes* attributes) {
  std::string out;
  if (attributes == nullptr || attributes->groups.empty()) {
    const auto* const kept = attributes == nullptr
                                 ? nullptr
                                 : dynamic_cast<const StlSolidName*>(attributes->keepsake.get());
    const std::string name = kept == nullptr ? "meshrepair" : kept->name;
    out += "solid " + name + '\n';
    append_lines(out, soup.triangles.size(), [&](std::string& lines, std::size_t t) {
      append_facet(lines, soup, soup.triangles[t]);
    });
    return out + "endsolid " + name + '\n';
  }
  const TriangleLabels& groups = attributes->groups;
  const SortedRegions sorted = sort_by_region(groups);
  for (std::size_t i = 0; i + 1 < sorted.first.size(); ++i) {
    if (sorted.first[i] == sorted.first[i + 1]) continue;
    const std::string name = i < groups.names.size() ? ' ' + groups.names[i] : std::string();
    out += "solid" + name + '\n';
    const std::size_t first = sorted.first[i];
    append_lines(out, sorted.first[i + 1] - first, [&](std::string& lines, std::size_t k) {
      append_facet(lines, soup, soup.triangles[sorted.order[first + k]]);
    });
    out += "endsolid" + name + '\n';
  }
  return out;
}

}  // namespace meshrepair
