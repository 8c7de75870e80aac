// throng live-process: the process of a live flight, for the service.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "cli/more/more_commands.h"
#include "live/flight/session.h"

namespace throng::cli {

void add_live_process(CLI::App& app) {
  auto* command = app.add_subcommand("live-process", "Fly a job's drones for the service");
  command->group("");  // not for users
  const auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "Folder with the job")->required();
  const auto min_free_mib = std::make_shared<std::optional<std::uint64_t>>();
  command->add_option("--record", *min_free_mib,
                      "Record the flight while the disk has this much free space, MiB");
  const auto max_bytes = std::make_shared<std::uint64_t>(0);
  command->add_option("--max-bytes", *max_bytes, "End the recording at this size (0: unlimited)");
  command->callback([folder, min_free_mib, max_bytes] {
    constexpr int kMibShift = 20;
    std::optional<live::RecordingOptions> record;
    if (*min_free_mib) {
      record = {.min_free_bytes = **min_free_mib << kMibShift, .max_bytes = *max_bytes};
    }
    std::exit(live::run_session(*folder, record));
  });
}

}  // namespace throng::cli
