#include "jobs/queue/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/files/files.h"
#include "base/json/json_text.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

std::filesystem::path profile_file(const JobFolder& folder, const Task& task) {
  return folder.log_file(task).replace_extension(".profile.json");
}

}  // namespace

bool is_profiling() { return std::getenv(kProfileVariable) != nullptr; }

void write_profile(const JobFolder& folder, const Task& task, const StageClock& clock,
                   std::int64_t images) {
  json stages = json::object();
  for (const auto& [stage, time] : clock.times()) {
    stages[stage] = {{"cpu_s", time.cpu_s}, {"wall_s", time.wall_s}};
  }
  write_file_atomically(profile_file(folder, task),
                        json{{"images", images}, {"stages", std::move(stages)}}.dump() + "\n");
}

std::string profile_table(const JobFolder& folder, const JobSpec& job) {
  StageClock::Times times;
  std::int64_t images = 0;
  for (const RunPlan& run : plan_runs(job)) {
    for (const Shard& shard : plan_shards(job, run.index)) {
      const auto file = profile_file(folder, {Task::Kind::render, run.index, shard.index});
      if (!std::filesystem::exists(file)) continue;
      const json profile = parse_own_json(read_file(file), file.string());
      images += profile.at("images").get<std::int64_t>();
      for (const auto& [stage, time] : profile.at("stages").items()) {
        times[stage].cpu_s += time.at("cpu_s").get<double>();
        times[stage].wall_s += time.at("wall_s").get<double>();
      }
    }
  }
  if (images == 0) return "no frame was rendered with --profile: the work was done before\n";
  std::vector<std::pair<std::string, StageTime>> rows(times.begin(), times.end());
  std::sort(rows.begin(), rows.end(),
            [](const auto& a, const auto& b) { return a.second.cpu_s > b.second.cpu_s; });
  StageTime sum;
  for (const auto& [stage, time] : rows) {
    sum.cpu_s += time.cpu_s;
    sum.wall_s += time.wall_s;
  }
  rows.emplace_back(fmt::format("all of {} images", images), sum);
  std::string text =
      fmt::format("{:<24}{:>16}{:>16}{:>8}\n", "stage", "CPU ms/image", "wall ms/image", "share");
  for (const auto& [stage, time] : rows) {
    const double per_image = 1000.0 / static_cast<double>(images);
    fmt::format_to(std::back_inserter(text), "{:<24}{:>16.2f}{:>16.2f}{:>7.1f}%\n", stage,
                   time.cpu_s * per_image, time.wall_s * per_image,
                   sum.cpu_s > 0 ? 100 * time.cpu_s / sum.cpu_s : 0.0);
  }
  return text;
}

}  // namespace throng::jobs
