// SPDX-License-Identifier: MIT
#include "attribute_arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <base/ids.h>

#include "arrays.h"
#include "calls/attribute_keys.h"

namespace meshrepair {
namespace {

namespace py = pybind11;

using Kind = CornerAttribute::Kind;
using OfWhat = CornerAttribute::Place;
using Storage = CornerAttribute::Storage;

struct LabelName {
  std::string_view name;
  TriangleLabels Attributes::*labels;
};

constexpr std::array<LabelName, 4> kLabels = {{{"material", &Attributes::materials},
                                               {"group", &Attributes::groups},
                                               {"object", &Attributes::objects},
                                               {"smoothing", &Attributes::smoothing}}};

// Of the values with these numbers; NaN, or 0 where there is none, for no value.
template <class Number>
py::array gathered(const CornerAttribute& attribute, const std::vector<std::uint32_t>& of,
                   std::vector<py::ssize_t> shape, double scale) {
  shape.push_back(static_cast<py::ssize_t>(attribute.components));
  py::array_t<Number> array(shape);
  Number* to = array.mutable_data();
  for (const std::uint32_t number : of) {
    for (std::size_t k = 0; k < attribute.components; ++k) {
      *to++ =
          number == kNone
              ? std::numeric_limits<Number>::quiet_NaN()
              : static_cast<Number>(attribute.values[number * attribute.components + k] * scale);
    }
  }
  return array;
}

py::array array_of(const CornerAttribute& attribute, const TriangleSoup& soup) {
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(soup.triangles.size())};
  std::optional<std::vector<std::uint32_t>> of;
  if (attribute.place == OfWhat::point) of = values_by_point(soup, attribute);
  if (of) {
    shape = {static_cast<py::ssize_t>(soup.points.size())};
  } else if (attribute.place == OfWhat::triangle) {
    of = values_by_triangle(attribute);
  }
  if (!of) {
    of = attribute.of_corner;
    shape.push_back(3);
  }
  const bool complete = std::find(of->begin(), of->end(), kNone) == of->end();
  if (attribute.storage == Storage::byte && complete) {
    py::array_t<double> shares = gathered<double>(attribute, *of, shape, 255);
    std::transform(shares.data(), shares.data() + shares.size(), shares.mutable_data(),
                   [](double value) { return std::round(value); });
    return shares.attr("astype")("uint8");
  }
  if (attribute.storage == Storage::integer && complete) {
    return gathered<std::int64_t>(attribute, *of, shape, 1);
  }
  if (attribute.storage == Storage::real32) return gathered<float>(attribute, *of, shape, 1);
  return gathered<double>(attribute, *of, shape, 1);
}

struct Layout {
  OfWhat place = OfWhat::point;
  std::size_t components = 1;
};

Layout layout_of(const py::array& array, const std::string& key, const TriangleSoup& soup) {
  const auto points = static_cast<py::ssize_t>(soup.points.size());
  const auto triangles = static_cast<py::ssize_t>(soup.triangles.size());
  const py::ssize_t rows = array.ndim() > 0 ? array.shape(0) : -1;
  const auto last = [&] { return static_cast<std::size_t>(array.shape(array.ndim() - 1)); };
  if (array.ndim() == 3 && rows == triangles && array.shape(1) == 3 && last() > 0) {
    return {OfWhat::corner, last()};
  }
  const bool is_table = array.ndim() == 1 || (array.ndim() == 2 && last() > 0);
  if (is_table && (rows == points || rows == triangles)) {
    return {rows == points ? OfWhat::point : OfWhat::triangle, array.ndim() == 1 ? 1 : last()};
  }
  throw UsageError(
      fmt::format("attributes: {} has shape {}, not ({}, k), a row for each vertex, nor ({}, k), "
                  "for each face, "
                  "nor ({}, 3, k), for each corner",
                  key, shape_text(array), points, triangles, triangles));
}

// The number of the value of each corner, where each of the place has one of its own.
std::vector<std::uint32_t> corners_at(OfWhat place, const TriangleSoup& soup) {
  std::vector<std::uint32_t> of_corner(3 * soup.triangles.size());
  for (std::size_t c = 0; c < of_corner.size(); ++c) {
    of_corner[c] = place == OfWhat::corner     ? static_cast<std::uint32_t>(c)
                   : place == OfWhat::triangle ? static_cast<std::uint32_t>(c / 3)
                                               : soup.triangles[c / 3][c % 3];
  }
  return of_corner;
}

Storage storage_of(const py::dtype& type, bool is_colour) {
  if (is_colour && type.kind() == 'u' && type.itemsize() == 1) return Storage::byte;
  if (type.kind() == 'i' || type.kind() == 'u') return Storage::integer;
  return type.itemsize() == 4 ? Storage::real32 : Storage::real64;
}

void forget_missing(CornerAttribute& attribute) {
  for (std::uint32_t& number : attribute.of_corner) {
    const auto first =
        attribute.values.begin() + static_cast<std::ptrdiff_t>(number * attribute.components);
    const auto last = first + static_cast<std::ptrdiff_t>(attribute.components);
    if (std::any_of(first, last, [](double value) { return std::isnan(value); })) number = kNone;
  }
}

CornerAttribute corner_attribute(const std::string& key, const py::array& array,
                                 const TriangleSoup& soup) {
  const char type = array.dtype().kind();
  if (type != 'f' && type != 'i' && type != 'u') {
    throw UsageError("attributes: " + key + " has elements of type " +
                     std::string(py::str(array.dtype())) + ", not numbers");
  }
  const Layout layout = layout_of(array, key, soup);
  CornerAttribute attribute;
  attribute.kind = kind_of_key(key);
  attribute.name = attribute.kind == Kind::other ? key : std::string();
  attribute.place = layout.place;
  attribute.storage = storage_of(array.dtype(), attribute.kind == Kind::colour);
  attribute.components = layout.components;
  const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!values) throw UsageError("attributes: " + key + " cannot be read as numbers");
  attribute.values.assign(values.data(), values.data() + values.size());
  if (attribute.storage == Storage::byte) {
    for (double& value : attribute.values) value /= 255;
  }
  attribute.of_corner = corners_at(layout.place, soup);
  forget_missing(attribute);
  share_values(attribute);
  return attribute;
}

