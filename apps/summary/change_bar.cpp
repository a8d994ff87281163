// SPDX-License-Identifier: MIT
#include "summary/change_bar.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string_view>

#include <spdlog/fmt/fmt.h>

namespace meshrepair {
namespace {

constexpr std::size_t kWidth = 40;

struct Share {
  char character;
  std::string_view meaning;
  std::size_t count;
};

// Rounded down, but one where there is any; the largest share takes what is left.
std::array<std::size_t, 3> widths_of(const std::array<Share, 3>& shares, std::size_t all) {
  std::array<std::size_t, 3> widths{};
  std::size_t largest = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i].count > shares[largest].count) largest = i;
    const double share = static_cast<double>(shares[i].count) / static_cast<double>(all);
    widths[i] = static_cast<std::size_t>(share * static_cast<double>(kWidth));
    if (shares[i].count > 0) widths[i] = std::max<std::size_t>(widths[i], 1);
  }
  widths[largest] = 0;
  widths[largest] = kWidth - std::accumulate(widths.begin(), widths.end(), std::size_t{0});
  return widths;
}

// "12 %", and never 0 % or 100 % of what is not quite.
std::string percent(std::size_t count, std::size_t all) {
  if (count == all) return "100 %";
  const double share = 100 * static_cast<double>(count) / static_cast<double>(all);
  if (share < 1) return "under 1 %";
  return share > 99 ? "over 99 %" : fmt::format("{:.0f} %", share);
}

}  // namespace

std::string change_bar(const RepairReport& repair) {
  const std::size_t all = repair.clean.triangles_in;
  if (all == 0) return {};
  const std::size_t untouched =
      std::min(all, repair.triangles.untouched + repair.triangles.rounded);
  const std::size_t cut =
      std::min(all - untouched, repair.triangles.cut - repair.triangles.rounded);
  const std::array<Share, 3> shares = {
      {{'=', "untouched", untouched}, {'+', "cut", cut}, {'-', "removed", all - untouched - cut}}};
  const std::array<std::size_t, 3> widths = widths_of(shares, all);
  std::string bar, words;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const Share& share = shares[i];
    bar.append(widths[i], share.character);
    if (share.count == 0) continue;
    words += fmt::format("{}{} {} {}", words.empty() ? "" : ", ", share.character, share.meaning,
                         percent(share.count, all));
  }
  return fmt::format("{:<9} [{}] {}\n", "changed", bar, words);
}

}  // namespace meshrepair
