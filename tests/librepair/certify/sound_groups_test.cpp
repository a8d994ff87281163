#include "certify/sound_groups.h"

#include <array>

#include <gtest/gtest.h>

#include "shapes.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;

// A cube, a smaller one in it, one beside them, and a sphere.
TriangleSoup three_cubes() {
  TriangleSoup soup = cube();
  append(soup, scaled(cube(), 0.5));
  append(soup, moved(cube(), {10, 0, 0}));
  append(soup, moved(sphere(100), {20, 0, 0}));
  return soup;
}

std::size_t size_of_cube() { return cube().triangles.size(); }

TEST(SoundGroups, LeaveTheSmallestWithWhatIsAtFault) {
  Surface surface = as_surface(three_cubes());
  internal::SoundGroups sound;
  EXPECT_TRUE(sound.empty());
  sound.take_out(surface, std::array<std::uint32_t, 1>{0});
  EXPECT_FALSE(sound.empty());
  EXPECT_EQ(surface.mesh.triangles.size(), 3 * size_of_cube());
  EXPECT_EQ(sound.mesh().triangles.size() + surface.mesh.triangles.size(),
            three_cubes().triangles.size());
}

TEST(SoundGroups, LieTogetherWhereOneIsInAnother) {
  Surface surface = as_surface(three_cubes());
  internal::SoundGroups sound;
  sound.take_out(surface, std::array{static_cast<std::uint32_t>(size_of_cube())});
  EXPECT_EQ(surface.source.front(), 0u);
  EXPECT_EQ(surface.source.back(), 3 * size_of_cube() - 1);
}

TEST(SoundGroups, ComeBackBeforeTheOthers) {
  const TriangleSoup soup = three_cubes();
  Surface surface = as_surface(soup);
  internal::SoundGroups sound;
  sound.take_out(surface, std::array<std::uint32_t, 1>{0});
  EXPECT_TRUE(sound.bring_back(surface));
  EXPECT_TRUE(sound.empty());
  ASSERT_EQ(surface.mesh.triangles.size(), soup.triangles.size());
  EXPECT_EQ(surface.source.front(), 3 * size_of_cube());
  for (std::size_t t = 0; t < surface.source.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(surface.mesh.points[surface.mesh.triangles[t][k]],
                soup.points[soup.triangles[surface.source[t]][k]]);
    }
  }
}

TEST(SoundGroups, TellWhereTheOthersCameNear) {
  Surface surface = as_surface(three_cubes());
  internal::SoundGroups sound;
  sound.take_out(surface, std::array<std::uint32_t, 1>{0});
  for (Vec3d& p : surface.mesh.points) p.x() += 20;
  EXPECT_FALSE(sound.bring_back(surface));
}

TEST(SoundGroups, AreNoneWhereAllHangsTogether) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {0.5, 0.5, 0.5}));
  Surface surface = as_surface(soup);
  internal::SoundGroups sound;
  sound.take_out(surface, std::array<std::uint32_t, 1>{0});
  EXPECT_TRUE(sound.empty());
  EXPECT_EQ(surface.mesh.triangles, soup.triangles);
}

}  // namespace
}  // namespace meshrepair
