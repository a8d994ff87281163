// SPDX-License-Identifier: MIT
// A value of JSON: what reports and pages are made of. It is written and read by nlohmann/json,
// which one source knows, as each that knows it takes seconds to compile; members have its names.
//
//   Json report = {{"triangles", 12}, {"edges", {{"open", 0}}}};
//   report["stages"] = Json::array();
//   std::string text = report.dump(2);
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meshrepair {

class Json {
 public:
  Json();  // null
  Json(std::nullptr_t) : Json() {}
  Json(std::same_as<bool> auto value) : Json(Boolean{value}) {}
  Json(std::signed_integral auto value) : Json(Signed{value}) {}
  template <std::unsigned_integral Number>
  requires(!std::same_as<Number, bool>) Json(Number value) : Json(Unsigned{value}) {}
  Json(std::floating_point auto value) : Json(Real{value}) {}
  Json(const char* text) : Json(std::string(text)) {}
  Json(std::string_view text) : Json(std::string(text)) {}
  Json(std::string text);
  template <class Value>
  Json(const std::vector<Value>& values) : Json(array()) {
    append(values);
  }
  template <class Value, std::size_t count>
  Json(const std::array<Value, count>& values) : Json(array()) {
    append(values);
  }
  // An object where each value is a pair of a text and a value, else an array.
  Json(std::initializer_list<Json> values);
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();

  [[nodiscard]] static Json array(std::initializer_list<Json> values = {});
  [[nodiscard]] static Json object();

  [[nodiscard]] bool is_null() const;
  [[nodiscard]] bool is_boolean() const { return as_bool().has_value(); }
  [[nodiscard]] bool is_string() const;
  [[nodiscard]] bool is_array() const;
  [[nodiscard]] bool is_object() const;

  // What it holds; nothing where that is something else.
  [[nodiscard]] std::optional<bool> as_bool() const;
  [[nodiscard]] std::optional<std::uint64_t> as_count() const;
  [[nodiscard]] std::optional<double> as_number() const;  // of any kind
  [[nodiscard]] std::optional<std::string> as_text() const;

  // Of arrays and objects; 0 of others.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] bool empty() const { return size() == 0; }

  // Of arrays. A value that is null becomes one.
  void push_back(Json value);
  [[nodiscard]] const std::vector<Json>& values() const;

  // Of objects, in the order in which keys were added. A value that is null becomes one.
  Json& operator[](std::string_view key);
  // Null: there is no such member, or this is no object.
  [[nodiscard]] const Json* find(std::string_view key) const;
  [[nodiscard]] bool contains(std::string_view key) const { return find(key) != nullptr; }
  void erase(std::string_view key);
  // Adds those of another object, or replaces them.
  void update(const Json& other);
  [[nodiscard]] const std::vector<std::pair<std::string, Json>>& items() const;

  // In one line, or each value in a line of its own, indented by so many spaces. Bytes that are no
  // UTF-8 become replacement characters. `ascii`: all other characters are escaped.
  [[nodiscard]] std::string dump(int indent = -1, bool ascii = false) const;
  // Nothing where the text is no JSON, or is nested deeper than anything that is meant: each level
  // takes some of the stack.
  [[nodiscard]] static std::optional<Json> parse(std::string_view text);

 private:
  struct Boolean {
    bool value;
  };
  struct Signed {
    std::int64_t value;
  };
  struct Unsigned {
    std::uint64_t value;
  };
  struct Real {
    double value;
  };
  explicit Json(Boolean value);
  explicit Json(Signed value);
  explicit Json(Unsigned value);
  explicit Json(Real value);

  template <class Values>
  void append(const Values& values) {
    for (const auto& value : values) push_back(Json(value));
  }

  struct Value;
  std::unique_ptr<Value> value_;  // none: null
  friend struct JsonText;
};

}  // namespace meshrepair
