// The subcommand of `throng scenario` that is a program of its own.
#pragma once

namespace CLI {
class App;
}

namespace throng::cli {

void add_scenario_import(CLI::App& scenario);

}  // namespace throng::cli
