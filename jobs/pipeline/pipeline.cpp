#include "jobs/pipeline/pipeline.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "annotate/rasters/png.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/text/redact.h"
#include "camera/files.h"
#include "jobs/bucket/publish.h"
#include "jobs/pipeline/checks/rehearsal.h"
#include "jobs/pipeline/frames/render_shard.h"
#include "jobs/pipeline/frames/run_writers.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/run_input.h"
#include "jobs/queue/dataset/publication.h"
#include "jobs/queue/dataset/run_warnings.h"
#include "jobs/queue/delivery.h"
#include "jobs/queue/trace_seal.h"
#include "metrics/evacuation.h"
#include "metrics/exits/exits.h"
#include "render/lens/lens_map.h"
#include "sim/recording/trace_recorder.h"
#include "sim/run.h"
#include "spec/bucket/address.h"
#include "spec/job/environment.h"
#include "spec/job/scenario_mix.h"
#include "spec/job/spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::jobs {

namespace fs = std::filesystem;

void simulate_run(const JobFolder& folder, const JobSpec& job, const fs::path& scenarios, int run,
                  const OnTaskProgress& on_progress, const std::stop_token& stop) {
  const fs::path trace = folder.output_of({Task::Kind::simulate, run});
  make_folders(trace.parent_path());
  const auto progress = [&](double done_s, double total_s) {
    if (on_progress) on_progress({done_s, total_s});
  };
  const world::Scenario scenario = load_job_scenario(in_scenario_of_run(job, run), scenarios);
  std::vector<std::string> warnings;
  sim::TraceRecorder recorder(trace);
  std::vector<Problem> notes;
  const sim::RunSpec spec = run_spec(job, run, &notes);
  for (const Problem& warning :
       warnings_of_run(sim::simulate(scenario, spec, recorder, progress, stop), spec,
                       std::move(notes), scenario)) {
    warnings.push_back(without_folders(warning.text(), {folder.path(), scenarios}));
  }
  // Before the trace gets its name, with which the task is done: its metrics have them.
  keep_warnings(trace, warnings);
  recorder.finish();
  seal_trace(trace);
  // All runs of a scenario read the same files.
  const std::vector<int> first = first_runs(job);
  if (std::find(first.begin(), first.end(), run) == first.end()) return;
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

namespace {

// The calibration of every camera.
void add_cameras(const JobSpec& job, int run, Publication& output) {
  const std::uint64_t seed = run_seed(job, run);
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    const std::string& id = job.drones[i].mission.id;
    const auto lens = camera_of_run(job.drones[i].camera, seed, camera_pointer(i)).intrinsics();
    check(lens.has_value(), "a job's lenses are checked when it is read");
    const std::string place = fmt::format("{}/{}", run_name(run), id);
    output.add("cameras/" + place + ".opencv.yaml", camera::opencv_yaml(*lens));
    output.add("cameras/" + place + ".ros.yaml", camera::ros_yaml(*lens, id));
    if (!render::shows_everywhere(*lens)) {
      output.add("cameras/" + place + ".mask.png",
                 annotate::png_bytes({lens->width, lens->height, 1}, render::shown_pixels(*lens)));
    }
  }
}

}  // namespace

void measure_run(const JobFolder& folder, const JobSpec& job, const fs::path& scenarios, int run) {
  const world::Trace trace = world::read_trace(folder.output_of({Task::Kind::simulate, run}));
  const world::Scenario scenario =
      scenario_of_run(in_scenario_of_run(job, run), scenarios, trace.header);
  const std::vector<metrics::ExitSeries> exits = metrics::exit_series(trace, scenario);
  const metrics::RunMetrics measured = metrics::run_metrics(trace, scenario, exits);
  nlohmann::json figures = metrics::to_json(measured);
  std::vector<std::string> warnings = task_warnings(folder.output_of({Task::Kind::simulate, run}));
  for (const nlohmann::json& warning : figures.at("warnings")) warnings.push_back(warning);
  figures["warnings"] = std::move(warnings);
  keep_warnings(folder.output_of({Task::Kind::measure, run}),
                metrics::count_warnings(measured.counts));

  Publication output(folder.output_of({Task::Kind::measure, run}));
  output.add("metrics/" + run_name(run) + ".json", figures.dump(kJsonIndent) + "\n");
  RunOutput run_output{job, run, scenario, trace, exits, output};
  for (const RunWriter& writer : run_writers()) {
    if (wants(job, writer.kind)) writer.write(run_output);
  }
  add_cameras(job, run, output);
  // The trace may come from elsewhere (`throng render`): its seed is the one that counts.
  output.publish({{"seed", trace.header.seed}, {"metrics", figures}});
}

void publish_job(const JobFolder& folder, const JobSpec& job, const OnTaskProgress& on_progress,
                 const std::stop_token& stop) {
  const bucket::Address address =
      bucket::parse_address(job.outputs.publish, "", "/outputs/publish");
  const auto progress = [&](std::int64_t done_bytes, std::int64_t total_bytes) {
    if (on_progress) {
      on_progress({static_cast<double>(done_bytes), static_cast<double>(total_bytes)});
    }
  };
  const bucket::Published published =
      bucket::publish_dataset(folder.dataset(), address, progress, stop);
  write_delivery(folder, {address.text(), published.objects, published.bytes});
}

void do_task(const JobFolder& folder, const ResolvedJob& resolved, const fs::path& scenarios,
             const Task& task, const OnTaskProgress& on_progress, const std::stop_token& stop) {
  const JobSpec& job = resolved.spec();
  if (folder.is_done(task)) return;
  switch (task.kind) {
    case Task::Kind::simulate:
      return simulate_run(folder, job, scenarios, task.run, on_progress, stop);
    case Task::Kind::measure:
      return measure_run(folder, job, scenarios, task.run);
    case Task::Kind::render:
      return render_shard(folder, job, scenarios,
                          plan_shards(job, task.run)[static_cast<std::size_t>(task.shard)],
                          on_progress, stop);
    case Task::Kind::collect:
      return collect_dataset(folder, job);
    case Task::Kind::publish:
      return publish_job(folder, job, on_progress, stop);
    case Task::Kind::calibrate:
    case Task::Kind::report:
    case Task::Kind::study_run:
    case Task::Kind::study_report:
      check(false, "the program has tasks of its own for calibrations, reports and studies");
  }
}

}  // namespace throng::jobs
