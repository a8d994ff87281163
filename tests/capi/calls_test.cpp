// SPDX-License-Identifier: MIT
// What the calls of the C interface do, where all is well.
#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "c_handles.h"
#include "open_surfaces.h"
#include "temporary_folder.h"

namespace meshrepair::testing {
namespace {

using Json = nlohmann::json;

Json report_of(const Result& result) { return Json::parse(meshrepair_result_report(result.get())); }

double volume_of(const meshrepair_mesh* mesh) {
  const double* const points = meshrepair_mesh_vertices(mesh);
  const std::uint32_t* const triangles = meshrepair_mesh_triangles(mesh);
  double volume = 0;
  for (std::size_t t = 0; t < meshrepair_mesh_triangle_count(mesh); ++t) {
    const auto corner = [&](std::size_t k) {
      const double* const p = points + 3 * triangles[3 * t + k];
      return Vec3d(p[0], p[1], p[2]);
    };
    volume += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  return volume;
}

TEST(CCalls, RepairMakesASolidAndSaysWhereItsTrianglesAreFrom) {
  TriangleSoup open = cube();
  open.triangles.pop_back();
  const Mesh mesh = mesh_of(open);
  const Result result(meshrepair_repair(mesh.get(), nullptr));
  ASSERT_EQ(code_of(result), MESHREPAIR_DONE) << error_of(result);
  EXPECT_EQ(error_of(result), "");
  EXPECT_DOUBLE_EQ(volume_of(mesh_in(result)), 1);
  const std::size_t triangles = meshrepair_mesh_triangle_count(mesh_in(result));
  const std::uint32_t* const sources = meshrepair_result_sources(result.get());
  std::size_t without = 0;
  for (std::size_t t = 0; t < triangles; ++t) {
    if (sources[t] == MESHREPAIR_NONE) ++without;
    EXPECT_TRUE(sources[t] == MESHREPAIR_NONE || sources[t] < open.triangles.size());
  }
  EXPECT_EQ(without, 1U);
  EXPECT_EQ(report_of(result)["certificate"]["closed"], "PASS");
  // The input is as it was.
  EXPECT_EQ(meshrepair_mesh_triangle_count(mesh.get()), open.triangles.size());
  EXPECT_EQ(meshrepair_mesh_vertex_count(mesh.get()), open.points.size());
}

TEST(CCalls, AFileIsTheSameWhetherItIsRepairedAsOneOrInMemory) {
  const TemporaryFolder folder;
  const std::string in = folder.path() / "in.stl";
  const std::string file = folder.path() / "file.stl", memory = folder.path() / "memory.stl";
  const Mesh broken = mesh_of(with_some_flipped(two_overlapping_spheres(400), 0.2, 7));
  ASSERT_EQ(code_of(Result(meshrepair_write(in.c_str(), broken.get(), nullptr))), MESHREPAIR_DONE);
  const Result by_file(meshrepair_repair_file(in.c_str(), file.c_str(), nullptr));
  ASSERT_EQ(code_of(by_file), MESHREPAIR_DONE) << error_of(by_file);

  const Result read(meshrepair_read(in.c_str(), nullptr));
  ASSERT_EQ(code_of(read), MESHREPAIR_DONE) << error_of(read);
  const Options as_stl = options_of({{"format", "stl"}});
  const Result repaired(meshrepair_repair(mesh_in(read), as_stl.get()));
  ASSERT_EQ(code_of(repaired), MESHREPAIR_DONE) << error_of(repaired);
  const Result written(meshrepair_write(memory.c_str(), mesh_in(repaired), nullptr));
  ASSERT_EQ(code_of(written), MESHREPAIR_DONE) << error_of(written);
  EXPECT_FALSE(bytes_of(file).empty());
  EXPECT_EQ(bytes_of(file), bytes_of(memory));
}

TEST(CCalls, BooleanTakesAnyNumberOfMeshes) {
  const Mesh first = mesh_of(cube()), second = mesh_of(moved(cube(), {0.5, 0, 0}));
  const std::vector<const meshrepair_mesh*> both = {first.get(), second.get()};
  const auto volume = [&](const char* operation) {
    const Options options = options_of({{"op", operation}});
    const Result result(meshrepair_boolean(both.data(), both.size(), options.get()));
    EXPECT_EQ(code_of(result), MESHREPAIR_DONE) << error_of(result);
    return volume_of(mesh_in(result));
  };
  EXPECT_DOUBLE_EQ(volume("union"), 1.5);
  EXPECT_DOUBLE_EQ(volume("intersection"), 0.5);
  EXPECT_DOUBLE_EQ(volume("difference"), 0.5);
  EXPECT_DOUBLE_EQ(volume("xor"), 1);
}

TEST(CCalls, CheckMarksTrianglesAtFault) {
  TriangleSoup soup = cube();
  soup.triangles.push_back(soup.triangles[3]);
  const Mesh mesh = mesh_of(soup);
  const Result result(meshrepair_check(mesh.get(), nullptr));
  EXPECT_EQ(code_of(result), MESHREPAIR_NOT_CERTIFIED);
  EXPECT_EQ(error_of(result), "the mesh is not the boundary of a solid");
  std::size_t bit = 0;
  while (std::string(meshrepair_defect_name(bit)) != "duplicate_triangles") ++bit;
  const std::uint16_t* const marks = meshrepair_result_marks(result.get());
  EXPECT_TRUE((marks[soup.triangles.size() - 1] >> bit & 1) == 1);
  EXPECT_EQ(meshrepair_defect_name(1000), nullptr);
  const Mesh solid = mesh_of(cube());
  EXPECT_EQ(code_of(Result(meshrepair_check(solid.get(), nullptr))), MESHREPAIR_DONE);
}

TEST(CCalls, CheckOfAFileTakesAllOptionsOfTheProgram) {
  const TemporaryFolder folder;
  const std::string in = folder.path() / "in.obj", marked = folder.path() / "marked.ply";
  TriangleSoup soup = cube();
  soup.triangles.pop_back();
  const Mesh open = mesh_of(soup);
  ASSERT_EQ(code_of(Result(meshrepair_write(in.c_str(), open.get(), nullptr))), MESHREPAIR_DONE);
  const Options options = options_of({{"mark", marked.c_str()}});
  const Result result(meshrepair_check_file(in.c_str(), options.get()));
  EXPECT_EQ(code_of(result), MESHREPAIR_NOT_CERTIFIED);
  EXPECT_EQ(error_of(result), "the mesh is not the boundary of a solid");
  EXPECT_EQ(report_of(result)["check"]["defects"]["open_edges"]["count"], 3);
  EXPECT_FALSE(bytes_of(marked).empty());
  EXPECT_EQ(code_of(Result(meshrepair_check_file(nullptr, nullptr))), MESHREPAIR_USAGE);
}

TEST(CCalls, DistanceIsInTheReport) {
  const Mesh first = mesh_of(cube()), second = mesh_of(moved(cube(), {0.25, 0, 0}));
  const Options options = options_of({{"samples", "1000"}});
  const Result result(meshrepair_distance(first.get(), second.get(), options.get()));
  ASSERT_EQ(code_of(result), MESHREPAIR_DONE) << error_of(result);
  EXPECT_NEAR(report_of(result)["distance"]["hausdorff"], 0.25, 1e-9);
}

TEST(CCalls, PointsBecomeASolidFromMemoryAndFromAFile) {
  const TriangleSoup ball = sphere(2000);
  const Result memory(
      meshrepair_repair_points(ball.points[0].data(), nullptr, ball.points.size(), nullptr));
  ASSERT_EQ(code_of(memory), MESHREPAIR_DONE) << error_of(memory);
  EXPECT_NEAR(volume_of(mesh_in(memory)), 4.19, 0.1);

  const TemporaryFolder folder;
  const std::string path = folder.path() / "scan.xyz";
  std::ofstream file(path);
  file.precision(17);
  for (const Vec3d& p : ball.points) file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  file.close();
  const Result read(meshrepair_read(path.c_str(), nullptr));
  ASSERT_EQ(code_of(read), MESHREPAIR_DONE) << error_of(read);
  EXPECT_EQ(meshrepair_mesh_vertex_count(mesh_in(read)), ball.points.size());
  EXPECT_EQ(meshrepair_mesh_triangle_count(mesh_in(read)), 0U);
  EXPECT_DOUBLE_EQ(meshrepair_mesh_vertices(mesh_in(read))[0], ball.points[0].x());
  const Result from_file(meshrepair_repair(mesh_in(read), nullptr));
  ASSERT_EQ(code_of(from_file), MESHREPAIR_DONE) << error_of(from_file);
  EXPECT_DOUBLE_EQ(volume_of(mesh_in(from_file)), volume_of(mesh_in(memory)));
}

TEST(CCalls, ATakenMeshOutlivesItsResult) {
  const Mesh mesh = mesh_of(cube());
  Result result(meshrepair_repair(mesh.get(), nullptr));
  const Mesh taken(meshrepair_result_take_mesh(result.get()));
  EXPECT_EQ(mesh_in(result), nullptr);
  EXPECT_EQ(meshrepair_result_take_mesh(result.get()), nullptr);
  EXPECT_NE(meshrepair_result_sources(result.get()), nullptr);
  result.reset();
  EXPECT_DOUBLE_EQ(volume_of(taken.get()), 1);
}

// What a progress function was told, and when it asked to stop.
struct Told {
  std::vector<std::string> stages;
  double last = 0;
  bool stop = false;
  std::thread::id thread;
};

int tell(void* data, const char* stage, double share) {
  Told& told = *static_cast<Told*>(data);
  told.stages.emplace_back(stage);
  told.last = share;
  told.thread = std::this_thread::get_id();
  return told.stop ? 1 : 0;
}

TEST(CCalls, ProgressIsToldOnTheThreadThatCalls) {
  const Mesh mesh = mesh_of(two_overlapping_spheres(2000));
  const Options options = options_of({});
  Told told;
  meshrepair_options_set_progress(options.get(), &tell, &told);
  ASSERT_EQ(code_of(Result(meshrepair_repair(mesh.get(), options.get()))), MESHREPAIR_DONE);
  EXPECT_NE(std::find(told.stages.begin(), told.stages.end(), "certify"), told.stages.end());
  EXPECT_EQ(told.thread, std::this_thread::get_id());
  EXPECT_GE(told.last, 0);
  EXPECT_LE(told.last, 1);
}

TEST(CCalls, ProgressCanStopTheWork) {
  const Mesh mesh = mesh_of(with_some_flipped(random_soup(3000, 1000, 3), 0.5, 1));
  const Options options = options_of({{"always", nullptr}});
  Told told;
  told.stop = true;
  meshrepair_options_set_progress(options.get(), &tell, &told);
  const Result result(meshrepair_repair(mesh.get(), options.get()));
  EXPECT_EQ(code_of(result), MESHREPAIR_INTERRUPTED);
  EXPECT_EQ(error_of(result), "interrupted: the progress function asked to stop");
  EXPECT_EQ(mesh_in(result), nullptr);
  EXPECT_EQ(report_of(result)["exit_code"], 130);
}

TEST(CCalls, SeveralThreadsRepairOneMeshAtOnce) {
  const Mesh mesh = mesh_of(with_some_flipped(two_overlapping_spheres(300), 0.3, 5));
  const auto repaired = [&] {
    const Result result(meshrepair_repair(mesh.get(), nullptr));
    EXPECT_EQ(code_of(result), MESHREPAIR_DONE) << error_of(result);
    const double* const first = meshrepair_mesh_vertices(mesh_in(result));
    return std::vector<double>(first, first + 3 * meshrepair_mesh_vertex_count(mesh_in(result)));
  };
  const std::vector<double> expected = repaired();
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int call = 0; call < 10; ++call) EXPECT_EQ(repaired(), expected);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(CCalls, WarningsAreThoseOfTheCall) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "cube.stl";
  const Mesh mesh = mesh_of(cube());
  const std::vector<std::uint32_t> groups(12, 0);
  const char* const name = "sides";
  ASSERT_EQ(meshrepair_mesh_set_labels(mesh.get(), MESHREPAIR_GROUP, &name, 1, groups.data()),
            MESHREPAIR_DONE);
  const Result lossy(meshrepair_write(path.c_str(), mesh.get(), nullptr));
  ASSERT_EQ(code_of(lossy), MESHREPAIR_DONE) << error_of(lossy);
  ASSERT_EQ(meshrepair_result_warning_count(lossy.get()), 1U);
  EXPECT_EQ(meshrepair_result_warning(lossy.get(), 0),
            path + ": binary STL cannot store these attributes: groups [W-ATTRIBUTES-LOST]");
  EXPECT_EQ(meshrepair_result_warning(lossy.get(), 1), nullptr);
  const Result next(meshrepair_check(mesh.get(), nullptr));
  EXPECT_EQ(meshrepair_result_warning_count(next.get()), 0U);
}

}  // namespace
}  // namespace meshrepair::testing
