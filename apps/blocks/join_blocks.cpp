// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <iostream>
#include <sstream>
#include <string_view>
#include <utility>

#include <spdlog/fmt/fmt.h>
#include <spdlog/logger.h>

#include <base/error.h>
#include <check/part_groups.h>
#include <check/part_orientation.h>
#include <check/self_intersections.h>
#include <mesh/append_soup.h>
#include <mesh/mesh_limits.h>
#include <mesh/precision.h>

#include "blocks/block_folder.h"
#include "blocks/verbs.h"
#include "options/file_kinds.h"
#include "options/repair_options.h"
#include "program/command_files.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/words.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"
#include "steps/step_options.h"
#include "terminal/logging.h"

namespace meshrepair {
namespace {

constexpr std::size_t kMostNamed = 10;
constexpr std::size_t kLongestCommand = 1000;  // longer ones are left without the rest

struct JoinOptions {
  std::string folder;
  StepOptions step;
};

// All results, block behind block.
struct Joined {
  TriangleSoup soup;
  std::vector<std::size_t> first;  // of each block, its first triangle
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

// For a shell. Empty for a word that cannot be shown.
std::string for_shell(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("-_=.,:/%+@").find(static_cast<char>(c)) != std::string_view::npos;
  };
  const auto is_hidden = [](unsigned char c) { return std::iscntrl(c) != 0; };
  if (std::any_of(word.begin(), word.end(), is_hidden)) return {};
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

// That does a block as the first of the others were done, whose options come from a file.
std::string command_of(const JoinOptions& options, std::size_t block,
                       const std::vector<BlockResult>& results) {
  std::string command =
      fmt::format("meshrepair-blocks run {} --block {}", for_shell(options.folder), block);
  std::istringstream words(results.empty() ? "" : results[0].options);
  for (std::string word; std::getline(words, word);) {
    const std::string text = for_shell(word);
    if (!word.starts_with("--") || text.size() > kLongestCommand - command.size()) break;
    if (!text.empty()) command += ' ' + text;
  }
  return command;
}

void require_same(const JoinOptions& options, const std::vector<BlockResult>& results) {
  for (std::size_t b = 1; b < results.size(); ++b) {
    const bool has_same_options = results[b].options == results[0].options;
    if (has_same_options && results[b].program == results[0].program) continue;
    throw InputError(fmt::format(
        "{}: block {} was repaired {} than block 1; run: {}", options.folder, b + 1,
        has_same_options ? "by another build of meshrepair-blocks" : "with other options",
        command_of(options, b + 1, results)));
  }
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
    throw InputError(fmt::format("{}: not repaired: {} {}; run: {}", options.folder,
                                 missing.size() == 1 ? "block" : "blocks", named(missing),
                                 command_of(options, missing[0], results)));
  }
  require_same(options, results);
  return results;
}

// What the format rounds and welds was so before: it still is what was certified.
bool stays_certified(const ReadResult& part, SoupFormat format) {
  if (welds_points(format) && !welds_points(part.report.format)) return false;
  return !is_single(format) ||
         std::all_of(part.soup.points.begin(), part.soup.points.end(),
                     [](const Vec3d& p) { return rounded_to_float32(p) == p; });
}

void append(const TriangleSoup& part, Joined& joined) {
  if (part.points.size() > kMostPoints - joined.soup.points.size() ||
      part.triangles.size() > kMostTriangles - joined.soup.triangles.size()) {
    throw LimitError("all blocks together have more points or triangles than a mesh can have");
  }
  append_soup(joined.soup, part);
}

Joined read_all(const JoinOptions& options, const BlockFolder& folder, const BlockPlan& plan,
                SoupFormat format, Run& run) {
  const std::vector<BlockResult> results = read_results(options, folder, plan);
  Joined joined;
  for (std::size_t b = 0; b < results.size(); ++b) {
    joined.first.push_back(joined.soup.triangles.size());
    if (!results[b].certified) joined.uncertified.push_back(b + 1);
    if (results[b].file.empty()) {
      joined.empty.push_back(b + 1);
      continue;
    }
    const ReadResult part = read_soup(folder.file_of(results[b]), read_options(run));
    if (!stays_certified(part, format)) {
      throw UsageError(
          fmt::format("{}: {} rounds or merges vertices of the blocks: repair them with its "
                      "--format, too, or write PLY, OBJ or OFF",
                      options.step.output, format_name(format)));
    }
    append(part.soup, joined);
    run.progress.advance(static_cast<double>(b + 1) / static_cast<double>(results.size()));
  }
  return joined;
}

std::size_t block_of(const Joined& joined, std::size_t triangle) {
  const auto after = std::upper_bound(joined.first.begin(), joined.first.end(), triangle);
  return static_cast<std::size_t>(after - joined.first.begin()) - 1;
}

// The triangles of parts whose boxes meet those of other blocks, by themselves or by others.
std::vector<std::uint32_t> triangles_near_others(const Joined& joined) {
  constexpr std::size_t kNone = ~std::size_t{0};
  const PartGroups groups = find_groups(joined.soup, 0);
  std::vector<std::size_t> block(groups.size(), kNone);
  std::vector<char> is_near(groups.size(), 0);
  for (std::size_t t = 0; t < joined.soup.triangles.size(); ++t) {
    const std::uint32_t group = groups.of_triangle[t];
    const std::size_t own = block_of(joined, t);
    if (block[group] == kNone) block[group] = own;
    if (block[group] != own) is_near[group] = 1;
  }
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < groups.of_triangle.size(); ++t) {
    if (is_near[groups.of_triangle[t]] != 0) found.push_back(t);
  }
  return found;
}

// What is wrong between blocks. Each is certified for itself, and parts whose boxes do not meet
// have nothing to do with each other.
struct Between {
  std::size_t pairs = 0;       // of triangles that meet
  std::size_t inside_out = 0;  // parts that lie in the solid of another block
};

std::size_t pairs_between(const Joined& joined, const std::vector<std::uint32_t>& nearby,
                          Run& run) {
  SelfIntersectionOptions options;
  options.most_pairs = joined.soup.triangles.size();
  options.progress = &run.progress;
  const SelfIntersections found = self_intersections(joined.soup, nearby, options);
  return static_cast<std::size_t>(std::count_if(
      found.pairs.begin(), found.pairs.end(),
      [&](const auto& pair) { return block_of(joined, pair[0]) != block_of(joined, pair[1]); }));
}

Between look_between(const Joined& joined, Run& run) {
  Between between;
  const std::vector<std::uint32_t> nearby = triangles_near_others(joined);
  if (nearby.empty()) return between;
  between.pairs = pairs_between(joined, nearby, run);
  // What crosses has no inside.
  if (between.pairs > 0 || !joined.uncertified.empty()) return between;
  const PartOrientation parts = examine_part_orientation(joined.soup, &run.progress);
  between.inside_out =
      static_cast<std::size_t>(std::count(parts.inside_out.begin(), parts.inside_out.end(), 1));
  return between;
}

std::string faults_of(const Joined& joined, const Between& between) {
  std::string faults;
  if (!joined.uncertified.empty()) {
    faults = "without all guarantees in block " + named(joined.uncertified);
  }
  if (between.pairs > 0) {
    faults += (faults.empty() ? "" : ", and ") +
              fmt::format("{} of triangles of different blocks meet: plan with a larger --margin",
                          number_of(between.pairs, "pair"));
  }
  if (between.inside_out > 0) {
    faults += fmt::format("{} in the solid of another block: plan with a larger --margin",
                          number_of(between.inside_out, "part"));
  }
  return faults;
}

ExitCode join(JoinOptions& options, Run& run) {
  const BlockFolder folder(options.folder);
  const BlockPlan plan = folder.read_plan();
  folder.require_outside("OUT", options.step.output, run);
  folder.require_outside("--report", run.options.report, run);
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
    const Between between = look_between(joined, run);
    meter.end();
    run.report.set_section("blocks", {{"count", plan.blocks.size()},
                                      {"enclosing_nothing", joined.empty},
                                      {"not_certified", joined.uncertified},
                                      {"pairs_between", between.pairs},
                                      {"inside_out", between.inside_out}});
    write_soup_stage(joined.soup, format, run, findings);
    run.progress.finish();
    const std::string faults = faults_of(joined, between);
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
  Program program("meshrepair-blocks join", "Joins the repaired blocks into one mesh.",
                  "  meshrepair-blocks join city.blocks repaired.ply\n");
  CommandLine& app = program.command_line();
  app.add_option("DIR", options.folder, "Folder from meshrepair-blocks plan")->required();
  app.add_option("OUT", options.step.output, "Mesh to write; - is standard output")
      ->check(names_file(mesh_extensions()))
      ->required();
  add_format_option(app, options.step.format);
  return program.run(argc, argv, [&](Run& run) { return join(options, run); });
}

}  // namespace meshrepair
