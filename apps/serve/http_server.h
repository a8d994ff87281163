// SPDX-License-Identifier: MIT
// A server of HTTP/1.1 on the loopback address.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "serve/answers.h"

namespace meshrepair {

class HttpServer {
 public:
  struct Limits {
    std::uint64_t body = std::uint64_t{2} << 30;  // bytes of a mesh
    std::size_t connections = 64;                 // at a time; more are told to come back
    unsigned seconds_for_head = 10;
    unsigned seconds_without_byte = 30;  // of a body, either way
  };

  // Listens on 127.0.0.1 at this port, 0: one that is free. Throws UsageError where it is taken.
  explicit HttpServer(unsigned short port);
  ~HttpServer();

  [[nodiscard]] unsigned short port() const;

  // Serves until `ended`, which is asked several times a second. `answers` must outlive it.
  void serve(const Answers& answers, const Limits& limits, const std::function<bool()>& ended);

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
};

}  // namespace meshrepair
