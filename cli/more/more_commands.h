// The commands of `throng` that the first dataset does not need, and their work for the service.
#pragma once

#include "cli/program.h"

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
}

namespace throng::cli {

/// Calibration, live flights, checks of datasets and of crowd models, commands in Python.
Extension more_commands();

// Each function adds its subcommand with a callback that performs it, as those of
// cli/shell/commands.h do.
void add_calibrate(CLI::App& app);
void add_live(CLI::App& app);
void add_live_process(CLI::App& app);
void add_match(CLI::App& app);
void add_train(CLI::App& app);
void add_validate(CLI::App& app);
void add_validate_crowd(CLI::App& app);

// The subcommand of `throng calibrate` in a file of its own.
void add_calibrate_selftest(CLI::App& calibrate);

}  // namespace throng::cli
