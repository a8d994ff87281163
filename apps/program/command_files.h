// SPDX-License-Identifier: MIT
// What can be said of the files of a command before hours of work: whether they are there or can be
// written, and whether two names lead to one file.
#pragma once

#include <string>
#include <vector>

#include "program/program.h"

namespace meshrepair {

// Whether two names lead to one file, there already or not. Devices are never one: /dev/null may be
// named as often as one likes.
[[nodiscard]] bool is_same_file(const std::string& a, const std::string& b);

// What can be said of the files before hours of work; `output` is empty when nothing is written.
// Throws UsageError where the report is the input or the output, too, and withholds it; OutputError
// where the output cannot be.
void check_files(const std::string& input, const std::string& output, Run& run);
// Of several inputs: throws InputError where one is not there, before the work on those before it.
void check_inputs(const std::vector<std::string>& inputs);

// Throws OutputError where there is no folder for this file, or there is one of its name.
void check_folder(const std::string& file);

// ".png", of "A.PNG" too; empty where there is none.
[[nodiscard]] std::string lower_extension(const std::string& path);

// A file beside the output: a picture, an explanation, a page.
struct SideFile {
  std::string option;  // "--picture"
  std::string path;
  std::string what;  // "picture"
};

// What can be said of it before hours of work. `others` are the other files of the command, of
// which some may be empty. Throws UsageError where it is one of them, or the report, which it
// withholds then; OutputError where it cannot be written.
void check_side_file(const SideFile& file, const std::vector<std::string>& others, Run& run);

}  // namespace meshrepair
