#include <algorithm>
#include <iostream>
#include <utility>

#include <spdlog/fmt/fmt.h>
#include <spdlog/logger.h>

#include <base/error.h>
#include <check/box_tree.h>
#include <check/self_intersections.h>
#include <mesh/mesh_parts.h>

#include "blocks/block_folder.h"
#include "blocks/verbs.h"
#include "common/file_kinds.h"
#include "common/logging.h"
#include "common/repair_options.h"
#include "common/repair_steps.h"
#include "common/summary.h"

namespace meshrepair {
namespace {

constexpr std::size_t kMostNamed = 10;

struct JoinOptions {
  std::string folder;
  StepOptions step;
};

// All results, block behind block.
struct Joined {
  TriangleSoup soup;
  std::vector<std::uint32_t> block_of;  // of each triangle, from 0
  std::vector<std::size_t> uncertified, empty;
};

std::string named(const std::vector<std::size_t>& blocks) {
  std::string text;
  for (std::size_t i = 0; i < std::min(blocks.size(), kMostNamed); ++i) {
    text += (i > 0 ? ", " : "") + std::to_string(blocks[i]);
  }
  if (blocks.size() > kMostNamed) text += fmt::format(" and {} more", blocks.size() - kMostNamed);
  return text;
}

std::vector<BlockResult> read_results(const JoinOptions& options, const BlockFolder& folder,
                                      const BlockPlan& plan) {
  std::vector<BlockResult> results;
  std::vector<std::size_t> missing;
  for (std::size_t b = 1; b <= plan.blocks.size(); ++b) {
    if (auto result = folder.read_result(b, plan)) {
      results.push_back(std::move(*result));
    } else {
      missing.push_back(b);
    }
  }
  if (!missing.empty()) {
    throw InputError(fmt::format(
        "{}: not repaired: {} {}; do 'meshrepair-blocks run {} --block {}'", options.folder,
        missing.size() == 1 ? "block" : "blocks", named(missing), options.folder, missing[0]));
  }
  for (std::size_t b = 1; b < results.size(); ++b) {
    if (results[b].options == results[0].options) continue;
    throw InputError(fmt::format("{}: block {} was repaired with other options than block 1",
                                 options.folder, b + 1));
  }
  return results;
}

void append(const TriangleSoup& part, std::uint32_t block, Joined& joined) {
  const auto first = static_cast<std::uint32_t>(joined.soup.points.size());
  joined.soup.points.insert(joined.soup.points.end(), part.points.begin(), part.points.end());
  for (const auto& t : part.triangles) {
    joined.soup.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  joined.block_of.resize(joined.soup.triangles.size(), block);
}

Joined read_all(const JoinOptions& options, const BlockFolder& folder, const BlockPlan& plan,
                SoupFormat format, Run& run) {
  const std::vector<BlockResult> results = read_results(options, folder, plan);
  Joined joined;
  for (std::uint32_t b = 0; b < results.size(); ++b) {
    if (!results[b].certified) joined.uncertified.push_back(b + 1);
    if (results[b].file.empty()) {
      joined.empty.push_back(b + 1);
      continue;
    }
    const ReadResult part = read_soup(folder.file_of(results[b]), read_options(run));
    if (is_single(format) && !is_single(part.report.format)) {
      throw UsageError(
          fmt::format("{}: {} rounds coordinates more than the blocks were made for: run them with "
                      "--format stl, or write PLY, OBJ or OFF",
                      options.step.output, format_name(format)));
    }
    append(part.soup, b, joined);
    run.progress.advance(static_cast<double>(b + 1) / static_cast<double>(results.size()));
  }
  return joined;
}

// Of parts in different blocks whose boxes meet, the triangles; the blocks of these.
struct Neighbours {
  TriangleSoup soup;
  std::vector<std::uint32_t> block_of;
};

Neighbours neighbours_in(const Joined& joined) {
  const MeshParts parts = find_parts(joined.soup);
  std::vector<Box> boxes(parts.count);
  std::vector<std::uint32_t> block_of_part(parts.count);
  for (std::size_t t = 0; t < joined.soup.triangles.size(); ++t) {
    const std::uint32_t part = parts.of_triangle[t];
    block_of_part[part] = joined.block_of[t];
    for (const std::uint32_t p : joined.soup.triangles[t]) boxes[part].add(joined.soup.points[p]);
  }
  const BoxTree tree(boxes);
  std::vector<char> is_near(parts.count, 0);
  for (std::uint32_t part = 0; part < parts.count; ++part) {
    tree.visit([&](const Box& box) { return box.meets(boxes[part]); },
               [&](std::uint32_t other) {
                 if (block_of_part[other] == block_of_part[part]) return;
                 if (boxes[other].meets(boxes[part])) is_near[part] = is_near[other] = 1;
               });
  }
  Neighbours found;
  found.soup.points = joined.soup.points;
  for (std::size_t t = 0; t < joined.soup.triangles.size(); ++t) {
    if (is_near[parts.of_triangle[t]] == 0) continue;
    found.soup.triangles.push_back(joined.soup.triangles[t]);
    found.block_of.push_back(joined.block_of[t]);
  }
  return found;
}

// Pairs of triangles of different blocks that meet. Each block is certified for itself, and parts
// whose boxes do not meet do not meet.
std::size_t pairs_between_blocks(const Joined& joined, Run& run) {
  const Neighbours near = neighbours_in(joined);
  if (near.soup.triangles.empty()) return 0;
  SelfIntersectionOptions options;
  options.most_pairs = near.soup.triangles.size();
  options.progress = &run.progress;
  const SelfIntersections found = self_intersections(near.soup, options);
  return static_cast<std::size_t>(std::count_if(
      found.pairs.begin(), found.pairs.end(),
      [&](const auto& pair) { return near.block_of[pair[0]] != near.block_of[pair[1]]; }));
}

std::string faults_of(const Joined& joined, std::size_t pairs) {
  std::string faults;
  if (!joined.uncertified.empty()) {
    faults = "without all guarantees in block " + named(joined.uncertified);
  }
  if (pairs > 0) {
    faults += (faults.empty() ? "" : ", and ") +
              fmt::format("{} of triangles of different blocks meet: plan with a larger --margin",
                          number_of(pairs, "pair"));
  }
  return faults;
}

ExitCode join(JoinOptions& options, Run& run) {
  const BlockFolder folder(options.folder);
  const BlockPlan plan = folder.read_plan();
  check_files(folder.plan_file().string(), options.step.output, run);
  options.step.input = options.folder;
  WriteOptions format = mesh_format(options.step);
  format.extras.unit = plan.unit;
  Findings findings(options.folder, options.step.output);
  StageMeter meter(findings.repair.stages, &run.progress);
  return with_findings(run, findings, [&] {
    meter.begin("read");
    const Joined joined = read_all(options, folder, plan, *format.format, run);
    if (joined.soup.triangles.empty()) throw NoSolidError("no block encloses anything");
    meter.begin("check");
    const std::size_t pairs = pairs_between_blocks(joined, run);
    meter.end();
    run.report.set_section("blocks", {{"count", plan.blocks.size()},
                                      {"enclosing_nothing", joined.empty},
                                      {"not_certified", joined.uncertified},
                                      {"pairs_between", pairs}});
    write_soup_stage(joined.soup, format, run, findings);
    run.progress.finish();
    const std::string faults = faults_of(joined, pairs);
    if (!faults.empty()) {
      run.report.set_error(options.step.output + ": written, but " + faults);
      logger().error("{}: written, but {}", options.step.output, faults);
      return ExitCode::not_certified;
    }
    if (!run.options.quiet && run.options.report != "-" && options.step.output != "-") {
      std::cout << fmt::format("{}: {} of {}\n", options.step.output,
                               number_of(joined.soup.triangles.size(), "triangle"),
                               number_of(plan.blocks.size(), "block"));
    }
    return ExitCode::done;
  });
}

}  // namespace

int join_blocks(int argc, const char* const* argv) {
  JoinOptions options;
  Program program("meshrepair-blocks join", "Joins the blocks that were repaired to one mesh.",
                  "  meshrepair-blocks join city.blocks repaired.ply\n");
  CLI::App& app = program.command_line();
  app.add_option("DIR", options.folder, "Folder that meshrepair-blocks plan has made")->required();
  app.add_option("OUT", options.step.output, "Mesh to write; - is standard output")
      ->check(names_file(mesh_extensions()))
      ->required();
  add_format_option(app, options.step.format);
  return program.run(argc, argv, [&](Run& run) { return join(options, run); });
}

}  // namespace meshrepair
