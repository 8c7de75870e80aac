// throng completion: scripts for bash, zsh and fish, made of the commands and options themselves.
// Each script finds the command that the words before the cursor name, up to the first word that is
// none, and offers what may follow it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/shell/command_tree.h"
#include "cli/shell/commands.h"

namespace throng::cli {

namespace {

/// A subcommand or a long option ("--output"), and what it is for.
struct Candidate {
  std::string word;
  std::string description;
};

std::vector<Candidate> candidates_after(const CLI::App& command) {
  std::vector<Candidate> found;
  for (const CLI::App* next : user_subcommands(command)) {
    found.push_back({next->get_name(), next->get_description()});
  }
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      found.push_back({"--" + name, option->get_description()});
    }
  }
  return found;
}

std::string replaced(std::string_view text, char wanted, std::string_view with) {
  std::string out;
  for (const char c : text) {
    if (c == wanted) {
      out += with;
    } else {
      out += c;
    }
  }
  return out;
}

std::string bash_completion(const CLI::App& app) {
  std::string cases;
  for_each_command(app, "throng", [&](const CLI::App& command, const std::string& words) {
    std::string following;
    for (const Candidate& candidate : candidates_after(command)) {
      following += (following.empty() ? "" : " ") + candidate.word;
    }
    cases += fmt::format("    \"{}\") words=\"{}\" ;;\n", words, following);
  });
  return R"(# Completion of throng for bash; made by `throng completion bash`.
_throng_words() {
  case "$1" in
)" + cases +
         R"(    *) return 1 ;;
  esac
}

_throng() {
  local words command="throng" word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    _throng_words "$command $word" || break
    command="$command $word"
  done
  _throng_words "$command"
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "${COMP_WORDS[COMP_CWORD]}")
}

complete -o default -F _throng throng
)";
}

/// Text within single quotes of zsh.
std::string zsh_quoted(std::string_view text) {
  return "'" + replaced(text, '\'', R"('\'')") + "'";
}

std::string zsh_completion(const CLI::App& app) {
  std::string cases;
  for_each_command(app, "throng", [&](const CLI::App& command, const std::string& words) {
    std::string following;
    for (const Candidate& candidate : candidates_after(command)) {
      following += "\n      " +
                   zsh_quoted(candidate.word + ":" + replaced(candidate.description, ':', "\\:"));
    }
    cases += fmt::format("    '{}') candidates=({}\n    ) ;;\n", words, following);
  });
  return R"(#compdef throng
# Completion of throng for zsh; made by `throng completion zsh`.
_throng_candidates() {
  case "$1" in
)" + cases +
         R"(    *) return 1 ;;
  esac
}

_throng() {
  local command="throng" word
  local -a candidates
  for word in "${(@)words[2,CURRENT-1]}"; do
    _throng_candidates "$command $word" || break
    command="$command $word"
  done
  _throng_candidates "$command"
  _describe -o throng candidates
  _files
}

# Run by the completion system where it lies in a folder of fpath, else read by `source`.
if [ "${funcstack[1]}" = _throng ]; then _throng "$@"; else compdef _throng throng; fi
)";
}

/// Text within single quotes of fish.
std::string fish_quoted(std::string_view text) {
  return "'" + replaced(replaced(text, '\\', "\\\\"), '\'', "\\'") + "'";
}

std::string fish_completion(const CLI::App& app) {
  std::string commands;
  std::string lines;
  for_each_command(app, "throng", [&](const CLI::App& command, const std::string& words) {
    commands += " " + fish_quoted(words);
    for (const Candidate& candidate : candidates_after(command)) {
      const bool is_option = candidate.word.starts_with("--");
      lines += fmt::format("complete -c throng -n {} {} {} -d {}\n",
                           fish_quoted("test (__throng_command) = \"" + words + "\""),
                           is_option ? "-l" : "-f -a",
                           fish_quoted(is_option ? candidate.word.substr(2) : candidate.word),
                           fish_quoted(candidate.description));
    }
  });
  return R"(# Completion of throng for fish; made by `throng completion fish`.
function __throng_command
    set -l command throng
    for word in (commandline -opc)[2..-1]
        contains -- "$command $word")" +
         commands + R"(
        or break
        set command "$command $word"
    end
    echo $command
end

)" + lines;
}

}  // namespace

void add_completion(CLI::App& app) {
  auto* completion =
      app.add_subcommand("completion", "Print shell completion for bash, zsh or fish");
  const auto shell = std::make_shared<std::string>("bash");
  completion->add_option("shell", *shell, "bash (default), zsh or fish")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  completion->footer(
      "Use: source <(throng completion bash), source <(throng completion zsh), throng completion "
      "fish | source. The "
      "Debian package installs them.");
  // The callback owns the word that the option writes.
  completion->callback([&app, shell] {
    fmt::print("{}", *shell == "zsh"    ? zsh_completion(app)
                     : *shell == "fish" ? fish_completion(app)
                                        : bash_completion(app));
  });
}

}  // namespace throng::cli
