// SPDX-License-Identifier: MIT
// The command line of a program: its arguments and options, and what help says of them. CLI11
// parses it, which command_line.cpp alone knows, as its headers take seconds to compile.
//
//   CommandLine line("Checks a mesh.", "meshcheck");
//   line.add_option("IN", input, "Mesh")->check(names_file(".stl"))->required();
//   line.add_flag("--weld", weld, "Treat equal points as one")->group("Check");
//
// Options belong to their line. What they write to has to outlive it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's
class App;
class Option;
}  // namespace CLI

namespace meshrepair {

// Says why a word of the command line will not do; an empty text where it will.
using WhyNot = std::function<std::string(const std::string& word)>;

// What a value has to be.
struct Check {
  WhyNot why_not;
  std::string about = {};  // for help and completions: ".stl, .obj", "{auto,none}"
};

[[nodiscard]] Check is_one_of(const std::vector<std::string>& words);

class CommandOption {
 public:
  explicit CommandOption(CLI::Option& option) : option_(option) {}

  // What holds for it; each returns the option itself.
  CommandOption* check(const Check& check);
  CommandOption* check(WhyNot why_not) { return check(Check{std::move(why_not)}); }
  CommandOption* type_name(const std::string& type);  // of the value, in help: "N"
  CommandOption* group(const std::string& heading);   // in help; empty: help does not show it
  CommandOption* rare();  // few people need it: only the help of all options shows it
  CommandOption* required();
  CommandOption* repeated();            // an argument that stands for several
  CommandOption* delimiter(char mark);  // between the values of a list
  CommandOption* one_each_time();       // of a list: an option that may be given several times
  CommandOption* default_str(const std::string& text);
  CommandOption* capture_default_str();  // what its variable holds now
  CommandOption* description(const std::string& text);
  CommandOption* needs(const CommandOption* other);
  CommandOption* excludes(const CommandOption* other);
  CommandOption* each(const std::function<void(const std::string&)>& told);

  // How often it was given, and the words that were given.
  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] const std::vector<std::string>& results() const;
  // As if it had been given.
  void add_result(const std::string& word);

  // What it was made with.
  [[nodiscard]] std::string name() const;                    // "--quiet"
  [[nodiscard]] std::vector<std::string> all_names() const;  // "-q", "--quiet"
  [[nodiscard]] bool is_argument() const;                    // without a name on the command line
  [[nodiscard]] bool is_flag() const;                        // has no value
  [[nodiscard]] bool is_required() const;
  [[nodiscard]] bool is_repeated() const;
  [[nodiscard]] std::string type() const;  // and what is checked, with colons between
  [[nodiscard]] std::string heading() const;
  [[nodiscard]] bool is_rare() const { return is_rare_; }
  [[nodiscard]] std::string default_text() const;
  [[nodiscard]] std::string description() const;

 private:
  CLI::Option& option_;
  bool is_rare_ = false;
};

class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& name);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  CommandLine(CommandLine&&) = delete;
  CommandLine& operator=(CommandLine&&) = delete;
  ~CommandLine();

  // An option "--name", "-n,--name", or an argument "NAME", whose value goes into `value`.
  CommandOption* add_option(const std::string& name, std::string& value, const std::string& help);
  CommandOption* add_option(const std::string& name, double& value, const std::string& help);
  CommandOption* add_option(const std::string& name, int& value, const std::string& help);
  CommandOption* add_option(const std::string& name, unsigned& value, const std::string& help);
  // std::size_t and std::uint64_t are among these.
  CommandOption* add_option(const std::string& name, unsigned long& value, const std::string& help);
  CommandOption* add_option(const std::string& name, unsigned long long& value,
                            const std::string& help);
  CommandOption* add_option(const std::string& name, std::vector<std::string>& values,
                            const std::string& help);
  // Whose value `set` is given.
  CommandOption* add_option_function(const std::string& name,
                                     const std::function<void(const std::string&)>& set,
                                     const std::string& help);
  CommandOption* add_flag(const std::string& name, bool& value, const std::string& help);
  CommandOption* add_flag_callback(const std::string& name, const std::function<void()>& set,
                                   const std::string& help);
  // Those end parsing: see parse().
  CommandOption* set_help_flag(const std::string& name, const std::string& help);
  CommandOption* set_help_all_flag(const std::string& name, const std::string& help);
  CommandOption* set_version_flag(const std::string& name, const std::string& help);

  // Called when all options have their values.
  void parse_complete_callback(const std::function<void()>& told);
  void set_footer(const std::string& text);

  // What ended parsing: the end of the line, or one of these flags.
  enum class Parsed { all, help, help_all, version };
  // Throws UsageError, and what the functions of options throw.
  Parsed parse(int argc, const char* const* argv);
  Parsed parse(const std::vector<std::string>& words);

  [[nodiscard]] std::string help() const;      // without rare options
  [[nodiscard]] std::string help_all() const;  // of all options
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::string description() const;
  [[nodiscard]] std::string footer() const;
  // In the order in which they were added.
  [[nodiscard]] std::vector<const CommandOption*> options() const;
  // Null: there is none.
  [[nodiscard]] CommandOption* find(const std::string& name) const;
  // Pre: there is one.
  [[nodiscard]] CommandOption& option(const std::string& name) const;

 private:
  void refuse_removed(const std::vector<std::string>& words) const;
  CommandOption* own(CLI::Option* option);
  template <class Parse>
  Parsed parsed(const Parse& parse);

  std::unique_ptr<CLI::App> app_;
  std::vector<std::unique_ptr<CommandOption>> options_;
};

}  // namespace meshrepair
