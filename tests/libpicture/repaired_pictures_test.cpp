// SPDX-License-Identifier: MIT
// Pictures of textured meshes before and after their repair differ only where something was
// repaired. The meshes are those of scripts/make_textured_pictures.py.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <base/ids.h>
#include <mesh/soup_io.h>
#include <picture/draw_mesh.h>
#include <repair/repair.h>
#include <repair/transfer_attributes.h>

#include "temporary_folder.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

constexpr PictureSize kSize = {320, 240};
constexpr int kSmall = 8;   // of 255, from rounding where triangles were cut
constexpr int kPixels = 1;  // around what was repaired

using Place = std::array<double, 3>;
using Edge = std::pair<Place, Place>;  // the lesser end first

Place place_of(const Vec3d& p) { return {p[0], p[1], p[2]}; }

Edge edge_of(const TriangleSoup& soup, std::size_t triangle, std::size_t k) {
  const auto& corners = soup.triangles[triangle];
  const Place a = place_of(soup.points[corners[k]]);
  const Place b = place_of(soup.points[corners[(k + 1) % 3]]);
  return {std::min(a, b), std::max(a, b)};
}

// Turned so that the least corner comes first.
std::array<Place, 3> places_of(const TriangleSoup& soup, std::size_t triangle) {
  std::array<Place, 3> places;
  for (std::size_t k = 0; k < 3; ++k) {
    places[k] = place_of(soup.points[soup.triangles[triangle][k]]);
  }
  std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
  return places;
}

struct Repaired {
  ReadResult before;
  Surface surface;
  Attributes attributes;
};

Repaired repaired(const fs::path& path, SoupFormat format) {
  Repaired all;
  ReadOptions reading;
  reading.attributes = true;
  all.before = read_soup(path, reading);
  RepairOptions options;
  if (is_single(format)) options.certify.precision = Precision::float32;
  keep_attributes(all.before.soup, all.before.attributes, options);
  RepairReport report;
  all.surface = repair(all.before.soup, options, report);
  all.attributes = transfer_attributes(all.before.soup, all.before.attributes, all.surface);
  return all;
}

// Pixels, marked one by one.
class Mask {
 public:
  void mark(int x, int y) {
    if (x < 0 || y < 0 || x >= static_cast<int>(kSize.width) || y >= static_cast<int>(kSize.height))
      return;
    marked_[static_cast<std::size_t>(y) * kSize.width + static_cast<std::size_t>(x)] = 1;
  }
  [[nodiscard]] bool is_marked(std::size_t pixel) const { return marked_[pixel] != 0; }
  [[nodiscard]] auto count() const { return std::count(marked_.begin(), marked_.end(), 1); }

  // And all that is so near to a pixel that is marked.
  [[nodiscard]] Mask grown(int by) const {
    Mask grown;
    for (std::size_t i = 0; i < marked_.size(); ++i) {
      if (marked_[i] == 0) continue;
      const int x = static_cast<int>(i % kSize.width), y = static_cast<int>(i / kSize.width);
      for (int dy = -by; dy <= by; ++dy) {
        for (int dx = -by; dx <= by; ++dx) grown.mark(x + dx, y + dy);
      }
    }
    return grown;
  }

 private:
  std::vector<char> marked_ = std::vector<char>(kSize.pixels(), 0);
};

// Where something was repaired, hidden or not.
class RepairedPlaces {
 public:
  RepairedPlaces(const Repaired& all, const Camera& camera)
      : before_(all.before.soup), surface_(all.surface), camera_(camera) {
    mark_patches_and_turned();
    mark_curves();
  }

  [[nodiscard]] const Mask& mask() const { return mask_; }

 private:
  void mark_patches_and_turned() {
    TriangleSoup chosen = surface_.mesh;
    chosen.triangles.clear();
    for (std::size_t t = 0; t < surface_.mesh.triangles.size(); ++t) {
      const std::uint32_t source = surface_.source[t];
      if (source == Surface::kNoSource || is_turned(t, source)) {
        chosen.triangles.push_back(surface_.mesh.triangles[t]);
      }
    }
    DrawOptions options;
    options.background = {0, 0, 0, 0};
    Textures textures;
    const Pixels pixels = draw_mesh(chosen, {}, camera_, textures, options);
    for (std::size_t i = 0; i < pixels.values.size(); ++i) {
      if (pixels.values[i][3] == 0) continue;
      mask_.mark(static_cast<int>(i % kSize.width), static_cast<int>(i / kSize.width));
    }
  }

  // It has the corners of its source the other way round.
  bool is_turned(std::size_t t, std::uint32_t source) const {
    std::array<Place, 3> was = places_of(before_, source);
    std::swap(was[1], was[2]);
    return places_of(surface_.mesh, t) == was;
  }

