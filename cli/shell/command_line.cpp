#include "cli/shell/command_line.h"

#include <fmt/core.h>

#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/text/suggest.h"

namespace throng::cli {

namespace {

/// Old names of options, which are kept for one version after 0.1.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kRenamedOptions = {
    {{"--most-jobs", "--max-jobs"},
     {"--most-gib", "--max-gib"},
     {"--least-free", "--min-free"},
     {"--picture", "--plot"}}};

std::string with_new_name(std::string word) {
  for (const auto& [old, now] : kRenamedOptions) {
    if (word != old && !word.starts_with(std::string(old) + "=")) continue;
    fmt::print(stderr, "throng: warning: {} is deprecated, use {}\n", old, now);
    return std::string(now) + word.substr(old.size());
  }
  return word;
}

const CLI::App* command_named(const CLI::App& app, const std::string& name) {
  const auto found =
      app.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

[[noreturn]] void refuse_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command :
       app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); })) {
    names.push_back(command->get_name());
  }
  Problem problem = unknown_name("", "", "command", word,
                                 std::vector<std::string_view>(names.begin(), names.end()));
  // `throng scenario list` is `throng scenarios`.
  const CLI::App* lister = app.get_parent() == nullptr || word != "list"
                               ? nullptr
                               : command_named(*app.get_parent(), app.get_name() + "s");
  if (lister != nullptr) problem.expected = fmt::format("`throng {}`", lister->get_name());
  throw InputError(problem);
}

}  // namespace

CommandLine::CommandLine(int argc, const char* const* argv) {
  for (const char* word : std::span(argv, static_cast<std::size_t>(argc))) {
    words_.push_back(words_.empty() ? word : with_new_name(word));
  }
  for (const std::string& word : words_) pointers_.push_back(word.c_str());
}

std::optional<std::string> help_text(const CLI::App& app, std::span<const std::string> words) {
  if (words.empty() || words.front() != "help") return std::nullopt;
  const CLI::App* asked = &app;
  std::string before = "throng";
  for (const std::string& word : words.subspan(1)) {
    const CLI::App* next = command_named(*asked, word);
    if (next == nullptr) refuse_command(*asked, word);
    if (asked != &app) before += " " + asked->get_name();
    asked = next;
  }
  return asked->help(before);
}

void check_commands(const CLI::App& app, std::span<const std::string> words) {
  const CLI::App* current = &app;
  for (const std::string& word : words) {
    if (current->get_require_subcommand_min() == 0 || word.starts_with('-')) return;
    const CLI::App* next = command_named(*current, word);
    if (next == nullptr) refuse_command(*current, word);
    current = next;
  }
}

}  // namespace throng::cli
