// SPDX-License-Identifier: MIT
// The calls of the C interface that work, their options and results.
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>

#include "calls/file_calls.h"
#include "calls/measure_calls.h"
#include "calls/repair_calls.h"
#include "calls/worker.h"
#include "handles.h"

namespace meshrepair {
namespace {

void tell(CallProgress& progress, const meshrepair_options& options) {
  for (const CallProgress::Event& event : progress.take_events()) {
    if (options.told(options.data, event.stage.c_str(), event.share) == 0) continue;
    progress.ask_to_stop();
    return;
  }
}

// On another thread: that of the caller may have a small stack, and is told how far the work is.
Outcome run_told(const Session& session, const Session::Body& body,
                 const meshrepair_options* options) {
  CallProgress progress(session.limits());
  Outcome outcome;
  const bool is_told = options != nullptr && options->told != nullptr;
  run_watched([&] { outcome = session.run(progress, body); },
              [&] {
                if (is_told && !progress.is_asked_to_stop()) tell(progress, *options);
              });
  if (is_told && !progress.is_asked_to_stop()) tell(progress, *options);
  if (progress.is_asked_to_stop() && outcome.code == ExitCode::interrupted) {
    outcome.error = "interrupted: the progress function asked to stop";
  }
  return outcome;
}

// Makes a result of what `work(result, keywords, runner)` does or throws. Null: memory ran out.
template <class Work>
meshrepair_result* called(const meshrepair_options* options, const Work& work) noexcept {
  meshrepair_result* result = nullptr;
  (void)guarded([&] {
    auto made = std::make_unique<meshrepair_result>();
    try {
      work(*made, options == nullptr ? Keywords() : options->keywords,
           Runner([options](const Session& session, const Session::Body& body) {
             return run_told(session, body, options);
           }));
    } catch (...) {
      Failure failure = describe_failure(std::current_exception());
      made->outcome.code = failure.code;
      made->outcome.error = std::move(failure.message);
    }
    result = made.release();
  });
  return result;
}

AnySoup copy_of(const meshrepair_mesh* mesh) { return mesh == nullptr ? AnySoup() : mesh->it; }

// Of calls that would take points of a scan for a mesh of nothing.
void refuse_points(const meshrepair_mesh* mesh, const std::string& name) {
  if (mesh == nullptr || !mesh->it.cloud) return;
  throw UsageError(name + ": is points of a scan, not a mesh: repair them first");
}

const TriangleSoup& soup_behind(const meshrepair_mesh* mesh, const std::string& name) {
  static const TriangleSoup nothing;
  refuse_points(mesh, name);
  return mesh == nullptr ? nothing : mesh->it.soup;
}

void keep_mesh(AnySoup it, meshrepair_result& result) {
  auto mesh = std::make_unique<meshrepair_mesh>();
  mesh->it = std::move(it);
  mesh->name_attributes();
  result.mesh = std::move(mesh);
}

void keep(RepairOutcome outcome, meshrepair_result& result) {
  if (outcome.has_mesh()) {
    AnySoup it;
    it.soup = std::move(outcome.mesh.surface.mesh);
    it.attributes = std::move(outcome.mesh.attributes);
    keep_mesh(std::move(it), result);
    result.sources = std::move(outcome.mesh.surface.source);
  }
  result.outcome = std::move(outcome);
}

std::vector<Vec3d> rows_of(const double* numbers, std::size_t count, const char* name) {
  if (numbers == nullptr && count > 0) {
    throw UsageError(std::string(name) + ": there is NULL where there are to be some");
  }
  if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw UsageError(std::string(name) + ": are too many");
  }
  std::vector<Vec3d> rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    rows[i] = Vec3d(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  }
  return rows;
}

void say_not_solid(meshrepair_result& result) {
  if (result.outcome.code != ExitCode::not_certified) return;
  result.outcome.error = "the mesh is not the boundary of a solid";
}

std::string path_of(const char* path) {
  if (path == nullptr || *path == '\0') throw UsageError("there is no name of a file");
  return path;
}

}  // namespace
}  // namespace meshrepair

