// SPDX-License-Identifier: MIT
#include "options/command_line.h"

#include <algorithm>
#include <memory>
#include <sstream>
#include <system_error>
#include <utility>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <base/assert.h>
#include <base/decimal.h>
#include <base/error.h>

#include "options/removed_options.h"

namespace meshrepair {
namespace {

// Help in which an option is "--name TYPE", and what it does ends with its default.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(28); }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const std::string help = Formatter::make_help(app, std::move(name), mode);
    return CLI::detail::find_and_replace(help, "\n\n\n", "\n\n");
  }

  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string type = option->get_type_name();  // "TYPE:check"
    if (option->get_positional() || option->get_type_size() == 0 || type.empty()) return {};
    return " " + type.substr(0, type.find(':'));
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string value = option->get_default_str();
    if (value.empty()) return option->get_description();
    return option->get_description() + " (default: " + value + ")";
  }
};

// CLI11 looks for what is missing first: whoever mistypes the only option would be told of IN.
// Among what it did not expect it has the mark before names, too.
std::string message_of(const CLI::App& app, const CLI::ParseError& error) {
  std::vector<std::string> unknown = app.remaining();
  std::erase(unknown, "--");
  return unknown.empty() ? error.what() : CLI::ExtrasError(unknown).what();
}

// CLI11 says "At Most 1 required but received 2".
std::string message_of(const CLI::App& app, const CLI::ArgumentMismatch& error) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_type_size() == 0) continue;  // a flag may be there twice
    if (option->count() > static_cast<std::size_t>(option->get_items_expected_max())) {
      return option->get_name() + ": is given more than once";
    }
  }
  return error.what();
}

bool read_word(const std::string& word, std::string& value) {
  value = word;
  return true;
}

template <class Number>
bool read_word(const std::string& word, Number& value) {
  const char* const end = word.data() + word.size();
  const auto [at, error] = read_decimal(word.data(), end, value);
  return error == std::errc() && at == end;
}

// Not by CLI11's own templates, which take seconds to compile for each kind of value.
template <class Value>
CLI::Option* add_value(CLI::App& app, const std::string& name, Value& value,
                       const std::string& help) {
  const auto take = [&value](const std::vector<std::string>& words) {
    return read_word(words.front(), value);
  };
  const auto default_text = [&value] {
    std::ostringstream text;
    text << value;
    return text.str();
  };
  return app.add_option(name, take, help, false, default_text);
}

}  // namespace

Check is_one_of(const std::vector<std::string>& words) {
  const std::string all = CLI::detail::generate_set(words);
  const auto why_not = [words, all](const std::string& word) {
    const bool is_one = std::find(words.begin(), words.end(), word) != words.end();
    return is_one ? std::string() : word + " not in " + all;
  };
  return {why_not, all};
}

CommandOption* CommandOption::check(const Check& check) {
  option_.check(CLI::Validator(
      [why_not = check.why_not](std::string& word) { return why_not(word); }, check.about));
  return this;
}

CommandOption* CommandOption::type_name(const std::string& type) {
  option_.type_name(type);
  return this;
}

CommandOption* CommandOption::rare() {
  is_rare_ = true;
  return this;
}

CommandOption* CommandOption::group(const std::string& heading) {
  option_.group(heading);
  return this;
}

CommandOption* CommandOption::required() {
  option_.required();
  return this;
}

CommandOption* CommandOption::repeated() {
  option_.expected(-1);
  return this;
}

CommandOption* CommandOption::one_each_time() {
  option_.expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return this;
}

CommandOption* CommandOption::delimiter(char mark) {
  option_.delimiter(mark);
  return this;
}

CommandOption* CommandOption::default_str(const std::string& text) {
  option_.default_str(text);
  return this;
}

CommandOption* CommandOption::capture_default_str() {
  option_.capture_default_str();
  return this;
}

CommandOption* CommandOption::description(const std::string& text) {
  option_.description(text);
  return this;
}

