// The subcommands that the first dataset needs, one file each; program.cpp lists them in one table.
// cli/jobs/processes.h declares those that the program starts for itself, cli/more the others.
#pragma once

namespace CLI {
class App;
}

namespace throng::cli {

// Each function adds its subcommand with a callback that performs it. Callbacks throw InputError,
// EnvironmentError or Cancelled; run_program() turns these into messages and exit codes.
void add_run(CLI::App& app);
void add_check(CLI::App& app);
void add_simulate(CLI::App& app);
void add_study(CLI::App& app);
void add_schema(CLI::App& app);
void add_render(CLI::App& app);
void add_crowd(CLI::App& app);
void add_serve(CLI::App& app);
void add_people(CLI::App& app);
void add_keys(CLI::App& app);
void add_backup(CLI::App& app);  // backup, restore
void add_remote_jobs(
    CLI::App& app);  // submit, jobs, watch, cancel, retry, remove, logs, fetch, drain
void add_remote_studies(CLI::App& app);
void add_scenarios(CLI::App& app);
void add_scenario(CLI::App& app);  // check, plan, make, generate
void add_airframes(CLI::App& app);
void add_metrics(CLI::App& app);
void add_report(CLI::App& app);
void add_export(CLI::App& app);
void add_merge(CLI::App& app);
void add_publish(CLI::App& app);
void add_completion(CLI::App& app);
void add_manual(CLI::App& app);

// Subcommands of `throng people` in files of their own.
void add_people_import(CLI::App& people);
void add_people_sheet(CLI::App& people);

}  // namespace throng::cli
