// SPDX-License-Identifier: MIT
// Who may ask: the page that this process serves, and nobody else in the same browser.
//
// Other pages may send requests here, too: to the loopback address itself, or by a name of theirs
// that leads to it (DNS rebinding). They cannot read the token, cannot set its header on requests
// to another origin, and cannot forge Host and Origin.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace meshrepair {

// What a request says of where it comes from; empty: it says nothing.
struct Sender {
  std::string_view host;        // Host
  std::string_view origin;      // Origin
  std::string_view fetch_site;  // Sec-Fetch-Site
  std::string_view token;       // X-Meshrepair-Token
};

class Guard {
 public:
  Guard(unsigned short port, std::string token);

  // Why such a request is refused; nothing: it is let through. Of what holds no secret, also links
  // and forwards of other pages lead here.
  [[nodiscard]] std::optional<std::string> refusal_of_public(const Sender& sender) const;
  [[nodiscard]] std::optional<std::string> refusal(const Sender& sender) const;
  // The same of a request that also needs the token.
  [[nodiscard]] std::optional<std::string> refusal_with_token(const Sender& sender) const;

 private:
  [[nodiscard]] bool is_here(std::string_view host) const;

  std::string by_number_, by_name_;  // "127.0.0.1:1234", "localhost:1234"
  std::string token_;
};

// 32 hexadecimal digits that nobody can guess. Throws Error where the system has no randomness.
[[nodiscard]] std::string random_secret();

}  // namespace meshrepair
