#include "cli/shell/parse_error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <regex>
#include <string_view>
#include <vector>

#include "base/text/suggest.h"

namespace throng::cli {

namespace {

/// The command that the words named, and its name: "throng scenario check".
struct NamedCommand {
  const CLI::App* app;
  std::string name;
};

NamedCommand command_given(const CLI::App& app) {
  NamedCommand given{&app, "throng"};
  while (true) {
    const std::vector<CLI::App*> next = given.app->get_subcommands();
    if (next.empty()) return given;
    given = {next.front(), given.name + " " + next.front()->get_name()};
  }
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// The long option that "--out" or "-out" begins, if there is one alone.
std::optional<std::string> longer_option(std::span<const std::string> known,
                                         const std::string& word) {
  const std::size_t dashes = word.find_first_not_of('-');
  constexpr std::size_t kShortest = 2;
  if (dashes == std::string::npos || word.size() - dashes < kShortest) return std::nullopt;
  const std::string start = "--" + word.substr(dashes);
  std::optional<std::string> found;
  for (const std::string& name : known) {
    if (!name.starts_with(start)) continue;
    if (found) return std::nullopt;
    found = name;
  }
  return found;
}

/// A word such as "-out", which is read as the option -o with the value "ut".
std::optional<std::string> option_with_one_dash(std::span<const std::string> known,
                                                std::span<const std::string> words) {
  for (const std::string& word : words) {
    if (!word.starts_with('-') || word.starts_with("--")) continue;
    if (longer_option(known, word)) return word;
  }
  return std::nullopt;
}

Problem unexpected(const NamedCommand& command, std::string word,
                   std::span<const std::string> words) {
  const std::vector<std::string> known = option_names(*command.app);
  if (const auto option = option_with_one_dash(known, words)) word = *option;
  if (!word.starts_with('-')) {
    return {command.name, "", fmt::format("one more argument, \"{}\"", word),
            fmt::format("what `{} --help` lists", command.name)};
  }
  const std::string name = word.substr(0, word.find('='));
  if (std::find(known.begin(), known.end(), name) != known.end()) {
    return {command.name, "", fmt::format("{} before the command", name),
            fmt::format("{} behind `{}`", name, command.name)};
  }
  Problem problem = unknown_name(command.name, "", "option", name,
                                 std::vector<std::string_view>(known.begin(), known.end()));
  if (const auto longer = longer_option(known, name)) problem.expected = '"' + *longer + '"';
  return problem;
}

/// "6.000000" as "6".
std::string plain(const std::string& number) {
  if (!std::regex_match(number, std::regex(R"(-?\d+\.\d+)"))) return number;
  return fmt::format("{:g}", std::stod(number));
}

/// CLI11 prints double's max for a range without one.
constexpr double kOpen = 1e308;

}  // namespace

Problem parse_problem(const CLI::App& app, const CLI::ParseError& error,
                      std::span<const std::string> words) {
  const NamedCommand command = command_given(app);
  if (const auto extra = app.remaining(true); !extra.empty()) {
    return unexpected(command, extra.front(), words);
  }
  const std::string text = error.what();
  if (text == "A subcommand is required") {
    std::string names;
    for (const CLI::App* next : command.app->get_subcommands(
             [](const CLI::App* one) { return !one->get_group().empty(); })) {
      names += (names.empty() ? "" : ", ") + next->get_name();
    }
    return {command.name, "", "no command", "one of: " + names};
  }
  std::smatch found;
  const auto is_like = [&](const char* form) {
    return std::regex_match(text, found, std::regex(form));
  };
  if (is_like(R"((--?)?(\S+) is required)")) {
    const bool is_option = found[1].matched;
    const std::string name = is_option ? found[1].str() + found[2].str() : upper(found[2]);
    return {command.name, "", fmt::format("missing {} (`{} --help`)", name, command.name), ""};
  }
  if (is_like(R"((\S+): Value (.*) not in range (\S+) to (\S+))")) {
    const bool is_open = std::strtod(found[4].str().c_str(), nullptr) >= kOpen;
    // CLI11 prints the smallest positive number as 0, which is refused then.
    const bool is_above = std::strtod(found[2].str().c_str(), nullptr) == 0;
    return {command.name, found[1], found[2],
            !is_open   ? fmt::format("{} to {}", plain(found[3]), plain(found[4]))
            : is_above ? "a number above 0"
                       : fmt::format("a number of at least {}", plain(found[3]))};
  }
  if (is_like(R"((\S+): Number less or equal to 0: (.*))")) {
    return {command.name, found[1], found[2], "a number above 0"};
  }
  if (is_like(R"((\S+): Number less than 0: (.*))")) {
    return {command.name, found[1], found[2], "a number of at least 0"};
  }
  if (is_like(R"((\S+): (?:Check )?(.*) not in \{(.*)\})")) {
    return {command.name, found[1], found[2], "one of: " + found[3].str()};
  }
  if (is_like(R"(Could not convert: (\S+) = (.*))")) {
    return {command.name, found[1], '"' + found[2].str() + '"', "a number"};
  }
  if (is_like(R"((\S+): \d+ required .* missing)")) {
    return {command.name, "",
            fmt::format("missing value of {} (`{} --help`)", found[1].str(), command.name), ""};
  }
  return {command.name, "", text, ""};
}

}  // namespace throng::cli
