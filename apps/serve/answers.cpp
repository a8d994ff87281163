// SPDX-License-Identifier: MIT
#include "serve/answers.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <utility>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <base/error.h>

#include "report/json_report.h"
#include "serve/serve_page.h"

namespace meshrepair {
namespace {

constexpr std::size_t kSecretLength = 32;
constexpr std::string_view kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; frame-src "
    "'self'; "
    "img-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
// The page of a mesh has its own policy, too. It can neither ask this server nor reach what is
// around it.
constexpr std::string_view kPolicyOfPages = "sandbox allow-scripts; frame-ancestors 'self'";

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

// Of "?name=a.stl&x=y" the value of "name", as it was sent.
std::string_view query_value(std::string_view target, std::string_view key) {
  const std::size_t begin = target.find('?');
  std::string_view rest = begin == std::string_view::npos ? "" : target.substr(begin + 1);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    if (pair.substr(0, key.size()) == key && pair.substr(key.size(), 1) == "=") {
      return pair.substr(key.size() + 1);
    }
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
  }
  return {};
}

int digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string encode_percent(std::string_view text) {
  std::string encoded;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(byte) != 0 || c == '-' || c == '.' || c == '_' || c == '~';
    encoded += is_plain && byte < 0x80 ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return encoded;
}

Answer of_text(std::string_view text, std::string type) {
  Answer answer;
  answer.type = std::move(type);
  answer.body = text;
  return answer;
}

Answer of_json(const Json& json, unsigned status = 200) {
  Answer answer;
  answer.status = status;
  answer.type = "application/json";
  answer.body = json.dump(-1, true);
  return answer;
}

std::optional<Answer> asset(std::string_view path) {
  if (path == "/") {
    Answer answer = of_text(serve_page(), "text/html; charset=utf-8");
    answer.headers["Content-Security-Policy"] = kPolicy;
    return answer;
  }
  if (path == "/favicon.ico") {  // browsers ask for it unasked
    Answer none;
    none.status = 204;
    return none;
  }
  if (path == "/serve.js") return of_text(serve_script(), "text/javascript; charset=utf-8");
  if (path == "/serve.css") return of_text(serve_style(), "text/css; charset=utf-8");
  return std::nullopt;
}

std::string_view phase_name(JobState::Phase phase) {
  switch (phase) {
    case JobState::Phase::waiting:
      return "waiting";
    case JobState::Phase::running:
      return "running";
    case JobState::Phase::ended:
      return "ended";
  }
  return "ended";
}

bool is_plain_value(const std::string& value) {
  return value.size() <= 100 && std::all_of(value.begin(), value.end(), [](char c) {
           return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
         });
}

// {"format": "stl", "for": "print", "always": true}; nothing where it is something else.
struct RepairWish {
  std::string extension;
  ProgramOptions options;
};
std::optional<RepairWish> wish_of(std::string_view text) {
  const std::optional<Json> json = Json::parse(text);
  if (!json || !json->is_object()) return std::nullopt;
  RepairWish wish;
  for (const auto& [name, value] : json->items()) {
    const std::string word = value.as_text().value_or("");
    if (name == "format" && value.is_string()) {
      wish.extension = "." + word;
    } else if (is_open_option(name) && is_plain_value(word) && !word.empty()) {
      wish.options.emplace_back(name, word);
    } else if (is_open_flag(name) && value.is_boolean()) {
      if (*value.as_bool()) wish.options.emplace_back(name, "");
    } else {
      return std::nullopt;
    }
  }
  if (!is_result_extension(wish.extension)) return std::nullopt;
  return wish;
}

}  // namespace

std::optional<std::string> decode_query(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      const int high = i + 2 < text.size() ? digit_of(text[i + 1]) : -1;
      const int low = i + 2 < text.size() ? digit_of(text[i + 2]) : -1;
      if (high < 0 || low < 0) return std::nullopt;
      c = static_cast<char>(16 * high + low);
      i += 2;
    }
    if (c == '\0') return std::nullopt;
    decoded += c;
  }
  return decoded;
}

Answer refused(unsigned status, const std::string& why) {
  return of_json({{"error", why}}, status);
}

bool Answers::is_upload(const Request& request) {
  return request.method == "POST" && path_of(request.target) == "/jobs";
}