CommandOption* CommandOption::needs(const CommandOption* other) {
  option_.needs(&other->option_);
  return this;
}

CommandOption* CommandOption::excludes(const CommandOption* other) {
  option_.excludes(&other->option_);
  return this;
}

CommandOption* CommandOption::each(const std::function<void(const std::string&)>& told) {
  option_.each(told);
  return this;
}

std::size_t CommandOption::count() const { return option_.count(); }
const std::vector<std::string>& CommandOption::results() const { return option_.results(); }
void CommandOption::add_result(const std::string& word) { option_.add_result(word); }

std::string CommandOption::name() const { return option_.get_name(); }

std::vector<std::string> CommandOption::all_names() const {
  if (is_argument()) return {option_.get_name(true)};
  std::vector<std::string> names;
  for (const std::string& name : option_.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option_.get_lnames()) names.push_back("--" + name);
  return names;
}

bool CommandOption::is_argument() const { return option_.get_positional(); }
bool CommandOption::is_flag() const { return option_.get_items_expected_max() == 0; }
bool CommandOption::is_required() const { return option_.get_required(); }

bool CommandOption::is_repeated() const {
  return is_argument() && option_.get_items_expected_max() > 1;
}

std::string CommandOption::type() const {
  return option_.get_type_size() == 0 ? std::string() : option_.get_type_name();
}

std::string CommandOption::heading() const { return option_.get_group(); }
std::string CommandOption::default_text() const { return option_.get_default_str(); }
std::string CommandOption::description() const { return option_.get_description(); }

CommandLine::CommandLine(const std::string& description, const std::string& name)
    : app_(std::make_unique<CLI::App>(description, name)) {
  app_->formatter(std::make_shared<HelpFormatter>());
  app_->set_help_flag();
  app_->allow_windows_style_options(false);  // a path may begin with a slash there, too
}

CommandLine::~CommandLine() = default;

CommandOption* CommandLine::own(CLI::Option* option) {
  options_.push_back(std::make_unique<CommandOption>(*option));
  return options_.back().get();
}

CommandOption* CommandLine::add_option(const std::string& name, std::string& value,
                                       const std::string& help) {
  return own(add_value(*app_, name, value, help)->type_name("TEXT"));
}

CommandOption* CommandLine::add_option(const std::string& name, double& value,
                                       const std::string& help) {
  return own(add_value(*app_, name, value, help)->type_name("FLOAT"));
}

CommandOption* CommandLine::add_option(const std::string& name, int& value,
                                       const std::string& help) {
  return own(add_value(*app_, name, value, help)->type_name("INT"));
}

CommandOption* CommandLine::add_option(const std::string& name, unsigned& value,
                                       const std::string& help) {
  return own(add_value(*app_, name, value, help)->type_name("UINT"));
}

CommandOption* CommandLine::add_option(const std::string& name, unsigned long& value,
                                       const std::string& help) {
  return own(add_value(*app_, name, value, help)->type_name("UINT"));
}

CommandOption* CommandLine::add_option(const std::string& name, unsigned long long& value,
                                       const std::string& help) {
  return own(add_value(*app_, name, value, help)->type_name("UINT"));
}

CommandOption* CommandLine::add_option(const std::string& name, std::vector<std::string>& values,
                                       const std::string& help) {
  const auto take = [&values](const std::vector<std::string>& words) {
    values = words;
    return true;
  };
  return own(app_->add_option(name, take, help)
                 ->type_name("TEXT")
                 ->expected(CLI::detail::expected_max_vector_size));
}

CommandOption* CommandLine::add_option_function(const std::string& name,
                                                const std::function<void(const std::string&)>& set,
                                                const std::string& help) {
  const auto take = [set](const std::vector<std::string>& words) {
    set(words.front());
    return true;
  };
  return own(app_->add_option(name, take, help)->type_name("TEXT"));
}

