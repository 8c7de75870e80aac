// throng crowd: a Menge project, here and now, without people, drones or images.
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

#include "base/error.h"
#include "cli/crowd/crowd_list.h"
#include "cli/crowd/crowd_options.h"
#include "cli/shell/commands.h"
#include "cli/shell/input_file.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "crowd/output/positions.h"
#include "crowd/output/scb.h"
#include "crowd/output/series.h"
#include "crowd/output/standing.h"
#include "sim/people/crowd_trace.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;
using Recorders = std::vector<std::unique_ptr<crowd::Recorder>>;

void print_warnings(const std::vector<Problem>& warnings) {
  constexpr std::size_t kMaxWarnings = 30;
  for (std::size_t i = 0; i < std::min(warnings.size(), kMaxWarnings); ++i) {
    fmt::print(stderr, "throng: warning: {}\n", warnings[i].text());
  }
  if (warnings.size() > kMaxWarnings) {
    fmt::print(stderr, "throng: and {} more warnings\n", warnings.size() - kMaxWarnings);
  }
}

bool is_trace(const fs::path& output) {
  return output.extension() == ".h5" || output.extension() == ".hdf5";
}

/// Menge, too, gives trajectories the suffix that they miss.
fs::path with_suffix(fs::path output) {
  if (!output.empty() && !is_trace(output) && output.extension() != ".scb") output += ".scb";
  return output;
}

Recorders make_recorders(const CrowdArguments& arguments, const crowd::Project& project,
                         const crowd::Simulation& crowd) {
  Recorders recorders;
  const fs::path output = with_suffix(project.output);
  if (is_trace(output)) {
    recorders.push_back(std::make_unique<sim::CrowdTrace>(
        output, project.scene_file.stem().string(), crowd, project.options.seed));
  } else if (!output.empty()) {
    recorders.push_back(std::make_unique<crowd::ScbWriter>(output, project.scb_version, crowd));
  }
  if (!arguments.series_file.empty()) {
    recorders.push_back(std::make_unique<crowd::SeriesWriter>(arguments.series_file, crowd));
  }
  if (!arguments.positions_file.empty()) {
    std::optional<std::vector<double>> times_s;
    if (!arguments.positions_at_s.empty()) times_s = arguments.positions_at_s;
    recorders.push_back(
        std::make_unique<crowd::PositionsWriter>(arguments.positions_file, times_s, crowd));
  }
  return recorders;
}

/// Steps until everybody is in a final state or the time is over. Returns the number of steps.
long simulate(crowd::Simulation& crowd, double duration_s, const Recorders& recorders, bool quiet,
              const Interrupt& interrupt) {
  std::optional<ProgressBar> bar;
  if (!quiet) bar.emplace("crowd");
  constexpr double kRounding = 1e-9;
  const long max_steps = std::lround(std::ceil(duration_s / crowd.dt_s() - kRounding));
  long steps = 0;
  while (true) {
    for (const auto& recorder : recorders) recorder->record(crowd);
    if (bar) {
      bar->show(max_steps > 0 ? static_cast<double>(steps) / static_cast<double>(max_steps) : 1,
                fmt::format("{:.1f} of {:g} s", crowd.time_s(), duration_s));
    }
    if (steps == max_steps || crowd.all_final()) break;
    if (interrupt.token().stop_requested()) throw Cancelled();
    crowd.step();
    ++steps;
  }
  for (const auto& recorder : recorders) recorder->finish(crowd);
  return steps;
}

void print_summary(const crowd::Simulation& crowd, long steps, double wall_s) {
  std::size_t present = 0;
  std::size_t final = 0;
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    if (crowd.present()[i] == 0) continue;
    ++present;
    if (crowd.is_final(crowd.states()[i])) ++final;
  }
  const double agent_steps = static_cast<double>(crowd.agent_count()) * static_cast<double>(steps);
  fmt::print(
      "{} agents, {:g} s in {} steps, {:.3f} s of computing, {:.3g} agent-steps/s, {} of {} in "
      "final states\n",
      crowd.agent_count(), crowd.time_s(), steps, wall_s, wall_s > 0 ? agent_steps / wall_s : 0,
      final, present);
}

void run(const CrowdArguments& arguments) {
  const int threads = arguments.threads > 0 ? arguments.threads
                                            : static_cast<int>(std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(std::max(threads, 1)));
  const crowd::Project project = load_project(arguments);
  for (const auto& [option, output] : {std::pair{"--output", with_suffix(project.output).string()},
                                       std::pair{"--series", arguments.series_file},
                                       std::pair{"--positions", arguments.positions_file}}) {
    check_output_file(option, output,
                      {arguments.project_file, project.scene_file, project.behavior_file});
  }
  if (!arguments.quiet) print_warnings(project.warnings);
  crowd::Simulation crowd = crowd::load_simulation(project);
  if (!arguments.quiet) print_warnings(crowd.warnings());
  const Interrupt interrupt;  // before there are files to remove
  Recorders recorders = make_recorders(arguments, project, crowd);
  auto& standing = static_cast<crowd::StandingWatch&>(
      *recorders.emplace_back(std::make_unique<crowd::StandingWatch>()));
  const auto start = std::chrono::steady_clock::now();
  const long steps = simulate(crowd, project.duration_s, recorders, arguments.quiet, interrupt);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  if (!arguments.quiet && standing.warning()) print_warnings({*standing.warning()});
  if (!arguments.quiet) print_summary(crowd, steps, wall.count());
}

}  // namespace

void add_crowd(CLI::App& app) {
  auto* command =
      app.add_subcommand("crowd", "Simulate a Menge project and write its trajectories");
  const auto arguments = std::make_shared<CrowdArguments>();
  add_crowd_options(*command, *arguments);
  command->callback([arguments] {
    if (!arguments->list) return run(*arguments);
    const char* format = arguments->json ? "json" : arguments->markdown ? "markdown" : "text";
    fmt::print("{}", crowd_vocabulary(format));
  });
}

}  // namespace throng::cli
