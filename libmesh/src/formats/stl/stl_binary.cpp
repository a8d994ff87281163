// SPDX-License-Identifier: MIT
// Binary STL, little endian:
//
//   offset  size  content
//        0    80  header, any text (may begin with "solid", must not be trusted)
//       80     4  uint32: number of triangles (wrong in many files)
//       84    50  for each triangle: float32 x 12 (normal, three corners), uint16 attribute
//
// Normals are ignored; of attributes, see stl_colours.h and stl_regions.h.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <Eigen/Geometry>

#include <base/error.h>
#include <base/parallel.h>
#include <base/roots.h>
#include <mesh/read_guard.h>
#include <mesh/weld_points.h>

#include "formats/common/written_float.h"
#include "stl_colours.h"
#include "stl_io.h"
#include "stl_regions.h"

namespace meshrepair {
namespace {

static_assert(std::endian::native == std::endian::little, "floats are copied as they are");

constexpr std::size_t kNormalSize = 12;
constexpr std::size_t kCornersSize = 36;
constexpr std::size_t kWrittenPerTask = 16384;

std::uint32_t declared_count(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kStlHeaderText, sizeof count);
  return count;
}

void report_sizes(const MeshSource& source, std::size_t found, ReadReport& report) {
  const std::size_t declared = declared_count(source.bytes);
  report.declared_triangles = declared;
  report.missing_faces = declared > found ? declared - found : 0;
  report.trailing_bytes = source.bytes.size() - kStlHeaderSize - found * kStlTriangleSize;
  if (declared != found) {
    report.warnings.push_back(cut_off("the header", declared, "triangle", found));
  }
  if (report.trailing_bytes > 0) {
    report.warnings.push_back(
        bytes_ignored(report.trailing_bytes, "after the last whole triangle"));
  }
}

float to_float(double coordinate) { return written_float(coordinate, "binary STL"); }

char* put(char* at, const Vec3d& vector) {
  const std::array<float, 3> floats = {to_float(vector.x()), to_float(vector.y()),
                                       to_float(vector.z())};
  std::memcpy(at, floats.data(), sizeof floats);
  return at + sizeof floats;
}

void put_triangle(char* at, const TriangleSoup& soup, std::size_t t, std::uint16_t word) {
  const auto& [a, b, c] = soup.triangles[t];
  at = put(at, stl_normal(soup.points[a], soup.points[b], soup.points[c]));
  at = put(at, soup.points[a]);
  at = put(at, soup.points[b]);
  at = put(at, soup.points[c]);
  std::memcpy(at, &word, sizeof word);
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kStlHeaderSize &&
         bytes.size() - kStlHeaderSize == kStlTriangleSize * std::uint64_t{declared_count(bytes)};
}

ReadResult read_stl_binary(const MeshSource& source) {
  const std::size_t size = source.bytes.size();
  if (size < kStlHeaderSize) source.fail("a binary STL cut within its header of 84 bytes");
  const std::size_t count = (size - kStlHeaderSize) / kStlTriangleSize;

  ReadGuard guard(source);
  guard.require(count);
  ReadResult result;
  result.report.format = SoupFormat::stl_binary;
  report_sizes(source, count, result.report);
  result.soup.triangles.reserve(count);
  // A closed surface has half as many points as triangles.
  PointWelder welder(result.soup.points, count / 2);
  const char* corners = source.bytes.data() + kStlHeaderSize + kNormalSize;
  for (std::size_t i = 0; i < count; ++i, corners += kStlTriangleSize) {
    guard.step(i, kStlHeaderSize + i * kStlTriangleSize);
    std::array<float, 9> c;
    static_assert(sizeof c == kCornersSize);
    std::memcpy(c.data(), corners, sizeof c);
    const std::uint32_t first = welder.index_of({c[0], c[1], c[2]});
    const std::uint32_t second = welder.index_of({c[3], c[4], c[5]});
    const std::uint32_t third = welder.index_of({c[6], c[7], c[8]});
    result.soup.triangles.push_back({first, second, third});
  }
  if (source.options.attributes) {
    result.attributes = read_stl_colours(source.bytes, count);
    if (result.attributes.empty()) {
      result.attributes.groups = read_stl_regions(source.bytes, count);
    }
  }
  return result;
}

std::string format_stl_binary(const TriangleSoup& soup, const Attributes* attributes) {
  StlColours colours = make_stl_colours(attributes, "binary STL by meshrepair");
  if (attributes != nullptr && colours.words.empty()) {
    colours.words = stl_region_words(attributes->groups);
  }
  std::string out = colours.header;
  const auto count = static_cast<std::uint32_t>(soup.triangles.size());
  out.reserve(kStlHeaderSize + kStlTriangleSize * soup.triangles.size());
  out.append(reinterpret_cast<const char*>(&count), sizeof count);
  out.resize(kStlHeaderSize + kStlTriangleSize * soup.triangles.size());
  const auto put_some = [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      put_triangle(out.data() + kStlHeaderSize + t * kStlTriangleSize, soup, t,
                   colours.words.empty() ? std::uint16_t{0} : colours.words[t]);
    }
  };
  try {
    parallel_tasks(soup.triangles.size(), kWrittenPerTask, put_some);
  } catch (const OutputError&) {
    put_some(0, 0, soup.triangles.size());  // fails for the first one, whatever the threads
  }
  return out;
}

Vec3d stl_normal(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d normal = (b - a).cross(c - a);
  const double length = stable_length(normal);
  return std::isfinite(length) && length > 0 ? Vec3d(normal / length) : Vec3d::Zero();
}

}  // namespace meshrepair
