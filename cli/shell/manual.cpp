// throng manual: the manual page, made of the commands and options themselves.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <string>

#include "base/version.h"
#include "cli/shell/command_tree.h"
#include "cli/shell/commands.h"

namespace throng::cli {

namespace {

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
    // Without default values: some are folders of this machine.
    const std::string type = option->get_type_name();
    text +=
        fmt::format(".TP\n\\fB{}\\fR{}{}{}\n{}\n", roff(name), type.empty() ? "" : " ", roff(type),
                    option->get_required() ? " REQUIRED" : "", roff(option->get_description()));
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
  app.add_subcommand("manual", "Print the manual page (roff; throng manual | man -l -)")
      ->callback([&app] { fmt::print("{}", manual_page(app)); });
}

}  // namespace throng::cli
