// SPDX-License-Identifier: MIT
// What holds for every file that a reader of meshes takes, and for every soup that a writer gets.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <base/error.h>
#include <mesh/soup_io.h>

#include "fuzz_input.h"

namespace meshrepair::testing {

inline void require_valid_indices(const TriangleSoup& soup) {
  for (const auto& triangle : soup.triangles) {
    for (const std::uint32_t corner : triangle) {
      require(corner < soup.points.size(), "an index is out of range");
    }
  }
}

inline void require_one_line(const std::string& message) {
  require(!message.empty(), "a message is empty");
  require(message.find('\n') == std::string::npos, "a message has several lines: " + message);
}

inline void require_consistent(const ReadResult& result, std::size_t bytes) {
  const ReadReport& report = result.report;
  require(!result.soup.triangles.empty(), "a soup without triangles was not refused");
  const bool is_packed = report.packed.packing != Packing::none;
  require((is_packed ? report.packed.bytes : report.bytes) == bytes,
          "the report has another number of bytes");
  require(report.polygons <= result.soup.triangles.size(), "more polygons than triangles");
  require(report.missing_faces <= report.declared_triangles, "more missing than declared");
  require(report.trailing_bytes < report.bytes, "more trailing bytes than bytes");
  for (const Warning& warning : report.warnings) require_one_line(warning.text);
  const std::size_t lost =
      report.bad_faces + report.bad_points + report.missing_faces + report.trailing_bytes;
  require(lost == 0 || !report.warnings.empty(), "something was lost without a warning");
}

// All kinds of NaN are one.
inline bool same_number(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline bool same_point(const Vec3d& a, const Vec3d& b) {
  return same_number(a.x(), b.x()) && same_number(a.y(), b.y()) && same_number(a.z(), b.z());
}

inline bool same_soup(const TriangleSoup& a, const TriangleSoup& b) {
  return a.triangles == b.triangles &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same_point);
}

// The points in the order in which triangles name them first, the others left out: what of a
// numbering survives a format without indices.
inline TriangleSoup numbered_by_use(const TriangleSoup& soup) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(soup.points.size(), kNone);
  TriangleSoup result;
  for (auto triangle : soup.triangles) {
    for (std::uint32_t& corner : triangle) {
      std::uint32_t& n = number[corner];
      if (n == kNone) {
        n = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(soup.points[corner]);
      }
      corner = n;
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

// Some finite coordinate of a triangle is beyond single precision.
inline bool overflows_float32(const TriangleSoup& soup) {
  const auto overflows = [](double x) {
    return std::isfinite(x) && std::abs(x) > double{std::numeric_limits<float>::max()};
  };
  return std::any_of(soup.triangles.begin(), soup.triangles.end(), [&](const auto& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
      const Vec3d& p = soup.points[corner];
      return overflows(p.x()) || overflows(p.y()) || overflows(p.z());
    });
  });
}

inline bool is_finite(const TriangleSoup& soup) {
  return std::all_of(soup.points.begin(), soup.points.end(),
                     [](const Vec3d& point) { return point.allFinite(); });
}

// What is written comes back bit for bit, without a word.
inline void require_round_trip(const TriangleSoup& soup, SoupFormat format) {
  const std::string name(format_name(format));
  std::string bytes;
  try {
    bytes = format_soup(soup, format);
  } catch (const OutputError&) {
    const bool may_fail = (is_single(format) && overflows_float32(soup)) ||
                          (format == SoupFormat::threemf && !is_finite(soup));
    require(may_fail, name + " was not written");
    return;
  }
  require(!is_single(format) || !overflows_float32(soup), "overflow was written");
  const ReadResult back = read_soup(std::string_view(bytes), "back");
  require(back.report.format == format, name + " is read as another format");
  require(back.report.warnings.empty(), name + " that we wrote is warned of");
  require_consistent(back, bytes.size());
  TriangleSoup expected = as_read_back(soup, format);
  if (welds_points(format)) {
    // Different kinds of NaN stay different points only where the format can tell them apart.
    for (const Vec3d& p : soup.points) {
      if (p.hasNaN()) return;
    }
    expected = numbered_by_use(expected);
  }
  require(same_soup(back.soup, expected), name + " comes back as another soup");
}

inline void require_round_trips(const TriangleSoup& soup) {
  for (const SoupFormat format : {SoupFormat::stl_binary, SoupFormat::stl_ascii, SoupFormat::obj,
                                  SoupFormat::off, SoupFormat::ply_binary, SoupFormat::ply_ascii,
                                  SoupFormat::glb, SoupFormat::gltf, SoupFormat::threemf}) {
    require_round_trip(soup, format);
  }
}

// Any bytes are a soup, or one line that says why not.
inline void check_reading(const std::uint8_t* data, std::size_t size, const std::string& name) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ReadResult result;
  try {
    result = read_soup(bytes, name);
  } catch (const InputError& error) {
    require_one_line(error.what());
    return;
  }
  require_valid_indices(result.soup);
  require_consistent(result, size);
  require_round_trips(result.soup);
}

}  // namespace meshrepair::testing
