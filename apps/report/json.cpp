// SPDX-License-Identifier: MIT
#include "report/json.h"

#include <algorithm>
#include <variant>

#include <nlohmann/json.hpp>

#include <base/assert.h>

namespace meshrepair {

namespace {

constexpr std::size_t kDeepest = 1000;

// Of arrays and objects in each other.
bool is_too_deep(std::string_view text) {
  std::size_t depth = 0;
  bool is_inside_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_inside_string = !is_inside_string;
    if (is_inside_string) {
      if (c == '\\') ++i;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepest) return true;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return false;
}

}  // namespace

using Array = std::vector<Json>;
using Object = std::vector<std::pair<std::string, Json>>;

struct Json::Value {
  std::variant<bool, std::int64_t, std::uint64_t, double, std::string, Array, Object> value;

  template <class Kind>
  explicit Value(Kind kind) : value(std::move(kind)) {}
};

// Between values and the library that writes and reads them.
struct JsonText {
  using Text = nlohmann::ordered_json;

  struct ToText {
    Text operator()(const Array& array) const {
      Text text = Text::array();
      for (const Json& value : array) text.push_back(to_text(value));
      return text;
    }
    Text operator()(const Object& object) const {
      Text text = Text::object();
      for (const auto& [key, value] : object) text.emplace(key, to_text(value));
      return text;
    }
    template <class Plain>
    Text operator()(const Plain& value) const {
      return value;
    }
  };
  static Text to_text(const Json& json) {
    return json.is_null() ? Text() : std::visit(ToText(), json.value_->value);
  }

  // What it holds, if it is that.
  template <class Kind>
  static Kind* held(const Json& json) {
    return json.is_null() ? nullptr : std::get_if<Kind>(&json.value_->value);
  }
  template <class Kind>
  static std::optional<Kind> copied(const Json& json) {
    const Kind* const value = held<Kind>(json);
    return value == nullptr ? std::nullopt : std::optional(*value);
  }
  template <class Kind>
  static Kind& required(const Json& json) {
    Kind* const value = held<Kind>(json);
    MESHREPAIR_ASSERT(value != nullptr);
    return *value;
  }

  static Json from_text(const Text& text) {
    switch (text.type()) {
      case Text::value_t::boolean:
        return text.get<bool>();
      case Text::value_t::number_integer:
        return text.get<std::int64_t>();
      case Text::value_t::number_unsigned:
        return text.get<std::uint64_t>();
      case Text::value_t::number_float:
        return text.get<double>();
      case Text::value_t::string:
        return text.get<std::string>();
      case Text::value_t::array: {
        Json json = Json::array();
        for (const Text& value : text) json.push_back(from_text(value));
        return json;
      }
      case Text::value_t::object: {
        Json json = Json::object();
        for (const auto& [key, value] : text.items()) json[key] = from_text(value);
        return json;
      }
      default:
        return nullptr;
    }
  }
};

Json::Json() = default;
Json::~Json() = default;
Json::Json(Boolean value) : value_(std::make_unique<Value>(value.value)) {}
Json::Json(Signed value) : value_(std::make_unique<Value>(value.value)) {}
Json::Json(Unsigned value) : value_(std::make_unique<Value>(value.value)) {}
Json::Json(Real value) : value_(std::make_unique<Value>(value.value)) {}
Json::Json(std::string text) : value_(std::make_unique<Value>(std::move(text))) {}
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(Json&& other) noexcept = default;

Json::Json(const Json& other)
    : value_(other.is_null() ? nullptr : std::make_unique<Value>(*other.value_)) {}

Json& Json::operator=(const Json& other) { return *this = Json(other); }

Json::Json(std::initializer_list<Json> values) {
  const bool is_object = std::all_of(values.begin(), values.end(), [](const Json& value) {
    return value.is_array() && value.size() == 2 && value.values()[0].is_string();
  });
  if (!is_object) {
    value_ = std::make_unique<Value>(Array(values));
    return;
  }
  value_ = std::make_unique<Value>(Object());
  for (const Json& value : values) (*this)[*value.values()[0].as_text()] = value.values()[1];
}

Json Json::array(std::initializer_list<Json> values) {
  Json json;
  json.value_ = std::make_unique<Value>(Array(values));
  return json;
}

Json Json::object() {
  Json json;
  json.value_ = std::make_unique<Value>(Object());
  return json;
}

bool Json::is_null() const { return value_ == nullptr; }
bool Json::is_string() const { return JsonText::held<std::string>(*this) != nullptr; }
bool Json::is_array() const { return JsonText::held<Array>(*this) != nullptr; }
bool Json::is_object() const { return JsonText::held<Object>(*this) != nullptr; }

std::optional<bool> Json::as_bool() const { return JsonText::copied<bool>(*this); }
std::optional<std::uint64_t> Json::as_count() const {
  return JsonText::copied<std::uint64_t>(*this);
}
std::optional<double> Json::as_number() const {
  if (const auto count = as_count()) return static_cast<double>(*count);
  if (const auto whole = JsonText::copied<std::int64_t>(*this)) return static_cast<double>(*whole);
  return JsonText::copied<double>(*this);
}
std::optional<std::string> Json::as_text() const { return JsonText::copied<std::string>(*this); }

std::size_t Json::size() const {
  if (is_array()) return values().size();
  return is_object() ? items().size() : 0;
}

void Json::push_back(Json value) {
  if (is_null()) value_ = std::make_unique<Value>(Array());
  JsonText::required<Array>(*this).push_back(std::move(value));
}

const std::vector<Json>& Json::values() const { return JsonText::required<Array>(*this); }

Json& Json::operator[](std::string_view key) {
  if (is_null()) value_ = std::make_unique<Value>(Object());
  auto& object = JsonText::required<Object>(*this);
  const auto found = std::find_if(object.begin(), object.end(),
                                  [&](const auto& member) { return member.first == key; });
  if (found != object.end()) return found->second;
  return object.emplace_back(std::string(key), Json()).second;
}

const Json* Json::find(std::string_view key) const {
  if (!is_object()) return nullptr;
  for (const auto& member : items()) {
    if (member.first == key) return &member.second;
  }
  return nullptr;
}

void Json::erase(std::string_view key) {
  std::erase_if(JsonText::required<Object>(*this),
                [&](const auto& member) { return member.first == key; });
}

void Json::update(const Json& other) {
  for (const auto& [key, value] : other.items()) (*this)[key] = value;
}

const std::vector<std::pair<std::string, Json>>& Json::items() const {
  return JsonText::required<Object>(*this);
}

std::string Json::dump(int indent, bool ascii) const {
  return JsonText::to_text(*this).dump(indent, ' ', ascii,
                                       JsonText::Text::error_handler_t::replace);
}

std::optional<Json> Json::parse(std::string_view text) {
  if (is_too_deep(text)) return std::nullopt;
  const auto parsed = JsonText::Text::parse(text, nullptr, false);
  if (parsed.is_discarded()) return std::nullopt;
  return JsonText::from_text(parsed);
}

}  // namespace meshrepair
