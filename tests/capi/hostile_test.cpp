// SPDX-License-Identifier: MIT
// Calls of the C interface that make no sense: each says so, and nothing is thrown or lost.
#include <array>
#include <clocale>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "c_handles.h"
#include "degenerate_soups.h"
#include "share_of_cases.h"
#include "temporary_folder.h"

namespace meshrepair::testing {
namespace {

TEST(CHostile, NullIsAMeshOfNothingAndAResultWithoutMemory) {
  EXPECT_EQ(meshrepair_mesh_vertex_count(nullptr), 0U);
  EXPECT_EQ(meshrepair_mesh_triangle_count(nullptr), 0U);
  EXPECT_EQ(meshrepair_mesh_vertices(nullptr), nullptr);
  EXPECT_EQ(meshrepair_mesh_triangles(nullptr), nullptr);
  EXPECT_EQ(meshrepair_mesh_attribute_count(nullptr), 0U);
  EXPECT_EQ(meshrepair_mesh_attribute_name(nullptr, 0), nullptr);
  EXPECT_EQ(meshrepair_mesh_attribute_corners(nullptr, 0), nullptr);
  EXPECT_EQ(meshrepair_mesh_labels(nullptr, MESHREPAIR_GROUP), nullptr);
  EXPECT_EQ(meshrepair_mesh_label_name(nullptr, MESHREPAIR_GROUP, 0), nullptr);
  EXPECT_EQ(meshrepair_result_code(nullptr), MESHREPAIR_LIMIT);
  EXPECT_STREQ(meshrepair_result_error(nullptr), "out of memory");
  EXPECT_STREQ(meshrepair_result_report(nullptr), "");
  EXPECT_EQ(meshrepair_result_mesh(nullptr), nullptr);
  EXPECT_EQ(meshrepair_result_take_mesh(nullptr), nullptr);
  EXPECT_EQ(meshrepair_result_sources(nullptr), nullptr);
  EXPECT_EQ(meshrepair_result_marks(nullptr), nullptr);
  EXPECT_EQ(meshrepair_result_warning(nullptr, 0), nullptr);
  EXPECT_EQ(meshrepair_options_set(nullptr, "for", "print"), MESHREPAIR_USAGE);
  meshrepair_options_set_progress(nullptr, nullptr, nullptr);
  meshrepair_mesh_free(nullptr);
  meshrepair_options_free(nullptr);
  meshrepair_result_free(nullptr);
  EXPECT_EQ(code_of(Result(meshrepair_repair(nullptr, nullptr))), MESHREPAIR_NO_SOLID);
  EXPECT_EQ(code_of(Result(meshrepair_repair_points(nullptr, nullptr, 0, nullptr))),
            MESHREPAIR_NO_SOLID);
  EXPECT_EQ(code_of(Result(meshrepair_repair_points(nullptr, nullptr, 3, nullptr))),
            MESHREPAIR_USAGE);
  EXPECT_EQ(code_of(Result(meshrepair_boolean(nullptr, 2, nullptr))), MESHREPAIR_USAGE);
  EXPECT_EQ(code_of(Result(meshrepair_read(nullptr, nullptr))), MESHREPAIR_USAGE);
  EXPECT_EQ(code_of(Result(meshrepair_write(nullptr, nullptr, nullptr))), MESHREPAIR_USAGE);
  EXPECT_EQ(code_of(Result(meshrepair_repair_file("a", nullptr, nullptr))), MESHREPAIR_USAGE);
}

TEST(CHostile, MeshesWithWrongNumbersAreRefused) {
  const std::array<double, 9> points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::array<std::uint32_t, 6> triangles = {0, 1, 2, 0, 1, 3};
  EXPECT_EQ(meshrepair_mesh_new(points.data(), 3, triangles.data(), 2), nullptr);
  EXPECT_STREQ(meshrepair_last_error(), "triangle 1 has the index 3, but there are 3 vertices");
  EXPECT_EQ(meshrepair_mesh_new(nullptr, 3, triangles.data(), 1), nullptr);
  EXPECT_EQ(meshrepair_mesh_new(points.data(), 3, nullptr, 1), nullptr);
  const auto huge = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(meshrepair_mesh_new(points.data(), huge, triangles.data(), 1), nullptr);
  EXPECT_EQ(meshrepair_mesh_new(points.data(), 3, triangles.data(), huge), nullptr);
  const Mesh fine(meshrepair_mesh_new(points.data(), 3, triangles.data(), 1));
  EXPECT_NE(fine, nullptr);
  EXPECT_STREQ(meshrepair_last_error(), "");
}

std::string error_with(std::initializer_list<Setting> settings) {
  const Mesh mesh = mesh_of(cube());
  const Options options = options_of(settings);
  const Result result(meshrepair_repair(mesh.get(), options.get()));
  EXPECT_EQ(code_of(result), MESHREPAIR_USAGE);
  EXPECT_EQ(mesh_in(result), nullptr);
  return error_of(result);
}

TEST(CHostile, OptionsThatAreNoneAreNamed) {
  EXPECT_EQ(error_with({{"no-such", "1"}}), "no-such: there is no such option");
  EXPECT_EQ(error_with({{"always", "yes"}}), "always: is a flag, and takes no value");
  EXPECT_EQ(error_with({{"sew", nullptr}}), "sew: needs a value");
  EXPECT_EQ(error_with({{"sources", nullptr}}), "sources: is for files, and here are none");
  EXPECT_EQ(error_with({{"attributes", "drop"}}),
            "attributes: is gone: use drop=\"all\" for attributes=\"drop\"");
  EXPECT_EQ(error_with({{"check_cells", nullptr}}),
            "check_cells: is gone: leave it out, the result is the same");
  EXPECT_EQ(error_with({{"help", nullptr}}), "help: there is no such option");
  EXPECT_NE(error_with({{"inside", "magic"}}).find("--inside: magic not in"), std::string::npos);
  const Options options = options_of({});
  EXPECT_EQ(meshrepair_options_set(options.get(), "", "x"), MESHREPAIR_USAGE);
  EXPECT_EQ(meshrepair_options_set(options.get(), nullptr, "x"), MESHREPAIR_USAGE);
}

TEST(CHostile, AnOptionThatIsSetAgainIsReplaced) {
  const Mesh mesh = mesh_of(cube());
  const Options options = options_of({{"inside", "magic"},
                                      {"max-hole", "wide"},
                                      {"always", nullptr},
                                      {"always", nullptr},
                                      {"max_hole", "0.5"},
                                      {"inside", "winding"}});
  const Result result(meshrepair_repair(mesh.get(), options.get()));
  EXPECT_EQ(code_of(result), MESHREPAIR_DONE) << error_of(result);
}

// A repair makes triangles of points; what else they carried would be taken for that of triangles.
TEST(CHostile, PointsAreNoMesh) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "scan.xyz";
  std::ofstream file(path);
  for (const Vec3d& p : sphere(500).points) file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  file.close();
  const Mesh points(
      meshrepair_result_take_mesh(Result(meshrepair_read(path.c_str(), nullptr)).get()));
  ASSERT_EQ(meshrepair_mesh_vertex_count(points.get()), sphere(500).points.size());
  const double value = 1;
  EXPECT_EQ(meshrepair_mesh_add_attribute(points.get(), "heat", 1, &value, 1, nullptr),
            MESHREPAIR_USAGE);
  const char* const name = "one";
  EXPECT_EQ(meshrepair_mesh_set_labels(points.get(), MESHREPAIR_GROUP, &name, 1, nullptr),
            MESHREPAIR_USAGE);
  EXPECT_EQ(code_of(Result(meshrepair_repair(points.get(), nullptr))), MESHREPAIR_DONE);