TriangleLabels labels_of(const std::string& key, const py::dict& arrays, const TriangleSoup& soup) {
  const std::string names_key = key + "_names";
  if (!arrays.contains(names_key)) {
    throw UsageError("attributes: " + key + " needs " + names_key);
  }
  const auto given = py::array::ensure(arrays[key.c_str()]);
  if (!given || given.ndim() != 1 || (given.dtype().kind() != 'i' && given.dtype().kind() != 'u') ||
      given.shape(0) != static_cast<py::ssize_t>(soup.triangles.size())) {
    throw UsageError("attributes: " + key + " is no list of integers, one for each face");
  }
  TriangleLabels labels;
  const py::object names = arrays[names_key.c_str()];
  if (py::isinstance<py::str>(names)) throw UsageError("attributes: " + names_key + " is no list");
  for (const py::handle name : names) labels.names.push_back(bytes_of(name));
  // Numbers that int64 cannot hold become negative ones, which are none.
  const auto numbers =
      py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!numbers) throw UsageError("attributes: " + key + " cannot be read as integers");
  labels.of_triangle.reserve(soup.triangles.size());
  for (py::ssize_t i = 0; i < numbers.size(); ++i) {
    const std::int64_t number = numbers.at(i);
    if (number < -1 || std::cmp_greater_equal(number, labels.names.size())) {
      throw UsageError(fmt::format("attributes: {}: row {} is {}, but there are {} names", key, i,
                                   number, labels.names.size()));
    }
    labels.of_triangle.push_back(number < 0 ? kNone : static_cast<std::uint32_t>(number));
  }
  return labels;
}

bool is_label(std::string_view key) {
  return std::any_of(kLabels.begin(), kLabels.end(), [&](const LabelName& label) {
    return key == label.name || key == std::string(label.name) + "_names";
  });
}

}  // namespace

py::dict dict_of(const Attributes& attributes, const TriangleSoup& soup) {
  py::dict arrays;
  std::map<Kind, std::size_t> count;
  for (const CornerAttribute& attribute : attributes.corners) {
    arrays[name_of(attribute_key(attribute, count[attribute.kind]++))] = array_of(attribute, soup);
  }
  for (const auto& [name, labels] : kLabels) {
    const TriangleLabels& of = attributes.*labels;
    if (of.empty()) continue;
    arrays[py::str(std::string(name))] = indices_of(of.of_triangle);
    py::list names;
    for (const std::string& one : of.names) names.append(name_of(one));
    arrays[py::str(std::string(name) + "_names")] = names;
  }
  return arrays;
}

namespace {

// "texture_2" comes after "texture_1", wherever both stand in the dict.
bool is_before(const std::string& a, const std::string& b) {
  const Kind kind = kind_of_key(a);
  if (kind != kind_of_key(b)) return kind < kind_of_key(b);
  return kind != Kind::other && std::pair(a.size(), a) < std::pair(b.size(), b);
}

// Throws UsageError where a key is no text.
std::vector<std::string> keys_in_order(const py::dict& arrays) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : arrays) {
    if (!py::isinstance<py::str>(key)) throw UsageError("attributes: keys are names");
    keys.push_back(bytes_of(key));
  }
  std::stable_sort(keys.begin(), keys.end(), is_before);
  return keys;
}

}  // namespace

Attributes attributes_of(const py::dict& arrays, const TriangleSoup& soup,
                         const Attributes* known) {
  Attributes attributes;
  for (const auto& [name, labels] : kLabels) {
    const std::string key(name);
    if (arrays.contains(key)) attributes.*labels = labels_of(key, arrays, soup);
  }
  for (const std::string& key : keys_in_order(arrays)) {
    if (is_label(key)) continue;
    const auto array = py::array::ensure(arrays[name_of(key)]);
    if (!array) throw UsageError("attributes: " + key + " is no array");
    attributes.corners.push_back(corner_attribute(key, array, soup));
    check_components(attributes.corners.back(), "attributes: " + key);
  }
  if (known != nullptr && known->materials.names == attributes.materials.names) {
    attributes.looks = known->looks;
    attributes.images = known->images;
  }
  return attributes;
}

}  // namespace meshrepair
