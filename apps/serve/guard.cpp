// SPDX-License-Identifier: MIT
#include "serve/guard.h"

#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <base/internal/system.h>

namespace meshrepair {
namespace {

// In a time that does not tell where they differ.
bool is_same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return difference == 0;
}

}  // namespace

Guard::Guard(unsigned short port, std::string token)
    : by_number_(fmt::format("127.0.0.1:{}", port)),
      by_name_(fmt::format("localhost:{}", port)),
      token_(std::move(token)) {}

bool Guard::is_here(std::string_view host) const { return host == by_number_ || host == by_name_; }

std::optional<std::string> Guard::refusal_of_public(const Sender& sender) const {
  if (!is_here(sender.host)) return "the Host is not this server";
  constexpr std::string_view kScheme = "http://";
  const bool has_origin = !sender.origin.empty();
  if (has_origin && (sender.origin.substr(0, kScheme.size()) != kScheme ||
                     !is_here(sender.origin.substr(kScheme.size())))) {
    return "the Origin is not this server";
  }
  return std::nullopt;
}

std::optional<std::string> Guard::refusal(const Sender& sender) const {
  if (auto why = refusal_of_public(sender)) return why;
  if (!sender.fetch_site.empty() && sender.fetch_site != "same-origin" &&
      sender.fetch_site != "none") {
    return "another site asks";
  }
  return std::nullopt;
}

std::optional<std::string> Guard::refusal_with_token(const Sender& sender) const {
  if (auto why = refusal(sender)) return why;
  if (!is_same_secret(sender.token, token_)) return "the token is missing or wrong";
  return std::nullopt;
}

std::string random_secret() {
  const auto first = internal::random_bits(), second = internal::random_bits();
  if (!first || !second) throw Error("the system gives no random numbers");
  return fmt::format("{:016x}{:016x}", *first, *second);
}

}  // namespace meshrepair
