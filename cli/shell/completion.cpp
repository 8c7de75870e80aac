// throng completion: scripts for bash, zsh and fish, made of the commands and options themselves.
// Each script finds the command that the words before the cursor name, up to the first word that is
// none, and offers what may follow it: subcommands, options, and the values of an option.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
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

/// Values that the program lists when the user asks for them.
struct ListedValues {
  std::string_view command;
  std::string_view option;  ///< long name, or empty for the positional argument
  std::string_view lister;  ///< a command that prints a value in the first column of each line
};

constexpr std::array<ListedValues, 5> kListedValues = {{
    {"throng export", "formats", "throng export --list"},
    {"throng scenario check", "", "throng scenarios"},
    {"throng scenario plan", "", "throng scenarios"},
    {"throng airframes", "", "throng airframes | tail -n +2"},
    {"throng schema", "", "throng schema"},
}};

/// A command that prints the values of an option, a value per line, in any of the shells; empty if
/// the values are no known words.
std::string value_lister(const std::string& words, const CLI::Option& option) {
  for (const ListedValues& listed : kListedValues) {
    const bool is_it = option.get_positional() ? listed.option.empty()
                                               : option.check_lname(std::string(listed.option));
    if (listed.command == words && is_it) return fmt::format("{} | cut -d' ' -f1", listed.lister);
  }
  // An option with a list of words has a type such as TEXT:{local,slurm}.
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  if (begin == std::string::npos) return "";
  std::string list = type.substr(begin + 1, type.find('}') - begin - 1);
  std::replace(list.begin(), list.end(), ',', ' ');
  return "printf '%s\\n' " + list;
}

/// The names of an option as they are typed ("-m", "--models"); none for a positional argument.
std::vector<std::string> typed_names(const CLI::Option& option) {
  std::vector<std::string> names;
  names.reserve(option.get_snames().size() + option.get_lnames().size());
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// A function of bash and zsh that prints the values of the option $2 of the command $1, or of the
/// command's positional argument if $2 is empty; it fails if they are no known words.
std::string values_function(const CLI::App& app) {
  std::string cases;
  for_each_command(app, "throng", [&](const CLI::App& command, const std::string& words) {
    for (const CLI::Option* option : command.get_options()) {
      const std::string lister = value_lister(words, *option);
      if (lister.empty()) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : typed_names(*option)) {
        patterns.push_back(fmt::format("\"{} {}\"", words, name));
      }
      if (patterns.empty()) patterns.push_back(fmt::format("\"{} \"", words));
      cases += fmt::format("    {}) {} ;;\n", fmt::join(patterns, " | "), lister);
    }
  });
  return "_throng_values() {\n  case \"$1 $2\" in\n" + cases + "    *) return 1 ;;\n  esac\n}\n";
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
  return R"sh(# Completion of throng for bash; made by `throng completion bash`.
_throng_words() {
  case "$1" in
)sh" + cases +
         R"sh(    *) return 1 ;;
  esac
}

)sh" + values_function(app) +
         R"sh(
_throng() {
  local words command="throng" word before=""
  local last="${COMP_WORDS[COMP_CWORD]}" previous="${COMP_WORDS[COMP_CWORD-1]}"
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    _throng_words "$command $word" || break
    command="$command $word"
  done
  [ "$previous" != "=" ] || previous="${COMP_WORDS[COMP_CWORD-2]}"  # --option=value
  [ "$last" != "=" ] || last=""
  if [[ "$previous" == -* ]] && words="$(_throng_values "$command" "$previous" 2>/dev/null)"; then
    [[ "$last" != *,* ]] || before="${last%,*},"  # of a list, the last value
  else
    _throng_words "$command"
    [[ "$last" == -* ]] || words+=" $(_throng_values "$command" "" 2>/dev/null)"
  fi
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$words" -- "${last#"$before"}")
}

complete -o default -F _throng throng
)sh";
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
  return R"sh(#compdef throng
# Completion of throng for zsh; made by `throng completion zsh`.
_throng_candidates() {
  case "$1" in
)sh" + cases +
         R"sh(    *) return 1 ;;
  esac
}

)sh" + values_function(app) +
         R"sh(
_throng() {
  local command="throng" word values previous="${words[CURRENT-1]}"
  local -a candidates
  for word in "${(@)words[2,CURRENT-1]}"; do
    _throng_candidates "$command $word" || break
    command="$command $word"
  done
  if [[ "$previous" == -* ]] && values="$(_throng_values "$command" "$previous" 2>/dev/null)"; then
    compset -P '*,'  # of a list, the last value
    compadd -- ${(f)values}
    return
  fi
  _throng_candidates "$command"
  candidates+=(${(f)"$(_throng_values "$command" "" 2>/dev/null)"})
  _describe -o throng candidates
  _files
}

# Run by the completion system where it lies in a folder of fpath, else read by `source`.
if [ "${funcstack[1]}" = _throng ]; then _throng "$@"; else compdef _throng throng; fi
)sh";
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
    for (const CLI::Option* option : command.get_options()) {
      const std::string lister = value_lister(words, *option);
      if (lister.empty()) continue;
      std::string names;
      for (const std::string& name : option->get_snames()) names += " -s " + name;
      for (const std::string& name : option->get_lnames()) names += " -l " + name;
      const bool is_list = option->get_delimiter() == ',';
      lines += fmt::format(
          "complete -c throng -n {}{}{} -a {}\n",
          fish_quoted("test (__throng_command) = \"" + words + "\""), names,
          names.empty() ? "" : " -x",
          fish_quoted(is_list ? "(__fish_append , (" + lister + "))" : "(" + lister + ")"));
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
