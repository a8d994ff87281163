// SPDX-License-Identifier: MIT
#include "generated_inputs.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <base/error.h>
#include <mesh/soup_io.h>

#include "models.h"
#include "shapes.h"

namespace meshrepair::bench {
namespace {

using testing::Random;

constexpr double kMissing = 0.01;      // the share of triangles that holes lacks
constexpr double kCornerNoise = 1e-6;  // of soup, in radii
constexpr double kBumps = 0.3;

// Quads along an edge of the cube that even_sphere() begins with.
std::int64_t quads_for(std::size_t triangles) {
  return std::max<std::int64_t>(1, std::llround(std::sqrt(static_cast<double>(triangles) / 12)));
}

// A sphere without poles, all of whose triangles are of about one size: a cube of n x n quads a
// side, blown up so that angles between neighbours are equal. Turned, so that no edges lie in
// planes of the coordinates.
TriangleSoup even_sphere(std::size_t triangles) {
  const std::int64_t n = quads_for(triangles);
  TriangleSoup soup;
  std::unordered_map<std::int64_t, std::uint32_t> numbers;
  const auto number = [&](const std::array<std::int64_t, 3>& at) {
    const auto [entry, added] = numbers.try_emplace((at[0] * (n + 1) + at[1]) * (n + 1) + at[2],
                                                    static_cast<std::uint32_t>(soup.points.size()));
    if (added) {
      Vec3d p;
      for (int k = 0; k < 3; ++k) {
        const auto along = static_cast<double>(at[static_cast<std::size_t>(k)]);
        p[k] = std::tan(std::numbers::pi / 4 * (2 * along / static_cast<double>(n) - 1));
      }
      soup.points.push_back(p.normalized());
    }
    return entry->second;
  };
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t axis = side % 3, next = (axis + 1) % 3, last = (axis + 2) % 3;
    std::array<std::int64_t, 3> at = {};
    at[axis] = side < 3 ? 0 : n;
    for (std::int64_t i = 0; i < n; ++i) {
      for (std::int64_t j = 0; j < n; ++j) {
        std::array<std::uint32_t, 4> quad = {};
        for (std::size_t k = 0; k < 4; ++k) {
          at[next] = i + (k == 1 || k == 2 ? 1 : 0);
          at[last] = j + (k >= 2 ? 1 : 0);
          quad[k] = number(at);
        }
        if (side < 3) std::swap(quad[1], quad[3]);
        soup.triangles.push_back({quad[0], quad[1], quad[2]});
        soup.triangles.push_back({quad[0], quad[2], quad[3]});
      }
    }
  }
  Random random(1);
  return testing::transformed(std::move(soup), testing::random_rotation(random));
}

TriangleSoup moved_at_random(TriangleSoup soup, double by, std::uint64_t seed) {
  Random random(seed);
  for (Vec3d& p : soup.points) {
    p += Vec3d(random.real(-by, by), random.real(-by, by), random.real(-by, by));
  }
  return soup;
}

std::array<TriangleSoup, 2> bumpy_bodies(std::size_t triangles) {
  Random random(2);
  const TriangleSoup second = bumpy(even_sphere(triangles / 2), kBumps, 4);
  return {bumpy(even_sphere(triangles / 2), kBumps, 3),
          testing::moved(testing::transformed(second, testing::random_rotation(random)),
                         {0.7, 0.31, 0.17})};
}

TriangleSoup bumpy_mesh(std::size_t triangles) {
  auto [mesh, second] = bumpy_bodies(triangles);
  testing::append(mesh, second);
  return mesh;
}

TriangleSoup holes(std::size_t triangles) {
  return testing::without_some(even_sphere(triangles), kMissing, 5);
}

TriangleSoup noisy(std::size_t triangles) {
  const double edge = std::numbers::pi / 2 / static_cast<double>(quads_for(triangles));
  return moved_at_random(even_sphere(triangles), edge, 6);
}

TriangleSoup cubes(std::size_t count) { return testing::random_cubes(count, 1); }

TriangleSoup soup(std::size_t triangles) {
  const TriangleSoup whole = even_sphere(triangles);
  TriangleSoup apart;
  for (const auto& t : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.points.size());
    for (const std::uint32_t corner : t) apart.points.push_back(whole.points[corner]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  return moved_at_random(std::move(apart), kCornerNoise, 7);
}

// Evenly by area: the outside of the ring has more than the inside.
std::vector<Vec3d> points_on_torus(std::size_t count) {
  constexpr double kLarge = 2, kSmall = 0.7;
  Random random(8);
  std::vector<Vec3d> points;
  while (points.size() < count) {
    const double a = random.real(0, 2 * std::numbers::pi);
    const double b = random.real(0, 2 * std::numbers::pi);
    const double from_axis = kLarge + kSmall * std::cos(b);
    if (!random.chance(from_axis / (kLarge + kSmall))) continue;
    points.emplace_back(from_axis * std::cos(a), from_axis * std::sin(a), kSmall * std::sin(b));
  }
  return points;
}

void write_points(const std::vector<Vec3d>& points, const std::filesystem::path& path) {
  std::ofstream file(path);
  std::array<char, 96> line = {};
  for (const Vec3d& p : points) {
    const int size =
        std::snprintf(line.data(), line.size(), "%.17g %.17g %.17g\n", p.x(), p.y(), p.z());
    file.write(line.data(), size);
  }
  file.close();
  if (!file) throw OutputError(path.string() + ": cannot be written");
}

using Maker = TriangleSoup (*)(std::size_t);
constexpr std::array<std::pair<std::string_view, Maker>, 7> kMeshes = {
    {{"clean", even_sphere},
     {"holes", holes},
     {"bumpy", bumpy_mesh},
     {"noisy", noisy},
     {"cubes", cubes},
     {"soup", soup},
     {"spheres", testing::two_overlapping_spheres}}};

// What stands before the colon and behind it; throws UsageError if that is no number above 0.
std::pair<std::string_view, std::size_t> kind_and_size(const std::string& name) {
  const std::size_t colon = std::min(name.find(':'), name.size());
  const char* const end = name.data() + name.size();
  std::size_t size = 0;
  const auto [stop, error] = std::from_chars(std::min(name.data() + colon + 1, end), end, size);
  if (error != std::errc() || stop != end || size == 0) {
    throw UsageError(name + " is no KIND:N, as clean:10000");
  }
  return {std::string_view(name).substr(0, colon), size};
}

const auto* find_mesh(std::string_view kind) {
  const auto* const found =
      std::find_if(kMeshes.begin(), kMeshes.end(), [&](const auto& m) { return m.first == kind; });
  return found == kMeshes.end() ? nullptr : found;
}

}  // namespace

bool is_generated_mesh(const std::string& name) {
  const std::size_t colon = name.find(':');
  return colon != std::string::npos &&
         find_mesh(std::string_view(name).substr(0, colon)) != nullptr;
}

TriangleSoup generated_mesh(const std::string& name) {
  const auto [kind, size] = kind_and_size(name);
  const auto* const mesh = find_mesh(kind);
  if (mesh == nullptr) throw UsageError("no input is called " + name);
  return mesh->second(size);
}

std::vector<std::filesystem::path> write_generated(const std::string& name,
                                                   const std::filesystem::path& folder) {
  const auto [kind, size] = kind_and_size(name);
  const std::filesystem::path file = folder / (std::string(kind) + "_" + std::to_string(size));
  std::vector<std::filesystem::path> files;
  const auto write = [&](const TriangleSoup& mesh, const char* end) {
    files.push_back(file.string() + end);
    write_soup(mesh, files.back(), {});
  };
  if (kind == "cloud") {
    files.push_back(file.string() + ".xyz");
    write_points(points_on_torus(size), files.back());
  } else if (kind == "union") {
    const std::array<TriangleSoup, 2> bodies = bumpy_bodies(size);
    write(bodies[0], "_a.off");
    write(bodies[1], "_b.off");
  } else {
    write(generated_mesh(name), ".off");
  }
  return files;
}

}  // namespace meshrepair::bench
