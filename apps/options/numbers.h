// SPDX-License-Identifier: MIT
// Numbers of the command line. CLI11 takes them as C does, so that 0x10 is sixteen, 010 eight, and
// -1 a very large count; here they are decimal.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <base/vec3.h>

#include "options/command_line.h"

namespace meshrepair {

inline constexpr std::size_t kMostThreads = 1024;  // that --threads takes

// 5, -0.5, +2 or 1e-3, also inf and nan; nothing where the word is no number.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);

// Digits alone.
[[nodiscard]] std::optional<std::size_t> parse_count(std::string_view word);

// A length from 0 on, and whether it is a share, as 1% is; nothing where the word says none.
[[nodiscard]] std::optional<std::pair<double, bool>> distance_in(std::string_view word);

// The same above 0.
[[nodiscard]] std::optional<std::pair<double, bool>> length_in(std::string_view word);

// Three finite numbers, as X,Y,Z; nothing where the word is anything else.
[[nodiscard]] std::optional<Vec3d> vector_in(std::string_view word);

// For check() of an option: an empty text where the word is a length.
[[nodiscard]] std::string why_no_length(const std::string& word);

// An option that takes a length, or a share.
CommandOption* add_length_option(CommandLine& app, const std::string& name, double& length,
                                 bool& is_share, const std::string& description,
                                 const std::string& group);

// For check() of an option: what says why a word is no such number.
[[nodiscard]] WhyNot number_between(double least,
                                    double most = std::numeric_limits<double>::infinity());
[[nodiscard]] WhyNot count_between(std::size_t least,
                                   std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace meshrepair