  // Edges between pieces of triangles that were no neighbours before.
  void mark_curves() {
    std::map<Edge, std::vector<std::uint32_t>> sources;
    for (std::size_t t = 0; t < surface_.mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        sources[edge_of(surface_.mesh, t, k)].push_back(surface_.source[t]);
      }
    }
    for (const auto& [edge, of] : sources) {
      if (of.size() != 2 || of[0] == of[1]) continue;
      const bool is_rim = of[0] == Surface::kNoSource || of[1] == Surface::kNoSource;
      if (is_rim || !were_neighbours(of[0], of[1])) mark_line(edge);
    }
  }

  bool were_neighbours(std::uint32_t a, std::uint32_t b) const {
    const std::array<Place, 3> one = places_of(before_, a), other = places_of(before_, b);
    return std::count_if(one.begin(), one.end(), [&](const Place& p) {
             return std::find(other.begin(), other.end(), p) != other.end();
           }) >= 2;
  }

  void mark_line(const Edge& edge) {
    const Camera::Place a = camera_.place(Vec3d(edge.first[0], edge.first[1], edge.first[2]));
    const Camera::Place b = camera_.place(Vec3d(edge.second[0], edge.second[1], edge.second[2]));
    const int steps = 1 + static_cast<int>(4 * (std::abs(a.x - b.x) + std::abs(a.y - b.y)));
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      mask_.mark(static_cast<int>(a.x + share * (b.x - a.x)),
                 static_cast<int>(a.y + share * (b.y - a.y)));
    }
  }

  const TriangleSoup& before_;
  const Surface& surface_;
  const Camera& camera_;
  Mask mask_;
};

Mask difference(const Pixels& a, const Pixels& b) {
  Mask mask;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(int{a.values[i][k]} - int{b.values[i][k]}) <= kSmall) continue;
      mask.mark(static_cast<int>(i % kSize.width), static_cast<int>(i / kSize.width));
    }
  }
  return mask;
}

std::size_t count_outside(const Mask& pixels, const Mask& mask) {
  std::size_t outside = 0;
  for (std::size_t i = 0; i < kSize.pixels(); ++i) {
    outside += pixels.is_marked(i) && !mask.is_marked(i);
  }
  return outside;
}

struct Case {
  std::string name;
  View::Up up;
  long least_changed;  // pixels, from all sides
};

class RepairedPictures : public ::testing::TestWithParam<Case> {
 protected:
  // Of its own, as files are written beside the mesh.
  RepairedPictures() {
    for (const auto& entry : fs::directory_iterator(TEXTURED_MESHES)) {
      fs::copy(entry.path(), folder_.path());
    }
    path_ = folder_.path() / GetParam().name;
    format_ = *format_of_extension(path_);
  }

  View view(const char* name) const {
    View view = *view_of(name);
    view.up = GetParam().up;
    return view;
  }

  TemporaryFolder folder_;
  fs::path path_;
  SoupFormat format_ = SoupFormat::obj;
};

constexpr std::array kViews = {"iso", "30,20", "-60,40", "200,-25", "top"};

TEST_P(RepairedPictures, DifferOnlyNearWhatWasRepaired) {
  const Repaired all = repaired(path_, format_);
  Textures textures({folder_.path()});
  long changed = 0;
  for (const char* name : kViews) {
    const Camera camera(view(name), kSize, {&all.before.soup, &all.surface.mesh});
    const Pixels before = draw_mesh(all.before.soup, all.before.attributes, camera, textures);
    const Pixels after = draw_mesh(all.surface.mesh, all.attributes, camera, textures);
    const Mask changes = difference(before, after);
    const Mask allowed = RepairedPlaces(all, camera).mask().grown(kPixels);
    EXPECT_EQ(count_outside(changes, allowed), 0U) << name;
    EXPECT_LT(allowed.count(), static_cast<long>(kSize.pixels() / 3)) << name;
    changed += changes.count();
  }
  EXPECT_GE(changed, GetParam().least_changed);
  EXPECT_TRUE(textures.warnings().empty());
}

// The comparison would see it.
TEST_P(RepairedPictures, DifferElsewhereWhereTexturesAreMoved) {
  Repaired all = repaired(path_, format_);
  Textures textures({folder_.path()});
  const Camera camera(view("iso"), kSize, {&all.before.soup, &all.surface.mesh});
  const Pixels before = draw_mesh(all.before.soup, all.before.attributes, camera, textures);
  for (CornerAttribute& attribute : all.attributes.corners) {
    for (double& value : attribute.values) value += 0.01;
  }
  const Pixels after = draw_mesh(all.surface.mesh, all.attributes, camera, textures);
  const Mask allowed = RepairedPlaces(all, camera).mask().grown(kPixels);
  EXPECT_GT(count_outside(difference(before, after), allowed), 500U);
}

TEST_P(RepairedPictures, AreThoseOfTheFileThatIsWritten) {
  const Repaired all = repaired(path_, format_);
  const fs::path out = folder_.path() / ("out" + path_.extension().string());
  WriteOptions writing;
  writing.extras.attributes = &all.attributes;
  write_soup(all.surface.mesh, out, writing);
  ReadOptions reading;
  reading.attributes = true;
  const ReadResult back = read_soup(out, reading);
  Textures textures({folder_.path()});
  const Camera camera(view("iso"), kSize, {&all.before.soup, &all.surface.mesh});
  const Mask changes = difference(draw_mesh(all.surface.mesh, all.attributes, camera, textures),
                                  draw_mesh(back.soup, back.attributes, camera, textures));
  EXPECT_EQ(changes.count(), 0);
  EXPECT_TRUE(textures.warnings().empty());
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, RepairedPictures,
    ::testing::Values(Case{"globe.obj", View::Up::z, 1000}, Case{"twins.glb", View::Up::y, 1000},
                      Case{"vase.ply", View::Up::z, 1000}, Case{"crate.3mf", View::Up::z, 1000},
                      Case{"island.glb", View::Up::y, 1000}),
    [](const auto& each) { return each.param.name.substr(0, each.param.name.find('.')); });

}  // namespace
}  // namespace meshrepair