  const Mesh mesh = mesh_of(cube());
  const std::string out = folder.path() / "out.ply";
  EXPECT_EQ(code_of(Result(meshrepair_write(out.c_str(), points.get(), nullptr))),
            MESHREPAIR_USAGE);
  EXPECT_FALSE(std::ifstream(out).is_open());
  EXPECT_EQ(code_of(Result(meshrepair_check(points.get(), nullptr))), MESHREPAIR_USAGE);
  EXPECT_EQ(code_of(Result(meshrepair_distance(mesh.get(), points.get(), nullptr))),
            MESHREPAIR_USAGE);
  const meshrepair_mesh* const both[] = {mesh.get(), points.get()};
  const Result united(meshrepair_boolean(both, 2, options_of({{"op", "union"}}).get()));
  EXPECT_EQ(code_of(united), MESHREPAIR_USAGE);
  EXPECT_EQ(error_of(united), "operand 1: is points of a scan, not a mesh: repair them first");
}

TEST(CHostile, FilesThatAreNotThereAreNamed) {
  const Result read(meshrepair_read("/no/such/file.stl", nullptr));
  EXPECT_EQ(code_of(read), MESHREPAIR_INPUT);
  EXPECT_NE(error_of(read).find("/no/such/file.stl"), std::string::npos);
  EXPECT_EQ(mesh_in(read), nullptr);
  const Mesh mesh = mesh_of(cube());
  const Result written(meshrepair_write("/no/such/folder/out.stl", mesh.get(), nullptr));
  EXPECT_EQ(code_of(written), MESHREPAIR_OUTPUT);
  const TemporaryFolder folder;
  const std::string strange = folder.path() / "out.strange";
  EXPECT_EQ(code_of(Result(meshrepair_write(strange.c_str(), mesh.get(), nullptr))),
            MESHREPAIR_USAGE);
}

TEST(CHostile, AnySoupWithAnyOptionsEndsWithACodeAndALine) {
  std::mt19937_64 random(20);
  const std::vector<Setting> settings = {
      {"for", "print"},     {"for", "nothing"},  {"inside", "winding"}, {"sew", "auto"},
      {"sew", "-1"},        {"seal", "auto"},    {"holes", "plain"},    {"precision", "float32"},
      {"time-limit", "60"}, {"time-limit", "x"}, {"strict", nullptr},   {"threads", "2"},
      {"threads", "-2"},    {"always", nullptr}, {"cells", ""},         {"simplify", "1e309"}};
  for (int round = 0; round < tried_share() * 300; ++round) {
    const auto seed = static_cast<std::uint64_t>(round);
    TriangleSoup soup = round % 3 == 0   ? random_soup(30, 4, seed)
                        : round % 3 == 1 ? coplanar_soup(20, seed)
                                         : sliver_soup(20, seed);
    if (random() % 4 == 0) {
      soup.points[random() % soup.points.size()].x() =
          random() % 2 == 0 ? std::numeric_limits<double>::quiet_NaN()
                            : std::numeric_limits<double>::infinity();
    }
    if (random() % 4 == 0) soup = scaled(soup, 1e300);
    const Options options = options_of({});
    for (std::size_t i = 0, count = random() % 3; i < count; ++i) {
      const auto& [name, value] = settings[random() % settings.size()];
      ASSERT_EQ(meshrepair_options_set(options.get(), name, value), MESHREPAIR_DONE);
    }
    const Mesh mesh = mesh_of(soup);
    const Result result(meshrepair_repair(mesh.get(), options.get()));
    const meshrepair_code code = code_of(result);
    EXPECT_TRUE(code >= MESHREPAIR_DONE && code <= MESHREPAIR_OUTPUT) << error_of(result);
    EXPECT_EQ(code == MESHREPAIR_DONE, error_of(result).empty()) << error_of(result);
    EXPECT_EQ(error_of(result).find('\n'), std::string::npos);
    EXPECT_EQ(mesh_in(result) != nullptr,
              code == MESHREPAIR_DONE || code == MESHREPAIR_NOT_CERTIFIED);
  }
}

// Where a process speaks German, 0.5 is 0,5.
class InGerman {
 public:
  InGerman() {
    const std::string made = folder_.path() / "de_DE.UTF-8";
    const std::string command = "localedef -i de_DE -f UTF-8 '" + made + "' 2>/dev/null";
    if (std::system(command.c_str()) != 0) return;
    setenv("LOCPATH", folder_.path().c_str(), 1);
    is_there_ = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  }
  InGerman(const InGerman&) = delete;
  InGerman& operator=(const InGerman&) = delete;
  ~InGerman() {
    (void)std::setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
  }

