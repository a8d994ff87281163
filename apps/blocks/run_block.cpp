// SPDX-License-Identifier: MIT
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>

#include <spdlog/fmt/fmt.h>
#include <spdlog/logger.h>

#include <base/error.h>

#include "blocks/block_folder.h"
#include "blocks/verbs.h"
#include "options/numbers.h"
#include "process/file_checksum.h"
#include "resume/resumable.h"
#include "steps/repair_command.h"
#include "steps/run_steps.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

struct RunOptions {
  std::string folder;
  std::size_t block = 0;
  std::string resume;
  RepairCommand repair;
};

// Of the options those that change results, as they are for all blocks.
std::string options_text(const CommandLine& app) {
  return options_of_results(app, {"DIR", "--block"});
}

void require_block(const BlockPlan& plan, const BlockFolder& folder, std::size_t block) {
  if (block > plan.blocks.size()) {
    throw UsageError(fmt::format("--block: must be 1 to {}", plan.blocks.size()));
  }
  const std::filesystem::path file = folder.block_file(block);
  if (file_checksum(file) != plan.blocks[block - 1].checksum) {
    throw InputError(file.string() + ": is not what the plan says");
  }
}

// What is written besides the result is not kept: who asks for it has the block done again.
bool has_side_files(const StepOptions& steps) {
  return !steps.explained.empty() || steps.picture.wanted() || steps.html.wanted();
}

void require_files_outside(const BlockFolder& folder, const StepOptions& steps, Run& run) {
  folder.require_outside("--report", run.options.report, run);
  folder.require_outside("--explain", steps.explained, run);
  folder.require_outside("--picture", steps.picture.path, run);
  folder.require_outside("--html", steps.html.path, run);
}

// Blocks may be at work at the same time, so each has a folder of its own in that of --resume.
std::string resume_folder(const RunOptions& options) {
  if (options.resume.empty()) return {};
  std::error_code failed;
  std::filesystem::create_directories(options.resume, failed);
  return (std::filesystem::path(options.resume) / std::to_string(options.block)).string();
}

// What belongs to the whole mesh.
void require_options_of_blocks(const StepOptions& steps) {
  if (!steps.staging.empty()) throw UsageError("--staging: blocks have a folder of their own");
  if (steps.assets.units) {
    throw UsageError("--units: the unit of all blocks is that of the mesh that was divided");
  }
}

ExitCode code_of(const BlockResult& result) {
  return result.certified ? ExitCode::done : ExitCode::not_certified;
}

// What encloses nothing, as a sheet does, is no part of the result; the whole mesh has others.
// Nothing where the result was not to be written, as it lacks a guarantee.
std::optional<BlockResult> repaired(RunOptions& options, const CommandLine& app, Run& run) {
  BlockResult result;
  StepOptions& steps = options.repair.steps;
  try {
    const ExitCode code =
        run_steps(steps, run, [&](const StepOptions&, Run& inner, Findings& findings) {
          run_resumable(resume_folder(options), app, inner, [&](StateStore* states) {
            options.repair.steps.repair.states = states;
            repair_file(options.repair, inner, findings);
          });
        });
    result.certified = code == ExitCode::done;
    if (!result.certified && steps.strict) return std::nullopt;
    result.file = std::filesystem::path(steps.output).filename().string();
    result.result = file_checksum(steps.output);
  } catch (const NoSolidError& error) {
    warn("", {WarningCode::area_lost, error.what()});
    result.certified = true;
  }
  return result;
}

ExitCode run_of_block(RunOptions& options, const CommandLine& app, Run& run) {
  StepOptions& steps = options.repair.steps;
  require_options_of_blocks(steps);
  const BlockFolder folder(options.folder);
  require_files_outside(folder, steps, run);
  const BlockPlan plan = folder.read_plan();
  require_block(plan, folder, options.block);
  const std::string text = options_text(app);
  const std::uint64_t program = program_checksum();
  const auto before = folder.read_result(options.block, plan);
  const bool is_same = before && before->options == text && before->program == program;
  if (is_same && !has_side_files(steps)) {
    run.progress.finish();
    if (!run.options.quiet && run.options.report != "-")
      std::cout << fmt::format("block {} is done already\n", options.block);
    return code_of(*before);
  }
  if (!steps.format) steps.format = SoupFormat::ply_binary;
  steps.input = folder.block_file(options.block).string();
  steps.output =
      folder.result_file(options.block, text, std::string(extension_of(*steps.format))).string();
  std::optional<BlockResult> result = repaired(options, app, run);
  if (!result) return ExitCode::not_certified;
  result->block = plan.blocks[options.block - 1].checksum;
  result->program = program;
  result->options = text;
  folder.write_result(options.block, *result);
  if (before && !before->file.empty() && before->file != result->file) {
    std::filesystem::remove(folder.file_of(*before));
  }
  return code_of(*result);
}

}  // namespace

int run_block(int argc, const char* const* argv) {
  RunOptions options;
  Program program("meshrepair-blocks run",
                  "Repairs one block, unless it is repaired already. Options for the whole mesh,\n"
                  "such as --keep and --min-part, apply to each block.",
                  "  meshrepair-blocks run city.blocks --block 17\n"
                  "  meshrepair-blocks run city.blocks --block 17 --format stl --max-memory 4G\n");
  CommandLine& app = program.command_line();
  app.add_option("DIR", options.folder, "Folder from meshrepair-blocks plan")->required();
  app.add_option_function(
         "--block", [&](const std::string& text) { options.block = *parse_count(text); },
         "Number of the block, from 1")
      ->check(count_between(1))
      ->type_name("K")
      ->required()
      ->group("Blocks");
  add_repair_command(app, options.repair);
  add_resume_option(app, options.resume);
  return program.run(argc, argv, [&](Run& run) { return run_of_block(options, app, run); });
}

}  // namespace meshrepair
