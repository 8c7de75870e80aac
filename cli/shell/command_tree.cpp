#include "cli/shell/command_tree.h"

namespace throng::cli {

std::vector<const CLI::App*> user_subcommands(const CLI::App& command) {
  std::vector<const CLI::App*> found;
  for (const CLI::App* next : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (!next->get_group().empty()) found.push_back(next);
  }
  return found;
}

void for_each_command(const CLI::App& command, const std::string& words,
                      const std::function<void(const CLI::App&, const std::string&)>& visit) {
  visit(command, words);
  for (const CLI::App* next : user_subcommands(command)) {
    for_each_command(*next, words + " " + next->get_name(), visit);
  }
}

}  // namespace throng::cli
