// SPDX-License-Identifier: MIT
// What is proven of walls and of offset surfaces, for people.
#pragma once

#include <string>
#include <vector>

#include <hollow/hollow_report.h>
#include <hollow/offset.h>

namespace meshrepair {

// A line each; empty where nothing was asked for.
[[nodiscard]] std::vector<std::string> offset_words(const OffsetReport& offset);
[[nodiscard]] std::vector<std::string> hollow_words(const HollowReport& hollow);

}  // namespace meshrepair
