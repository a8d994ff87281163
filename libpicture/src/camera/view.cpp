// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <system_error>
#include <utility>

#include <base/decimal.h>
#include <picture/view.h>

namespace meshrepair {
namespace {

constexpr std::array<std::pair<std::string_view, View>, 7> kNamedViews = {{{"front", {0, 0}},
                                                                           {"back", {180, 0}},
                                                                           {"left", {270, 0}},
                                                                           {"right", {90, 0}},
                                                                           {"top", {0, 90}},
                                                                           {"bottom", {0, -90}},
                                                                           {"iso", {}}}};

std::optional<double> angle_of(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [at, error] = read_decimal(text.data(), end, value);
  if (error != std::errc() || at != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::optional<View> view_of(std::string_view text) {
  for (const auto& [name, view] : kNamedViews) {
    if (name == text) return view;
  }
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto azimuth = angle_of(text.substr(0, comma));
  const auto elevation = angle_of(text.substr(comma + 1));
  if (!azimuth || !elevation || std::abs(*elevation) > 90) return std::nullopt;
  return View{*azimuth, *elevation};
}

}  // namespace meshrepair
