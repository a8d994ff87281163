// SPDX-License-Identifier: MIT
// The program meshcheck as a step: for its command line, and for calls from other languages.
#pragma once

#include <string>

#include "options/asset_options.h"
#include "options/command_line.h"
#include "options/show_requests.h"
#include "program/program.h"
#include "steps/check_steps.h"

namespace meshrepair {

struct CheckCommand {
  std::string input;
  AssetOptions assets;
  std::string marked;  // empty: no such file
  PictureRequest picture;
  HtmlRequest html;
  CheckRequest request;
};

// All options but IN and --json, and those of every program, which are for the caller to add.
void add_check_command(CommandLine& app, CheckCommand& command);

// Reads command.input, and says what is wrong with it. not_certified where it is not the boundary
// of a solid. Unless --quiet, what is found is printed.
[[nodiscard]] ExitCode check_file(CheckCommand& command, Run& run);

}  // namespace meshrepair
