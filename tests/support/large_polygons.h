// SPDX-License-Identifier: MIT
// Polygons of very many corners, for tests.
#pragma once

#include <cmath>
#include <complex>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::testing {

// Koch's curve, outward on each side of a regular polygon that turns to the left: sides * 4^level
// corners, reflex in two of five.
inline std::vector<Vec3d> koch_curve(int sides, int level) {
  using Complex = std::complex<double>;
  std::vector<Complex> corners;
  corners.reserve(static_cast<std::size_t>(sides));
  for (int i = 0; i < sides; ++i)
    corners.push_back(std::polar(1.0, 2 * std::numbers::pi * i / sides));
  for (int l = 0; l < level; ++l) {
    std::vector<Complex> longer;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Complex a = corners[i];
      const Complex d = (corners[(i + 1) % corners.size()] - a) / 3.0;
      for (const Complex& c :
           {a, a + d, a + d + d * std::polar(1.0, -std::numbers::pi / 3), a + 2.0 * d}) {
        longer.push_back(c);
      }
    }
    corners = longer;
  }
  std::vector<Vec3d> points;
  points.reserve(corners.size());
  for (const Complex& c : corners) points.emplace_back(c.real(), c.imag(), 0);
  return points;
}

// A corridor that winds in `turns` times, of about `corners` corners.
inline std::vector<Vec3d> spiral(int turns, int corners) {
  std::vector<Vec3d> points;
  const auto add = [&](double along, double from) {
    const double angle = 2 * std::numbers::pi * turns * along;
    const double radius = from + angle;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  for (int i = 0; i < corners / 2; ++i) add(2.0 * i / corners, 4);
  for (int i = corners / 2; i-- > 0;) add(2.0 * i / corners, 1);
  return points;
}

// As a file in OFF: a prism of height 0.1 whose two caps are one face each. The base turns to the
// left.
inline std::string prism_off(const std::vector<Vec3d>& base) {
  const std::size_t n = base.size();
  std::ostringstream file;
  file << "OFF\n" << 2 * n << ' ' << n + 2 << " 0\n" << std::setprecision(17);
  for (const double z : {0.0, 0.1}) {
    for (const Vec3d& p : base) file << p.x() << ' ' << p.y() << ' ' << z << '\n';
  }
  file << n;
  for (std::size_t i = n; i-- > 0;) file << ' ' << i;
  file << '\n' << n;
  for (std::size_t i = 0; i < n; ++i) file << ' ' << n + i;
  file << '\n';
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    file << "4 " << i << ' ' << j << ' ' << n + j << ' ' << n + i << '\n';
  }
  return file.str();
}

}  // namespace meshrepair::testing
