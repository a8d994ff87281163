// SPDX-License-Identifier: MIT
// Between arrays of numpy and meshes. What comes in is copied once, whatever its layout, as the
// libraries own what they work on; what goes out is a view of their memory, without a copy.
#pragma once

#include <cstdint>
#include <memory>
#include <pybind11/numpy.h>
#include <string>
#include <utility>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

// "(8, 2)", for messages.
[[nodiscard]] std::string shape_text(const pybind11::array& array);

// Rows of three numbers, of float32, float64 or integers of any size and strides. Throws UsageError
// that begins with `name`, and names the row, where they are no such rows, or not finite, unless
// that may be.
[[nodiscard]] std::vector<Vec3d> points_of(const pybind11::array& rows, const std::string& name,
                                           bool may_be_not_finite);

// The mesh of these vertices and faces, rows of three integers of any size and strides. Throws
// UsageError, also where a face names a vertex that is not there.
[[nodiscard]] TriangleSoup soup_of(const pybind11::array& vertices, const pybind11::array& faces,
                                   bool may_be_not_finite);

// All corners of polygons, one after the other, and how many each has: to triangles, as the readers
// of files do, and of each triangle its polygon. Throws UsageError as above.
[[nodiscard]] std::pair<pybind11::array, pybind11::array> triangulated(
    const pybind11::array& vertices, const pybind11::array& corners, const pybind11::array& sizes);

// Names are bytes, which need be no UTF-8: what is none goes through str and back unchanged.
[[nodiscard]] pybind11::str name_of(const std::string& bytes);
[[nodiscard]] std::string bytes_of(const pybind11::handle& name);

// Memory of an owner as an array, which keeps it alive.
template <class Number, class Owner>
pybind11::array view_of(const std::shared_ptr<Owner>& owner, const Number* data,
                        const std::vector<pybind11::ssize_t>& shape) {
  auto* const kept = new std::shared_ptr<Owner>(owner);
  const pybind11::capsule base(kept,
                               [](void* it) { delete static_cast<std::shared_ptr<Owner>*>(it); });
  return pybind11::array(pybind11::dtype::of<Number>(), shape, data, base);
}

// (n, 3) float64, a view; with `as_float32` a copy, as points are double in memory.
[[nodiscard]] pybind11::array vertices_of(const std::shared_ptr<TriangleSoup>& soup,
                                          bool as_float32);
// (m, 3) int32, a view.
[[nodiscard]] pybind11::array faces_of(const std::shared_ptr<TriangleSoup>& soup);
// (m) int32, a view; all ones are -1.
[[nodiscard]] pybind11::array indices_of(std::vector<std::uint32_t> indices);

}  // namespace meshrepair
