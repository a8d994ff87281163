// SPDX-License-Identifier: MIT
#include "summary/wall_words.h"

#include <cmath>
#include <cstddef>

#include <spdlog/fmt/fmt.h>

#include "report/words.h"

namespace meshrepair {
namespace {

std::string words_of_walls(const HollowReport& hollow) {
  if (hollow.most == 0) return {};
  if (!std::isfinite(hollow.most)) {
    return fmt::format("walls of {:.6g}, at least {:.4g} proven", hollow.wall, hollow.least);
  }
  return fmt::format("walls of {:.6g}: {:.4g} to {:.4g} proven", hollow.wall, hollow.least,
                     hollow.most);
}

// Of one diameter, with what they leave; what cannot be drained is told, too.
std::string words_of_drains(const HollowReport& hollow) {
  std::size_t drains = 0, closed = 0;
  for (const Cavity& cavity : hollow.cavities) {
    drains += cavity.drains.size();
    closed += cavity.opens ? 0 : 1;
  }
  std::vector<std::string> texts;
  if (drains > 0) {
    texts.push_back(fmt::format("{} of diameter {:.6g}, walls of at least {:.4g} beside {}",
                                number_of(drains, "drain"), hollow.drain, hollow.beside_drains,
                                drains == 1 ? "it" : "them"));
  }
  if (closed > 0) {
    texts.push_back(fmt::format("{} closed, so that nothing can flow out",
                                number_of(closed, "cavity is", "cavities are")));
  }
  return joined_with(", ", texts);
}

}  // namespace

std::vector<std::string> offset_words(const OffsetReport& offset) {
  if (offset.distance == 0) return {};
  const std::string proven = std::isfinite(offset.most)
                                 ? fmt::format("{:.4g} to {:.4g} proven", offset.least, offset.most)
                                 : fmt::format("at least {:.4g} proven", offset.least);
  return {fmt::format("{} by {:.6g}: {}; volume {:.6g} before",
                      offset.distance > 0 ? "outward" : "inward", std::abs(offset.distance), proven,
                      offset.volume_before)};
}

std::vector<std::string> hollow_words(const HollowReport& hollow) {
  if (hollow.wall == 0) return {};
  std::vector<std::string> texts;
  double volume = 0;
  for (const Cavity& cavity : hollow.cavities) volume += cavity.volume;
  texts.push_back(hollow.cavities.empty()
                      ? fmt::format("nothing: walls of {:.6g} leave no cavity", hollow.wall)
                      : fmt::format("{} of volume {:.6g}, {:.0f} % of the solid",
                                    number_of(hollow.cavities.size(), "cavity", "cavities"), volume,
                                    100 * volume / hollow.volume_before));
  texts.push_back(words_of_walls(hollow));
  texts.push_back(words_of_drains(hollow));
  if (hollow.left_full > 0) {
    texts.push_back(fmt::format("{} left full as too small, volume {:.4g}",
                                number_of(hollow.left_full, "cavity", "cavities"),
                                hollow.left_full_volume));
  }
  std::erase(texts, "");
  return texts;
}

}  // namespace meshrepair
