// SPDX-License-Identifier: MIT
#include "process/memory_limit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/decimal.h>
#include <base/error.h>
#include <base/internal/system.h>

namespace meshrepair {
namespace {

// Nothing: it is none.
std::optional<double> factor_of(std::string_view unit) {
  constexpr std::string_view kUnits = "KMGT";
  std::string upper;
  for (const char c : unit) upper += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  if (upper.empty() || upper == "B") return 1;
  const std::size_t power = kUnits.find(upper[0]);
  const std::string rest = upper.substr(1);
  const bool is_one =
      power != std::string_view::npos && (rest.empty() || rest == "B" || rest == "IB");
  if (!is_one) return std::nullopt;
  return std::pow(1024.0, static_cast<double>(power) + 1);
}

// The number, and what is behind it; -1 where there is none.
std::pair<double, std::string_view> amount_in(std::string_view text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [at, error] = read_decimal(text.data(), end, number);
  if (error != std::errc() || !(number >= 0)) return {-1, {}};
  return {number, std::string_view(at, static_cast<std::size_t>(end - at))};
}

// Nothing: it is no size.
std::optional<std::uint64_t> bytes_in(double number, std::string_view unit) {
  const auto factor = factor_of(unit);
  if (number < 0 || !factor) return std::nullopt;
  const double bytes = number * *factor;
  if (!(bytes < 9e18) || (bytes > 0 && bytes < 1)) return std::nullopt;
  return static_cast<std::uint64_t>(bytes);
}

[[noreturn]] void fail(const std::string& option, const std::string& text, const char* what) {
  throw UsageError(option + ": " + (text.empty() ? "''" : text) + " is no " + what);
}

// Nothing free is no reason for no limit.
std::uint64_t share_of_free(double percent) {
  const auto free = internal::free_memory();
  if (!free) return 0;
  return static_cast<std::uint64_t>(std::max(1.0, static_cast<double>(*free) * percent / 100));
}

}  // namespace

MemoryLimit parse_memory_limit(const std::string& text) {
  const auto [number, unit] = amount_in(text);
  if (unit == "%" && number > 0 && number <= 100) return {share_of_free(number), true};
  const auto bytes = bytes_in(number, unit);
  if (!bytes) fail("--max-memory", text, "size of memory such as 200M, 1.5G or 80%");
  return {*bytes, false};
}

std::uint64_t parse_size(const std::string& text, const std::string& option) {
  const auto [number, unit] = amount_in(text);
  const auto bytes = bytes_in(number, unit);
  if (!bytes) fail(option, text, "size such as 200M or 1.5G");
  return *bytes;
}

void limit_memory(const MemoryLimit& limit, std::size_t threads) {
  if (limit.bytes == 0) return;
  const std::uint64_t needed = internal::limit_process_memory(limit.bytes, threads);
  if (needed == 0) return;
  const std::string what =
      memory_text(limit.bytes) + " is less than the program needs, " + memory_text(needed);
  if (limit.is_share) throw LimitError("too little memory is free: " + what);
  throw UsageError("--max-memory: " + what);
}

std::string memory_text(std::uint64_t bytes) {
  constexpr std::array<std::string_view, 5> kUnits = {"bytes", "KB", "MB", "GB", "TB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < kUnits.size(); ++unit) value /= 1024;
  return fmt::format("{:.4g} {}", value, kUnits[unit]);
}

}  // namespace meshrepair
