// SPDX-License-Identifier: MIT
#include "jobs/job_lines.h"

#include <algorithm>
#include <initializer_list>
#include <optional>

#include <base/base64.h>
#include <base/error.h>

namespace meshrepair {
namespace {

constexpr double kLongestGrace = 1e6;  // seconds

// Nothing else may be there: who mistypes a key is told so.
void check_keys(const Json& line, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : line.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw ValueError("'" + key + "' is not a key of a job");
    }
  }
}

const Json& required(const Json& line, std::string_view key) {
  const Json* const value = line.find(key);
  if (value == nullptr) throw ValueError("'" + std::string(key) + "' is missing");
  return *value;
}

// A text, or {"base64": "..."}.
std::optional<std::string> bytes_of(const Json& value) {
  if (auto text = value.as_text()) return text;
  const Json* const encoded = value.size() == 1 ? value.find("base64") : nullptr;
  const auto text = encoded != nullptr ? encoded->as_text() : std::nullopt;
  return text ? decode_base64(*text) : std::nullopt;
}

// Arguments of a program end at a zero.
std::string word_of(const Json& value, std::string_view key) {
  auto word = bytes_of(value);
  if (!word) throw ValueError("'" + std::string(key) + R"(': neither a text nor {"base64": TEXT})");
  if (word->find('\0') != std::string::npos) {
    throw ValueError("'" + std::string(key) + "': a zero byte");
  }
  return std::move(*word);
}

std::string file_of(const Json& line, std::string_view key) {
  std::string name = word_of(required(line, key), key);
  if (name == "-") {
    throw ValueError("'" + std::string(key) + "': standard input and output are the worker's");
  }
  return name;
}

Job job_of(const Json& line) {
  check_keys(line, {"id", "in", "out", "options"});
  Job job{required(line, "id"), file_of(line, "in"), file_of(line, "out"), {}};
  const Json* const options = line.find("options");
  if (options == nullptr) return job;
  if (!options->is_array()) throw ValueError("'options': no list");
  for (const Json& word : options->values()) job.options.push_back(word_of(word, "options"));
  return job;
}

Cancellation cancellation_of(const Json& line) {
  check_keys(line, {"cancel", "grace"});
  Cancellation cancellation;
  cancellation.id = required(line, "cancel");
  const Json* const grace = line.find("grace");
  if (grace == nullptr) return cancellation;
  const auto seconds = grace->as_number();
  if (!seconds || !(*seconds >= 0 && *seconds <= kLongestGrace)) {
    throw ValueError("'grace': not a number of seconds, 0 to 1000000");
  }
  cancellation.grace = *seconds;
  return cancellation;
}

}  // namespace

JobLine read_job_line(std::string_view line) {
  const std::optional<Json> json = Json::parse(line);
  if (!json || !json->is_object()) return WrongLine{{}, "the line is no JSON object"};
  try {
    if (json->contains("cancel")) return cancellation_of(*json);
    return job_of(*json);
  } catch (const ValueError& error) {
    const Json* const id = json->find("id");
    return WrongLine{id != nullptr ? *id : Json(), error.what()};
  }
}

}  // namespace meshrepair