CommandOption* CommandLine::add_flag(const std::string& name, bool& value,
                                     const std::string& help) {
  return add_flag_callback(
      name, [&value] { value = true; }, help);
}

CommandOption* CommandLine::add_flag_callback(const std::string& name,
                                              const std::function<void()>& set,
                                              const std::string& help) {
  return own(app_->add_flag_callback(name, set, help));
}

CommandOption* CommandLine::set_help_flag(const std::string& name, const std::string& help) {
  return own(app_->set_help_flag(name, help));
}

CommandOption* CommandLine::set_help_all_flag(const std::string& name, const std::string& help) {
  return own(app_->set_help_all_flag(name, help));
}

CommandOption* CommandLine::set_version_flag(const std::string& name, const std::string& help) {
  return own(app_->set_version_flag(name, this->name())->description(help));
}

void CommandLine::parse_complete_callback(const std::function<void()>& told) {
  app_->parse_complete_callback(told);
}

void CommandLine::set_footer(const std::string& text) { app_->footer(text); }

template <class Parse>
CommandLine::Parsed CommandLine::parsed(const Parse& parse) {
  try {
    parse();
    return Parsed::all;
  } catch (const CLI::CallForHelp&) {
    return Parsed::help;
  } catch (const CLI::CallForAllHelp&) {
    return Parsed::help_all;
  } catch (const CLI::CallForVersion&) {
    return Parsed::version;
  } catch (const CLI::RequiredError& error) {
    throw UsageError(message_of(*app_, error));
  } catch (const CLI::ExtrasError& error) {
    throw UsageError(message_of(*app_, error));
  } catch (const CLI::ArgumentMismatch& error) {
    throw UsageError(message_of(*app_, error));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
}

// Before CLI11 says that it did not expect them.
void CommandLine::refuse_removed(const std::vector<std::string>& words) const {
  for (const std::string& word : words) {
    if (word == "--") return;
    const std::string name = word.substr(0, word.find('='));
    const std::string why = why_removed(*this, name, Spelling::command_line);
    if (!why.empty()) throw UsageError(std::string(name).append(": ").append(why));
  }
}

CommandLine::Parsed CommandLine::parse(int argc, const char* const* argv) {
  return parse(std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
}

CommandLine::Parsed CommandLine::parse(const std::vector<std::string>& words) {
  refuse_removed(words);
  // CLI11 takes them from the end.
  return parsed([&] { app_->parse(std::vector<std::string>(words.rbegin(), words.rend())); });
}

std::string CommandLine::help() const {
  std::vector<std::pair<CLI::Option*, std::string>> hidden;
  for (CLI::Option* const option : app_->get_options()) {
    const CommandOption* const known = find(option->get_name());
    if (known == nullptr || !known->is_rare()) continue;
    hidden.emplace_back(option, option->get_group());
    option->group("");
  }
  std::string text = app_->help();
  for (const auto& [option, heading] : hidden) option->group(heading);
  return text;
}

std::string CommandLine::help_all() const { return app_->help(); }
std::string CommandLine::name() const { return app_->get_name(); }
std::string CommandLine::description() const { return app_->get_description(); }
std::string CommandLine::footer() const { return app_->get_footer(); }

std::vector<const CommandOption*> CommandLine::options() const {
  std::vector<const CommandOption*> all;
  all.reserve(options_.size());
  for (const auto& option : options_) all.push_back(option.get());
  return all;
}

CommandOption* CommandLine::find(const std::string& name) const {
  const CLI::Option* const wanted = app_->get_option_no_throw(name);
  if (wanted == nullptr) return nullptr;
  const auto found = std::find_if(options_.begin(), options_.end(), [&](const auto& option) {
    return option->name() == wanted->get_name();
  });
  return found == options_.end() ? nullptr : found->get();
}

CommandOption& CommandLine::option(const std::string& name) const {
  CommandOption* const found = find(name);
  MESHREPAIR_ASSERT(found != nullptr);
  return *found;
}

}  // namespace meshrepair
