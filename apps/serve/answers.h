// SPDX-License-Identifier: MIT
// What each address answers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "serve/guard.h"
#include "serve/workshop.h"

namespace meshrepair {

// As far as answers depend on it.
struct Request {
  std::string_view method;
  std::string_view target;   // "/jobs/12/page?x=y", as it was sent
  std::string_view options;  // X-Meshrepair-Options
  Sender sender;
};

struct Answer {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::map<std::string, std::string> headers;  // more of them
  std::string body;
  std::filesystem::path file;  // instead of the body, if it is not empty
};

class Answers {
 public:
  // Neither is owned.
  Answers(const Guard& guard, Workshop& workshop) : guard_(guard), workshop_(workshop) {}

  // A request that hands in a mesh: where its body is to be written, or why not.
  struct Upload {
    std::optional<Workshop::Intake> intake;
    Answer refusal;  // without an intake
  };
  [[nodiscard]] static bool is_upload(const Request& request);
  [[nodiscard]] Upload begin_upload(const Request& request) const;
  [[nodiscard]] Answer end_upload(const Workshop::Intake& intake) const;
  // The disk is full. True: there is more room now.
  [[nodiscard]] bool free_room() const { return workshop_.free_room(); }
  void discard_upload(const Workshop::Intake& intake) const { workshop_.discard(intake); }

  // All others. Their bodies are not looked at.
  [[nodiscard]] Answer answer(const Request& request) const;

 private:
  [[nodiscard]] Answer answer_of_job(const Request& request, const std::string& id,
                                     std::string_view what) const;
  [[nodiscard]] Answer status_of(const std::string& id) const;
  [[nodiscard]] Answer start_repair(const std::string& id, std::string_view options) const;
  [[nodiscard]] Answer page_of(const std::string& id, Task task) const;
  [[nodiscard]] Answer result_of(const std::string& id) const;

  const Guard& guard_;
  Workshop& workshop_;
};

[[nodiscard]] Answer refused(unsigned status, const std::string& why);

// "a%20b" as "a b"; nothing where it is broken, or holds a zero.
[[nodiscard]] std::optional<std::string> decode_query(std::string_view text);

}  // namespace meshrepair
