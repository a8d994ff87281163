// SPDX-License-Identifier: MIT
#include "arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <mesh/mesh_limits.h>
#include <mesh/triangulate_polygon.h>

namespace meshrepair {
namespace {

namespace py = pybind11;

// What an int32 can say of an index; -1 is none.
constexpr std::size_t kMostIndices = std::numeric_limits<std::int32_t>::max();

[[noreturn]] void refuse_type(const py::array& array, const std::string& name, const char* wanted) {
  throw UsageError(name + ": has elements of type " + std::string(py::str(array.dtype())) +
                   ", not " + wanted);
}

// Calls take(Number{}) with the type of the elements; false where it is none of those wanted.
template <class Take>
bool with_integer_type(const py::dtype& type, const Take& take) {
  const bool has_sign = type.kind() == 'i';
  if (!has_sign && type.kind() != 'u') return false;
  switch (type.itemsize()) {
    case 1:
      has_sign ? take(std::int8_t{}) : take(std::uint8_t{});
      return true;
    case 2:
      has_sign ? take(std::int16_t{}) : take(std::uint16_t{});
      return true;
    case 4:
      has_sign ? take(std::int32_t{}) : take(std::uint32_t{});
      return true;
    case 8:
      has_sign ? take(std::int64_t{}) : take(std::uint64_t{});
      return true;
    default:
      return false;
  }
}

template <class Take>
bool with_number_type(const py::dtype& type, const Take& take) {
  if (type.kind() == 'f' && type.itemsize() == 8) {
    take(double{});
  } else if (type.kind() == 'f' && type.itemsize() == 4) {
    take(float{});
  } else {
    return with_integer_type(type, take);
  }
  return true;
}

bool has_native_order(const py::dtype& type) { return type.attr("isnative").cast<bool>(); }

void check_rows(const py::array& rows, const std::string& name) {
  if (rows.ndim() == 2 && rows.shape(1) == 3) return;
  throw UsageError(name + ": has shape " + shape_text(rows) + ", not (rows, 3)");
}

// Element (i, j), wherever it lies; it need not be aligned.
template <class Number>
Number element(const py::array& rows, py::ssize_t i, py::ssize_t j) {
  Number value;
  const auto* const bytes = static_cast<const char*>(rows.data());
  std::memcpy(&value, bytes + i * rows.strides(0) + j * rows.strides(1), sizeof value);
  return value;
}

void check_finite(const std::vector<Vec3d>& points, const std::string& name) {
  const auto bad =
      std::find_if(points.begin(), points.end(), [](const Vec3d& p) { return !p.allFinite(); });
  if (bad == points.end()) return;
  throw UsageError(fmt::format("{}: row {} is ({}, {}, {}), which is not finite", name,
                               bad - points.begin(), bad->x(), bad->y(), bad->z()));
}

// One that is out of range is told as it was given.
template <class Integer>
std::uint32_t index_of(Integer given, std::size_t points, py::ssize_t row) {
  if (std::cmp_greater_equal(given, 0) && std::cmp_less(given, points)) {
    return static_cast<std::uint32_t>(given);
  }
  throw UsageError(fmt::format("faces: row {} has the index {}, but there are {} vertices", row,
                               +given, points));
}

void check_count(std::size_t points) {
  if (points > kMostIndices) {
    throw UsageError(fmt::format("vertices: {} rows are more than {}", points, kMostIndices));
  }
}

void append_triangles(const py::array& faces, TriangleSoup& soup) {
  check_rows(faces, "faces");
  require_triangles(static_cast<std::size_t>(faces.shape(0)), "faces");
  soup.triangles.resize(static_cast<std::size_t>(faces.shape(0)));
  const bool known = with_integer_type(faces.dtype(), [&]<class Integer>(Integer) {
    for (py::ssize_t i = 0; i < faces.shape(0); ++i) {
      for (py::ssize_t j = 0; j < 3; ++j) {
        soup.triangles[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
            index_of(element<Integer>(faces, i, j), soup.points.size(), i);
      }
    }
  });
  if (!known || !has_native_order(faces.dtype())) refuse_type(faces, "faces", "integers");
}

}  // namespace

std::string shape_text(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += fmt::format("{}{}", i > 0 ? ", " : "", array.shape(i));
  }
  return "(" + text + (array.ndim() == 1 ? ",)" : ")");
}

std::vector<Vec3d> points_of(const py::array& rows, const std::string& name,
                             bool may_be_not_finite) {
  check_rows(rows, name);
  std::vector<Vec3d> points(static_cast<std::size_t>(rows.shape(0)));
  const bool known = with_number_type(rows.dtype(), [&]<class Number>(Number) {
    for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
      for (py::ssize_t j = 0; j < 3; ++j) {
        points[static_cast<std::size_t>(i)][j] = static_cast<double>(element<Number>(rows, i, j));
      }
    }
  });
  if (!known || !has_native_order(rows.dtype())) refuse_type(rows, name, "numbers");
  if (!may_be_not_finite) check_finite(points, name);
  return points;
}

