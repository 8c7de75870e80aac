// `throng scenario import`, the subcommand that is a program of its own (cli/import).
#pragma once

namespace CLI {
class App;
}

namespace throng::cli {

void add_scenario_import(CLI::App& scenario);

}  // namespace throng::cli
