// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <iostream>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>
#include <spdlog/logger.h>

#include <base/error.h>
#include <check/part_groups.h>

#include "blocks/block_folder.h"
#include "blocks/verbs.h"
#include "options/file_kinds.h"
#include "options/numbers.h"
#include "process/file_checksum.h"
#include "program/command_files.h"
#include "program/program.h"
#include "report/attribute_report.h"
#include "report/findings.h"
#include "report/report_sections.h"
#include "report/words.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

constexpr std::size_t kTrianglesOfBlock = 1'000'000;
constexpr double kMargin = 0.01;

struct PlanOptions {
  std::string input, folder;
  std::size_t triangles = kTrianglesOfBlock;
  double margin = kMargin;
};

// The triangles of each block, in their order.
class BlockWriter {
 public:
  BlockWriter(const TriangleSoup& soup, const PartGroups& groups,
              const std::vector<std::uint32_t>& block_of, std::size_t blocks)
      : soup_(soup), number_(soup.points.size()), start_(blocks + 1, 0) {
    for (const std::uint32_t g : groups.of_triangle) ++start_[block_of[g] + 1];
    for (std::size_t b = 0; b < blocks; ++b) start_[b + 1] += start_[b];
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    order_.resize(soup.triangles.size());
    for (std::uint32_t t = 0; t < order_.size(); ++t) {
      order_[next[block_of[groups.of_triangle[t]]]++] = t;
    }
  }

  // No point is in two blocks: parts are connected through points.
  [[nodiscard]] TriangleSoup soup_of(std::size_t block) {
    TriangleSoup part;
    for (std::size_t i = start_[block]; i < start_[block + 1]; ++i) {
      std::array<std::uint32_t, 3> corners = soup_.triangles[order_[i]];
      for (std::uint32_t& corner : corners) {
        const std::uint32_t p = corner;
        if (number_[p] == 0) {
          part.points.push_back(soup_.points[p]);
          number_[p] = static_cast<std::uint32_t>(part.points.size());
        }
        corner = number_[p] - 1;
      }
      part.triangles.push_back(corners);
    }
    return part;
  }

 private:
  const TriangleSoup& soup_;
  std::vector<std::uint32_t> number_;  // of each point in its block, from 1; 0: not known yet
  std::vector<std::size_t> start_;     // of each block, in order_
  std::vector<std::uint32_t> order_;   // triangles, block by block
};

BlockPlan write_blocks(const TriangleSoup& soup, const PartGroups& groups,
                       const PlanOptions& options, const BlockFolder& folder,
                       ProgressObserver& progress) {
  const std::vector<std::uint32_t> block_of = divide_into_blocks(groups, options.triangles);
  const std::size_t blocks = 1 + std::size_t{*std::max_element(block_of.begin(), block_of.end())};
  BlockPlan plan;
  plan.input = options.input;
  plan.triangles = soup.triangles.size();
  plan.blocks.resize(blocks);
  for (std::size_t g = 0; g < groups.size(); ++g) ++plan.blocks[block_of[g]].groups;
  BlockWriter writer(soup, groups, block_of, blocks);
  WriteOptions format;
  format.format = SoupFormat::ply_binary;
  format.progress = &progress;
  for (std::size_t b = 0; b < blocks; ++b) {
    const TriangleSoup part = writer.soup_of(b);
    const std::filesystem::path file = folder.block_file(b + 1);
    write_soup(part, file, format);
    plan.blocks[b].triangles = part.triangles.size();
    plan.blocks[b].checksum = file_checksum(file);
    progress.advance(static_cast<double>(b + 1) / static_cast<double>(blocks));
  }
  return plan;
}

void say(const BlockPlan& plan, const PartGroups& groups, const PlanOptions& options, Run& run) {
  std::size_t largest = 0;
  for (const Block& block : plan.blocks) largest = std::max(largest, block.triangles);
  run.report.set_section(
      "blocks", {{"count", plan.blocks.size()}, {"groups", groups.size()}, {"largest", largest}});
  run.report.set_output({{"path", options.folder}, {"format", "blocks"}});
  if (plan.blocks.size() == 1 && plan.triangles > options.triangles) {
    warn(options.input, {WarningCode::one_block,
                         "all parts are one, or near each other: there is one block, and several "
                         "machines do not help"});
  }
  run.progress.finish();
  if (run.options.quiet || run.options.report == "-") return;
  std::cout << fmt::format("{} in {} of parts\n{} in {}, the largest of {}\n",
                           number_of(plan.triangles, "triangle"), number_of(groups.size(), "group"),
                           number_of(plan.blocks.size(), "block"), options.folder,
                           number_of(largest, "triangle"));
}

ExitCode plan(const PlanOptions& options, Run& run) {
  check_files(options.input, "", run);
  const BlockFolder folder(options.folder);
  Findings findings(options.input, "");
  ReadOptions reading = read_options(run);
  reading.attributes = true;
  return with_findings(run, findings, [&] {
    const ReadResult input = read_mesh_stage(reading, run, findings);
    if (!input.attributes.empty()) {
      warn(options.input,
           {WarningCode::attributes_lost, "its colours, textures and names are not in the blocks"});
    }
    folder.create();
    StageMeter meter(findings.repair.stages, &run.progress);
    meter.begin("group");
    const PartGroups groups = find_groups(input.soup, options.margin);
    meter.begin("write");
    BlockPlan plan = write_blocks(input.soup, groups, options, folder, run.progress);
    plan.unit = findings.unit;
    folder.write_plan(plan);
    meter.end();
    say(plan, groups, options, run);
    return ExitCode::done;
  });
}

}  // namespace

int plan_blocks(int argc, const char* const* argv) {
  PlanOptions options;
  Program program("meshrepair-blocks plan", "Divides a mesh into independent blocks.",
                  "  meshrepair-blocks plan city.stl city.blocks\n"
                  "  meshrepair-blocks plan --triangles 5000000 city.stl city.blocks\n");
  CommandLine& app = program.command_line();
  app.add_option("IN", options.input, "Mesh to divide, as meshrepair reads it")
      ->check(names_file(mesh_extensions()))
      ->required();
  app.add_option("DIR", options.folder, "Folder for the blocks; it is created")->required();
  app.add_option_function(
         "--triangles", [&](const std::string& text) { options.triangles = *parse_count(text); },
         "Most triangles in a block, as far as the mesh can be divided")
      ->default_str(std::to_string(kTrianglesOfBlock))
      ->check(count_between(1))
      ->type_name("N")
      ->group("Blocks");
  app.add_option_function(
         "--margin", [&](const std::string& text) { options.margin = *parse_number(text); },
         "Parts stay together if their boxes, each enlarged by this share of its\n"
         "diagonal, overlap")
      ->default_str("0.01")
      ->check(number_between(0, 1))
      ->type_name("SHARE")
      ->group("Blocks");
  return program.run(argc, argv, [&](Run& run) { return plan(options, run); });
}

}  // namespace meshrepair