TriangleSoup soup_of(const py::array& vertices, const py::array& faces, bool may_be_not_finite) {
  TriangleSoup soup;
  soup.points = points_of(vertices, "vertices", may_be_not_finite);
  check_count(soup.points.size());
  append_triangles(faces, soup);
  return soup;
}

std::pair<py::array, py::array> triangulated(const py::array& vertices, const py::array& corners,
                                             const py::array& sizes) {
  const std::vector<Vec3d> points = points_of(vertices, "vertices", true);
  check_count(points.size());
  const auto all = py::array_t<std::int64_t, py::array::c_style>::ensure(corners);
  const auto counts = py::array_t<std::int64_t, py::array::c_style>::ensure(sizes);
  if (!all || !counts) throw UsageError("faces: are no lists of integers");
  auto soup = std::make_shared<TriangleSoup>();
  std::vector<std::uint32_t> polygons;
  std::vector<std::uint32_t> polygon;
  std::vector<std::array<std::uint32_t, 3>> pieces;
  py::ssize_t at = 0;
  for (py::ssize_t i = 0; i < counts.size(); ++i) {
    if (counts.at(i) < 3) {
      throw UsageError(fmt::format("faces: row {} has {} corners, not 3 or more", i, counts.at(i)));
    }
    polygon.clear();
    for (std::int64_t k = 0; k < counts.at(i); ++k, ++at) {
      polygon.push_back(index_of(all.at(at), points.size(), i));
    }
    pieces.clear();
    triangulate_polygon(points, polygon, pieces);
    for (const auto& [a, b, c] : pieces)
      soup->triangles.push_back({polygon[a], polygon[b], polygon[c]});
    polygons.resize(soup->triangles.size(), static_cast<std::uint32_t>(i));
  }
  return {faces_of(soup), indices_of(std::move(polygons))};
}

py::str name_of(const std::string& bytes) {
  return py::bytes(bytes).attr("decode")("utf-8", "surrogateescape");
}

std::string bytes_of(const py::handle& name) {
  return py::str(name).attr("encode")("utf-8", "surrogateescape").cast<std::string>();
}

py::array vertices_of(const std::shared_ptr<TriangleSoup>& soup, bool as_float32) {
  static_assert(sizeof(Vec3d) == 3 * sizeof(double));
  const auto rows = static_cast<py::ssize_t>(soup->points.size());
  if (!as_float32) {
    return view_of(soup, reinterpret_cast<const double*>(soup->points.data()), {rows, 3});
  }
  py::array_t<float> copy({rows, py::ssize_t{3}});
  float* to = copy.mutable_data();
  for (const Vec3d& point : soup->points) {
    for (int k = 0; k < 3; ++k) *to++ = static_cast<float>(point[k]);
  }
  return copy;
}

py::array faces_of(const std::shared_ptr<TriangleSoup>& soup) {
  static_assert(sizeof(soup->triangles[0]) == 3 * sizeof(std::uint32_t));
  return view_of(soup, reinterpret_cast<const std::int32_t*>(soup->triangles.data()),
                 {static_cast<py::ssize_t>(soup->triangles.size()), 3});
}

py::array indices_of(std::vector<std::uint32_t> indices) {
  const auto kept = std::make_shared<std::vector<std::uint32_t>>(std::move(indices));
  return view_of(kept, reinterpret_cast<const std::int32_t*>(kept->data()),
                 {static_cast<py::ssize_t>(kept->size())});
}

}  // namespace meshrepair
