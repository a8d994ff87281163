// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include <base/first_equal.h>
#include <mesh/attributes.h>

namespace meshrepair {
namespace {

bool is_used(const std::vector<std::uint32_t>& first, const std::vector<char>& used,
             std::size_t i) {
  return first[i] == i && used[i] != 0;
}

// Of each value the first that equals it, bit for bit.
std::vector<std::uint32_t> first_values(const CornerAttribute& attribute) {
  const std::size_t n = attribute.components;
  const double* const values = attribute.values.data();
  const auto hash_of = [&](std::size_t i) {
    std::uint64_t hash = 0;
    for (std::size_t k = 0; k < n; ++k) {
      hash = internal::hash_mix(hash, std::bit_cast<std::uint64_t>(values[n * i + k]));
    }
    return hash;
  };
  const auto same = [&](std::size_t i, std::size_t j) {
    return std::memcmp(values + n * i, values + n * j, n * sizeof(double)) == 0;
  };
  return first_equal(attribute.count(), hash_of, same);
}

}  // namespace

std::vector<std::string> Keepsake::lost_in(SoupFormat /*format*/) const { return {}; }

std::shared_ptr<const Keepsake> Keepsake::appended_to(const Keepsake* /*first*/,
                                                      AppendedMaterials& /*materials*/) const {
  return nullptr;
}

const CornerAttribute* find_kind(const Attributes& attributes, CornerAttribute::Kind kind) {
  const auto found =
      std::find_if(attributes.corners.begin(), attributes.corners.end(),
                   [&](const CornerAttribute& attribute) { return attribute.kind == kind; });
  return found == attributes.corners.end() ? nullptr : &*found;
}

void share_values(CornerAttribute& attribute) {
  const std::vector<std::uint32_t> first = first_values(attribute);
  std::vector<char> used(first.size(), 0);
  for (const std::uint32_t value : attribute.of_corner) {
    if (value != kNone) used[first[value]] = 1;
  }
  const auto n = static_cast<std::ptrdiff_t>(attribute.components);
  std::vector<std::uint32_t> number(first.size(), kNone);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!is_used(first, used, i)) continue;
    std::copy_n(attribute.values.begin() + n * static_cast<std::ptrdiff_t>(i), n,
                attribute.values.begin() + n * static_cast<std::ptrdiff_t>(count));
    number[i] = count++;
  }
  attribute.values.resize(attribute.components * count);
  for (std::uint32_t& value : attribute.of_corner) {
    if (value != kNone) value = number[first[value]];
  }
}

std::optional<std::vector<std::uint32_t>> values_by_point(const TriangleSoup& soup,
                                                          const CornerAttribute& attribute) {
  std::vector<std::uint32_t> of_point = first_values_by_point(soup, attribute);
  for (std::size_t i = 0; i < attribute.of_corner.size(); ++i) {
    if (attribute.of_corner[i] != of_point[soup.triangles[i / 3][i % 3]]) return std::nullopt;
  }
  return of_point;
}

std::vector<std::uint32_t> first_values_by_point(const TriangleSoup& soup,
                                                 const CornerAttribute& attribute) {
  std::vector<std::uint32_t> of_point(soup.points.size(), kNone);
  for (std::size_t i = 0; i < attribute.of_corner.size(); ++i) {
    std::uint32_t& value = of_point[soup.triangles[i / 3][i % 3]];
    if (value == kNone) value = attribute.of_corner[i];
  }
  return of_point;
}

std::optional<std::vector<std::uint32_t>> values_by_triangle(const CornerAttribute& attribute) {
  std::vector<std::uint32_t> of_triangle;
  of_triangle.reserve(attribute.of_corner.size() / 3);
  for (std::size_t i = 0; i < attribute.of_corner.size(); i += 3) {
    const std::uint32_t value = attribute.of_corner[i];
    if (attribute.of_corner[i + 1] != value || attribute.of_corner[i + 2] != value) {
      return std::nullopt;
    }
    of_triangle.push_back(value);
  }
  return of_triangle;
}

}  // namespace meshrepair
