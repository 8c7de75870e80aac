// throng completion and throng manual: shell completion and the manual page, made of the commands
// and options themselves.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/version.h"
#include "cli/commands.h"

namespace throng::cli {

namespace {

/// Commands that users start; workers are started by the service.
bool is_for_users(const CLI::App& command) { return !command.get_group().empty(); }

std::vector<const CLI::App*> subcommands(const CLI::App& command) {
  std::vector<const CLI::App*> found;
  for (const CLI::App* next : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (is_for_users(*next)) found.push_back(next);
  }
  return found;
}

/// Calls visit(command, its name) for a command and all below it.
void for_each_command(const CLI::App& command, const std::string& name,
                      const std::function<void(const CLI::App&, const std::string&)>& visit) {
  visit(command, name);
  for (const CLI::App* next : subcommands(command)) {
    for_each_command(*next, name + " " + next->get_name(), visit);
  }
}

/// Words that may follow a command: subcommands and long options.
std::string words_after(const CLI::App& command) {
  std::string words;
  const auto add = [&](const std::string& word) { words += (words.empty() ? "" : " ") + word; };
  for (const CLI::App* next : subcommands(command)) add(next->get_name());
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) add("--" + name);
  }
  return words;
}

/// The command is that of the words before the one to complete, up to the first that is none.
std::string bash_completion(const CLI::App& app) {
  std::string cases;
  for_each_command(app, "throng", [&](const CLI::App& command, const std::string& name) {
    cases += fmt::format("    \"{}\") words=\"{}\" ;;\n", name, words_after(command));
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

/// Text for roff: backslashes, and hyphens and dots where they have a meaning.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      if (out.empty() && (c == '.' || c == '\'')) out += "\\&";
      out += c;
    }
  }
  return out;
}

std::string option_lines(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty() || option->check_name("--help")) continue;
    const std::string name =
        option->get_positional() ? option->get_name(true) : option->get_name(false, true);
    text += fmt::format(".TP\n.B {}\n{}\n", roff(name), roff(option->get_description()));
  }
  return text;
}

std::string manual_page(const CLI::App& app) {
  std::string text = fmt::format(
      ".TH THRONG 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\nthrong \\- {}\n.SH SYNOPSIS\n.B "
      "throng\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH COMMANDS\n",
      kGenerator, roff(app.get_description()));
  for_each_command(app, "throng", [&](const CLI::App& command, const std::string& name) {
    if (&command == &app) return;
    text += fmt::format(".SS {}\n{}\n{}", roff(name), roff(command.get_description()),
                        option_lines(command));
  });
  return text + fmt::format(".SH EXIT STATUS\n{}\n.SH SEE ALSO\n/usr/share/doc/throng\n",
                            roff(app.get_footer()));
}

}  // namespace

void add_manual(CLI::App& app) {
  auto* completion = app.add_subcommand("completion", "Print shell completion for bash");
  const auto shell = std::make_shared<std::string>("bash");
  completion->add_option("shell", *shell, "bash")->check(CLI::IsMember({"bash"}));
  completion->footer("Use: source <(throng completion bash). The Debian package installs it.");
  // The callback owns the word that the option writes.
  completion->callback([&app, shell] { fmt::print("{}", bash_completion(app)); });
  app.add_subcommand("manual", "Print the manual page (roff; throng manual | man -l -)")
      ->callback([&app] { fmt::print("{}", manual_page(app)); });
}

}  // namespace throng::cli
