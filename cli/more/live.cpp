// throng live: a job's drones flown by commands from outside, without the service.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "base/error.h"
#include "cli/jobs/job_runner.h"
#include "cli/more/more_commands.h"
#include "cli/shell/file_kind.h"
#include "cli/shell/input_file.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "live/flight/outside/outside_flight.h"
#include "skinning/population.h"
#include "skinning/population_files.h"
#include "world/scenario.h"

namespace throng::cli {

namespace {

struct LiveArguments : live::OutsideOptions {
  std::string job_file;
  std::string recording_file;
  std::string output_folder;
  bool no_camera = false;
};

void print_flown(const live::Flown& flown) {
  fmt::print(stderr, "\nthrong: flown {:.1f} s\n", flown.duration_s);
  for (const std::string& warning : flown.warnings) {
    fmt::print(stderr, "throng: warning: {}\n", warning);
  }
  if (!flown.recording_problem.empty()) {
    fmt::print(stderr, "throng: warning: the recording ended early: {}\n", flown.recording_problem);
  }
  if (!flown.recording.empty()) fmt::print("{}\n", flown.recording.string());
  if (!flown.folder.empty()) fmt::print("{}\n", flown.folder.string());
}

void fly(LiveArguments arguments) {
  if (!arguments.recording_file.empty()) {
    check_output_file("--record", arguments.recording_file, {arguments.job_file});
    check_ending("--record", arguments.recording_file, {".mcap"});
  }
  arguments.recording = arguments.recording_file;
  arguments.output = arguments.output_folder;
  arguments.has_camera = !arguments.no_camera;
  const jobs::ResolvedJob job = read_job_file(arguments.job_file);
  if (job.spec().drones.empty()) {
    throw InputError({arguments.job_file, "/drones", "no drone", "at least one drone to fly"});
  }
  skinning::read_index(skinning::population_folder());
  const Interrupt interrupt;
  ProgressBar bar("flying");
  live::OutsideNews news;
  news.on_listening = [&](std::uint16_t port) {
    fmt::print(stderr, "throng: ws://{}:{} (Foxglove WebSocket)\n", arguments.host, port);
  };
  news.on_step = [&](double time_s, double reached_factor) {
    bar.show(time_s / arguments.duration_s,
             fmt::format("{:.0f} of {:.0f} s, {:.1f} times real time", time_s, arguments.duration_s,
                         reached_factor));
  };
  news.on_flown = print_flown;
  live::fly_outside(job.spec(), world::scenarios_folder(), arguments, news, interrupt.token());
}

void add_address_options(CLI::App& command, LiveArguments& arguments) {
  command
      .add_option("--port", arguments.port,
                  "Port for Foxglove's WebSocket protocol; 0: a free one, which is printed")
      ->capture_default_str();
  command.add_option("--host", arguments.host, "Address to listen on")->capture_default_str();
  command.add_option("--allow-origin", arguments.origins,
                     "Origin of a web page that may connect, besides pages of this machine and "
                     "Foxglove's; may be repeated; * for all");
}

}  // namespace

void add_live(CLI::App& app) {
  constexpr double kMaxDurationS = 3600;
  constexpr double kMaxFactor = 1000;
  auto* command = app.add_subcommand(
      "live", "Fly a job's drones by commands over Foxglove's WebSocket protocol");
  const auto arguments = std::make_shared<LiveArguments>();
  command->add_option("job", arguments->job_file, "Job file (JSON); its first run is flown")
      ->required();
  command
      ->add_option("--factor", arguments->factor,
                   "Simulated seconds per second; 0: as fast as it can")
      ->check(CLI::Range(0.0, kMaxFactor))
      ->capture_default_str();
  command
      ->add_option("--duration", arguments->duration_s,
                   "Simulated time at which the flight ends, s; Ctrl-C ends it, too")
      ->check(CLI::Range(1.0, kMaxDurationS))
      ->capture_default_str();
  command->add_flag("--paused", arguments->paused, "Wait at the start for a client");
  command->add_flag("--no-camera", arguments->no_camera, "Draw no images");
  command->add_option("--record", arguments->recording_file, "Recording to write (MCAP)");
  command->add_option("-o,--output", arguments->output_folder,
                      "Folder for flight000/: the trace, pilot logs and the job that repeats it");
  add_address_options(*command, *arguments);
  command->callback([arguments] { fly(*arguments); });
}

}  // namespace throng::cli
