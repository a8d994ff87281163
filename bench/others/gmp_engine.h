// SPDX-License-Identifier: MIT
// The exact predicate as Wang and Manocha describe it (section 5): a determinant in doubles, and
// where it is smaller than 1e-10, in the arithmetic of GMP. For comparison only.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <gmpxx.h>

#include <extract/predicate_engine.h>

namespace meshrepair::bench {

class GmpEngine final : public PredicateEngine {
 public:
  [[nodiscard]] bool exact() const override { return true; }
  int side(const Point& point, PlaneId plane, const PlaneTable& planes) override {
    return point.is_lattice() ? side_of_lattice(point, planes[plane])
                              : side_of_meet(point, plane, planes);
  }

  // A point is its three planes; the coordinates are for the result alone.
  Point cross(const Point& a, const Point& b, PlaneId p, PlaneId q, PlaneId plane,
              const PlaneTable& planes) override {
    const auto& u = a.position;
    const auto& v = b.position;
    Point point =
        meet(planes, p, q, plane, {0.5 * (u[0] + v[0]), 0.5 * (u[1] + v[1]), 0.5 * (u[2] + v[2])});
    point.planes = {p, q, plane};
    return point;
  }

  [[nodiscard]] std::size_t exact_calls() const { return exact_calls_; }

 private:
  static constexpr double kFilter = 1e-10;
  // Brings offsets to the unit box.
  static constexpr double kScale = 0x1p-26;

  static mpz_class big(Int128 value) {
    const bool negative = value < 0;
    __extension__ using Bits = unsigned __int128;
    Bits rest = negative ? -static_cast<Bits>(value) : static_cast<Bits>(value);
    mpz_class result = static_cast<unsigned long>(rest >> 64);
    result <<= 64;
    result += static_cast<unsigned long>(rest);
    return negative ? mpz_class(-result) : result;
  }

  int side_of_lattice(const Point& point, const Plane& plane) {
    const double distance = kScale * signed_distance(point.position, plane);
    if (std::abs(distance) >= kFilter) return distance > 0 ? 1 : -1;
    ++exact_calls_;
    mpz_class sum = big(plane.offset);
    for (std::size_t i = 0; i < 3; ++i) {
      sum += mpz_class(static_cast<long>(plane.normal[i])) *
             mpz_class(static_cast<long>(point.position[i]));
    }
    return sgn(sum);
  }

  template <class T>
  static T determinant3(const std::array<std::array<T, 4>, 4>& m, std::size_t row, std::size_t a,
                        std::size_t b, std::size_t c) {
    std::array<const std::array<T, 4>*, 3> r{};
    for (std::size_t i = 0, k = 0; i < 4; ++i) {
      if (i != row) r[k++] = &m[i];
    }
    const T x = (*r[1])[b] * (*r[2])[c] - (*r[1])[c] * (*r[2])[b];
    const T y = (*r[1])[c] * (*r[2])[a] - (*r[1])[a] * (*r[2])[c];
    const T z = (*r[1])[a] * (*r[2])[b] - (*r[1])[b] * (*r[2])[a];
    return (*r[0])[a] * x + (*r[0])[b] * y + (*r[0])[c] * z;
  }

  // The sign of the 4 x 4 determinant over that of the first three normals.
  template <class T>
  static std::array<T, 2> determinants(const std::array<std::array<T, 4>, 4>& m) {
    const T whole = m[3][3] * determinant3(m, 3, 0, 1, 2) - m[3][2] * determinant3(m, 3, 0, 1, 3) +
                    m[3][1] * determinant3(m, 3, 0, 2, 3) - m[3][0] * determinant3(m, 3, 1, 2, 3);
    return {whole, determinant3(m, 3, 0, 1, 2)};
  }

  int side_of_meet(const Point& point, PlaneId plane, const PlaneTable& planes) {
    const std::array<PlaneId, 4> ids = {point.planes[0], point.planes[1], point.planes[2], plane};
    std::array<std::array<double, 4>, 4> near{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Plane& p = planes[ids[i]];
      near[i] = {p.unit[0], p.unit[1], p.unit[2], kScale * p.unit_offset};
    }
    const auto rounded = determinants(near);
    if (std::abs(rounded[0]) >= kFilter && std::abs(rounded[1]) >= kFilter) {
      return (rounded[0] > 0) == (rounded[1] > 0) ? 1 : -1;
    }
    ++exact_calls_;
    std::array<std::array<mpz_class, 4>, 4> full;
    for (std::size_t i = 0; i < 4; ++i) {
      const Plane& p = planes[ids[i]];
      for (std::size_t k = 0; k < 3; ++k) full[i][k] = static_cast<long>(p.normal[k]);
      full[i][3] = big(p.offset);
    }
    const auto exact = determinants(full);
    return sgn(exact[0]) * sgn(exact[1]);
  }

  std::size_t exact_calls_ = 0;
};

}  // namespace meshrepair::bench
