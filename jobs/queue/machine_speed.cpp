#include "jobs/queue/machine_speed.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/files/files.h"
#include "base/json/json_text.h"
#include "jobs/queue/dataset/publication.h"
#include "spec/estimates/job_cost.h"
#include "spec/job/plan.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr double kLargestFactor = 8;
constexpr int kMaxJobs = 8;  ///< that the mean remembers

struct MachineSpeed {
  double factor = 1;  ///< CPU time on this machine by that on the reference machine
  int jobs = 0;       ///< it was learned from
};

double clamped(double factor) { return std::clamp(factor, 1 / kLargestFactor, kLargestFactor); }

/// Anybody may have written the file: content that makes no sense counts as no file.
MachineSpeed read_speed(const fs::path& file) {
  constexpr std::uintmax_t kMaxBytes = 1000;
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > kMaxBytes) return {};
  try {
    const json stored = parse_json(read_file(file), file.string());
    const MachineSpeed speed{stored.at("factor").get<double>(), stored.at("jobs").get<int>()};
    if (speed.jobs < 1 || !(speed.factor > 0)) return {};
    return {clamped(speed.factor), std::min(speed.jobs, kMaxJobs)};
  } catch (const std::exception&) {
    return {};
  }
}

/// Knowledge that a check would have had of a run, had it known the future.
ExpectedRun simulated_run(const JobFolder& folder, const JobSpec& job, int run) {
  const json measured = read_record(folder.output_of({Task::Kind::measure, run}));
  ExpectedRun expected;
  expected.people = measured.at("metrics").at("people").get<std::int64_t>();
  expected.at_a_time = expected.taking_part = static_cast<double>(expected.people);
  double images = 0;
  double labels = 0;
  for (const Shard& shard : plan_shards(job, run)) {
    const json record = read_record(folder.output_of({Task::Kind::render, run, shard.index}));
    images += record.at("images").get<double>();
    labels += record.at("annotations").get<double>();
  }
  expected.in_view.assign(job.drones.size(), labels / std::max(1.0, images));
  return expected;
}

}  // namespace

fs::path user_speed_file() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  if (cache != nullptr && fs::path(cache).is_absolute()) {
    return fs::path(cache) / "throng/speed.json";
  }
  return home == nullptr || *home == '\0' ? fs::path()
                                          : fs::path(home) / ".cache/throng/speed.json";
}

void learn_machine_speed(const fs::path& file, const JobFolder& folder, const JobSpec& job,
                         double cpu_s) noexcept {
  if (file.empty()) return;
  try {
    std::vector<ExpectedRun> runs;
    runs.reserve(static_cast<std::size_t>(job.runs));
    for (int run = 0; run < job.runs; ++run) runs.push_back(simulated_run(folder, job, run));
    const double factor = clamped(cpu_s / estimate_cost(job, runs, 0).cpu_s);
    MachineSpeed speed = read_speed(file);
    speed.jobs = std::min(speed.jobs + 1, kMaxJobs);
    speed.factor *= std::pow(factor / speed.factor, 1.0 / speed.jobs);
    write_file_atomically(file, json{{"factor", speed.factor}, {"jobs", speed.jobs}}.dump() + "\n");
  } catch (const std::exception&) {  // the next job may teach it
  }
}

void fit_to_machine(json& answer, const fs::path& file) {
  const MachineSpeed speed = read_speed(file);
  if (speed.jobs == 0) return;
  json& estimate = answer.at("estimate");
  estimate["cpu_s"] = rounded_cpu_s(speed.factor * estimate.at("cpu_s").get<double>());
  estimate["basis"] = "this machine";
}

}  // namespace throng::jobs
