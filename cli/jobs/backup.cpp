// throng backup, throng restore: copies of a service's data folder.
#include "server/backup/backup.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/shell/commands.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"

namespace throng::cli {

namespace {

/// Calls `work` with a bar and Ctrl-C; files are for their owner only.
template <typename Work>
server::BackupSize with_bar(const char* title, const Work& work) {
  constexpr mode_t kNotForOthers = 0077;
  ::umask(kNotForOthers);
  const Interrupt interrupt;
  ProgressBar bar(title);
  const server::OnBackupBytes show = [&](std::int64_t done_bytes, std::int64_t total_bytes) {
    bar.show(static_cast<double>(done_bytes) / static_cast<double>(total_bytes),
             format_megabytes(done_bytes, total_bytes));
  };
  return work(show, interrupt.token());
}

}  // namespace

void add_backup(CLI::App& app) {
  const auto options = std::make_shared<server::BackupOptions>();
  auto* backup = app.add_subcommand(
      "backup", "Copy the data folder of a service, which may run, to a new folder");
  backup->add_option("data", options->data, "Data folder of the service")->required();
  backup->add_option("-o,--output", options->output, "Folder to be made")->required();
  backup->add_option("--database", options->database,
                     "The service's --database (default: the data folder)");
  backup->add_flag(
      "!--no-datasets", options->with_datasets,
      "Leave out the jobs that have ended, with their datasets; keys, uploaded scenarios, "
      "calibrations, studies and what waits or runs stay");
  backup->footer("Contents of a backup: docs/operations.md.");
  backup->callback([options] {
    const server::BackupSize size = with_bar("backup", [&](const auto& show, const auto& stop) {
      return server::back_up(*options, show, stop);
    });
    fmt::print("{}: {} files, {} bytes\n", options->output.string(), size.files, size.bytes);
  });

  struct Arguments {
    std::string backup;
    std::string data;
    std::string database;
  };
  const auto arguments = std::make_shared<Arguments>();
  auto* restore = app.add_subcommand(
      "restore", "Restore a backup to a new or empty folder, for `throng serve --data`");
  restore->add_option("backup", arguments->backup, "Folder that throng backup made")->required();
  restore->add_option("data", arguments->data, "New or empty folder")->required();
  restore->add_option("--database", arguments->database,
                      "New or empty folder for the databases (default: the data folder)");
  restore->callback([arguments] {
    const server::BackupSize size = with_bar("restore", [&](const auto& show, const auto& stop) {
      return server::restore(arguments->backup, arguments->data, arguments->database, show, stop);
    });
    fmt::print("{}: {} files, {} bytes\n", arguments->data, size.files, size.bytes);
  });
}

}  // namespace throng::cli
