// Numbers of the command line. CLI11 takes them as C does, so that 0x10 is sixteen, 010 eight, and
// -1 a very large count; here they are decimal.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "common/command_line.h"

namespace meshrepair {

// 5, -0.5, +2 or 1e-3, also inf and nan; nothing where the word is no number.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);

// Digits alone.
[[nodiscard]] std::optional<std::size_t> parse_count(std::string_view word);

// For check() of an option: what says why a word is no such number.
[[nodiscard]] WhyNot number_between(double least,
                                    double most = std::numeric_limits<double>::infinity());
[[nodiscard]] WhyNot count_between(std::size_t least,
                                   std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace meshrepair