Answers::Upload Answers::begin_upload(const Request& request) const {
  if (const auto why = guard_.refusal_with_token(request.sender)) return {{}, refused(403, *why)};
  const auto name = decode_query(query_value(request.target, "name"));
  if (!name || !is_mesh_name(*name)) {
    return {{}, refused(400, "the name is not that of a mesh: STL, OBJ, OFF, PLY, glTF or 3MF")};
  }
  try {
    Upload upload{workshop_.begin(*name), {}};
    if (!upload.intake) {
      upload.refusal = refused(503, "there are too many meshes: close some of them");
    }
    return upload;
  } catch (const OutputError& error) {
    return {{}, refused(507, error.what())};
  }
}

Answer Answers::end_upload(const Workshop::Intake& intake) const {
  workshop_.add(intake);
  return of_json({{"job", intake.id}}, 201);
}

Answer Answers::answer(const Request& request) const {
  if (const auto why = guard_.refusal_of_public(request.sender)) return refused(403, *why);
  const std::string_view path = path_of(request.target);
  const bool is_get = request.method == "GET" || request.method == "HEAD";
  if (const auto found = asset(path)) {
    return is_get ? *found : refused(405, "only GET");
  }
  if (const auto why = guard_.refusal(request.sender)) return refused(403, *why);
  constexpr std::string_view kJobs = "/jobs/";
  if (path.substr(0, kJobs.size()) != kJobs) return refused(404, "there is no such address");
  const std::string_view rest = path.substr(kJobs.size());
  const std::string id(rest.substr(0, rest.find('/')));
  const bool is_id = id.size() == kSecretLength &&
                     std::all_of(id.begin(), id.end(), [](char c) { return digit_of(c) >= 0; });
  if (!is_id) return refused(404, "there is no such mesh");
  return answer_of_job(request, id, rest.substr(id.size()));
}

// What a browser opens by itself, the pages and the result, is known by a number that nobody can
// guess; all else needs the token.
Answer Answers::answer_of_job(const Request& request, const std::string& id,
                              std::string_view what) const {
  const bool is_get = request.method == "GET" || request.method == "HEAD";
  if (is_get && what == "/check.html") return page_of(id, Task::check);
  if (is_get && what == "/repair.html") return page_of(id, Task::repair);
  if (is_get && what == "/result") return result_of(id);
  if (const auto why = guard_.refusal_with_token(request.sender)) return refused(403, *why);
  if (what.empty() && is_get) return status_of(id);
  if (what.empty() && request.method == "DELETE") {
    workshop_.remove(id);
    return of_json(Json::object());
  }
  if (what == "/repair" && request.method == "POST") return start_repair(id, request.options);
  if (what == "/cancel" && request.method == "POST") {
    workshop_.cancel(id);
    return of_json(Json::object());
  }
  return refused(404, "there is no such address");
}

Answer Answers::status_of(const std::string& id) const {
  const auto state = workshop_.state(id);
  if (!state) return refused(404, "there is no such mesh");
  Json report = Json::parse(state->report).value_or(Json());
  if (report.is_object()) report.erase("command");
  return of_json({{"name", state->name},
                  {"task", state->task == Task::check ? "check" : "repair"},
                  {"phase", phase_name(state->phase)},
                  {"stage", state->stage},
                  {"percent", state->percent},
                  {"exit_code", state->exit_code},
                  {"has_result", state->has_result},
                  {"has_page", state->has_page},
                  {"report", report}});
}

Answer Answers::start_repair(const std::string& id, std::string_view options) const {
  auto wish = wish_of(options);
  if (!wish) return refused(400, "the options are not those of a repair");
  try {
    if (!workshop_.repair(id, wish->extension, std::move(wish->options))) {
      return refused(409, "there is no such mesh, or it is at work");
    }
    return of_json(Json::object(), 202);
  } catch (const OutputError& error) {
    return refused(507, error.what());
  }
}

Answer Answers::page_of(const std::string& id, Task task) const {
  Answer answer;
  answer.type = "text/html; charset=utf-8";
  answer.file = workshop_.page_of(id, task);
  answer.headers["Content-Security-Policy"] = kPolicyOfPages;
  std::error_code none;
  return std::filesystem::exists(answer.file, none) ? answer
                                                    : refused(404, "there is no such page");
}

Answer Answers::result_of(const std::string& id) const {
  const auto result = workshop_.result(id);
  if (!result) return refused(404, "there is no result");
  Answer answer;
  answer.type = "application/octet-stream";
  answer.file = result->file;
  answer.headers["Content-Disposition"] =
      "attachment; filename*=UTF-8''" + encode_percent(result->name);
  return answer;
}

}  // namespace meshrepair