using namespace meshrepair;

meshrepair_result* meshrepair_repair(const meshrepair_mesh* mesh,
                                     const meshrepair_options* options) {
  return called(options,
                [&](meshrepair_result& result, const Keywords& keywords, const Runner& runner) {
                  keep(repair_call(copy_of(mesh), false, false, keywords, runner), result);
                });
}

meshrepair_result* meshrepair_repair_points(const double* points, const double* normals,
                                            size_t point_count, const meshrepair_options* options) {
  return called(options,
                [&](meshrepair_result& result, const Keywords& keywords, const Runner& runner) {
                  AnySoup input;
                  PointCloud& cloud = input.cloud.emplace();
                  cloud.points = rows_of(points, point_count, "points");
                  if (normals != nullptr) cloud.normals = rows_of(normals, point_count, "normals");
                  keep(repair_call(std::move(input), false, false, keywords, runner), result);
                });
}

meshrepair_result* meshrepair_repair_file(const char* input, const char* output,
                                          const meshrepair_options* options) {
  return called(
      options, [&](meshrepair_result& result, const Keywords& keywords, const Runner& runner) {
        result.outcome = repair_file_call(path_of(input), path_of(output), false, keywords, runner);
      });
}

meshrepair_result* meshrepair_boolean(const meshrepair_mesh* const* meshes, size_t mesh_count,
                                      const meshrepair_options* options) {
  return called(options,
                [&](meshrepair_result& result, const Keywords& keywords, const Runner& runner) {
                  if (meshes == nullptr && mesh_count > 0)
                    throw UsageError("there is NULL for meshes");
                  std::vector<AnySoup> operands;
                  for (std::size_t i = 0; i < mesh_count; ++i) {
                    refuse_points(meshes[i], operand_name(i));
                    operands.push_back(copy_of(meshes[i]));
                  }
                  keep(boolean_call(std::move(operands), false, keywords, runner), result);
                });
}

meshrepair_result* meshrepair_check(const meshrepair_mesh* mesh,
                                    const meshrepair_options* options) {
  return called(
      options, [&](meshrepair_result& result, const Keywords& keywords, const Runner& runner) {
        CheckOutcome outcome = check_call(soup_behind(mesh, "the mesh"), keywords, runner);
        result.marks = std::move(outcome.check.marks);
        result.outcome = std::move(outcome);
        say_not_solid(result);
      });
}

meshrepair_result* meshrepair_check_file(const char* input, const meshrepair_options* options) {
  return called(options,
                [&](meshrepair_result& result, const Keywords& keywords, const Runner& runner) {
                  result.outcome = check_file_call(path_of(input), keywords, runner);
                  say_not_solid(result);
                });
}

meshrepair_result* meshrepair_distance(const meshrepair_mesh* mesh, const meshrepair_mesh* other,
                                       const meshrepair_options* options) {
  return called(
      options, [&](meshrepair_result& result, const Keywords& keywords, const Runner& runner) {
        result.outcome = distance_call(soup_behind(mesh, "the first mesh"),
                                       soup_behind(other, "the second mesh"), keywords, runner);
      });
}

meshrepair_result* meshrepair_read(const char* path, const meshrepair_options* options) {
  return called(options,
                [&](meshrepair_result& result, const Keywords& keywords, const Runner& runner) {
                  ReadOutcome outcome = read_call(path_of(path), true, keywords, runner);
                  if (outcome.code == ExitCode::done) keep_mesh(std::move(outcome.input), result);
                  result.outcome = std::move(outcome);
                });
}

meshrepair_result* meshrepair_write(const char* path, const meshrepair_mesh* mesh,
                                    const meshrepair_options* options) {
  return called(options,
                [&](meshrepair_result& result, const Keywords& keywords, const Runner& runner) {
                  GivenForFile given;
                  given.soup = &soup_behind(mesh, "the mesh");
                  if (mesh != nullptr) given.attributes = &mesh->it.attributes;
                  result.outcome = write_call(path_of(path), given, keywords, runner);
                });
}
