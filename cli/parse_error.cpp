#include "cli/parse_error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <regex>
#include <string_view>
#include <vector>

#include "base/suggest.h"

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
  }
  return names;
}

Problem unexpected(const NamedCommand& command, const std::string& word) {
  if (!word.starts_with('-')) {
    return {command.name, "", fmt::format("one more argument, \"{}\"", word),
            fmt::format("what `{} --help` lists", command.name)};
  }
  const std::vector<std::string> known = option_names(*command.app);
  const std::string name = word.substr(0, word.find('='));
  Problem problem = unknown_name(command.name, "", "option", name,
                                 std::vector<std::string_view>(known.begin(), known.end()));
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

Problem parse_problem(const CLI::App& app, const CLI::ParseError& error) {
  const NamedCommand command = command_given(app);
  if (const auto extra = app.remaining(true); !extra.empty()) {
    return unexpected(command, extra.front());
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
    return {command.name, found[1], found[2],
            is_open ? fmt::format("a number of at least {}", plain(found[3]))
                    : fmt::format("{} to {}", plain(found[3]), plain(found[4]))};
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