  [[nodiscard]] bool is_there() const { return is_there_; }

 private:
  TemporaryFolder folder_;
  bool is_there_ = false;
};

TEST(CHostile, NumbersHaveAPointInAnyLocale) {
  const TemporaryFolder folder;
  const Mesh mesh = mesh_of(with_some_flipped(two_overlapping_spheres(300), 0.2, 3));
  const Options options = options_of({{"min-part", "0.5"}, {"sew", "0.001"}});
  const auto bytes = [&](const char* name) {
    const std::string path = folder.path() / name;
    const Result repaired(meshrepair_repair(mesh.get(), options.get()));
    EXPECT_EQ(code_of(repaired), MESHREPAIR_DONE) << error_of(repaired);
    const Result written(meshrepair_write(path.c_str(), mesh_in(repaired), nullptr));
    EXPECT_EQ(code_of(written), MESHREPAIR_DONE) << error_of(written);
    const Result read(meshrepair_read(path.c_str(), nullptr));
    EXPECT_EQ(meshrepair_mesh_vertex_count(mesh_in(read)),
              meshrepair_mesh_vertex_count(mesh_in(repaired)));
    return bytes_of(path);
  };
  const std::string obj = bytes("a.obj"), off = bytes("a.off");
  const InGerman german;
  if (!german.is_there()) GTEST_SKIP() << "localedef, or what it needs, is not there";
  ASSERT_STREQ(std::localeconv()->decimal_point, ",");
  EXPECT_EQ(bytes("b.obj"), obj);
  EXPECT_EQ(bytes("b.off"), off);
  EXPECT_STREQ(std::localeconv()->decimal_point, ",");
}

}  // namespace
}  // namespace meshrepair::testing
