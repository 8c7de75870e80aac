#include "jobs/spec/job_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "jobs/spec/plan.h"
#include "jobs/spec/render_cost.h"
#include "jobs/spec/spec.h"
#include "jobs/spec/task_memory.h"

namespace throng::jobs {

namespace {

constexpr double kSimulatedPersonSecond = 60e-6;
constexpr double kSimulatedDroneSecond = 0.01;
constexpr double kLoadedPerson = 0.0003;
constexpr double kWorkerStartS = 0.6;  ///< of a shard: driver, character library, place

/// Bytes of the dataset.
constexpr double kJpegBytesPerPixel = 0.33;  ///< at quality 95
constexpr double kJpegOctave = 12;           ///< steps of quality that double the bytes
constexpr double kJpegQuality = 95;
constexpr double kAnnotationBytes = 1100;  ///< of a person in an image
constexpr double kTraceBytes = 14;         ///< of a person at a step of 0.1 s
constexpr double kStepsPerSecond = 10;

struct KindBytes {
  std::string_view kind;
  double per_pixel;
};
constexpr std::array kKindBytes = {
    KindBytes{"density", 0.2},         KindBytes{"depth", 0.9},
    KindBytes{"instances", 0.1},       KindBytes{"parts", 0.05},
    KindBytes{"normals", 1},           KindBytes{"flow", 1.5},
    KindBytes{"semantic", 0.05},       KindBytes{"flow_backward", 1.5},
    KindBytes{"flow_occlusion", 0.02}, KindBytes{"scene_flow", 0.15},
    KindBytes{"hazard_opacity", 0.25}};

double bytes_per_pixel(const OutputSpec& outputs) {
  double bytes =
      kJpegBytesPerPixel * std::exp2((outputs.image_quality - kJpegQuality) / kJpegOctave);
  for (const KindBytes& kind : kKindBytes) {
    const auto& names = outputs.annotations;
    if (std::find(names.begin(), names.end(), kind.kind) != names.end()) bytes += kind.per_pixel;
  }
  return bytes;
}

void add_run(const JobSpec& job, const RunPlan& run, double people, JobCost& cost) {
  const double duration_s = job.capture.to_s;
  const auto frames = static_cast<double>(job.frames_per_camera());
  const auto shards = static_cast<double>(plan_shards(job, run.index).size());
  const double in_view = kShareInView * people;
  double bytes = people * duration_s * kStepsPerSecond * kTraceBytes;
  cost.cpu_s += people * (kLoadedPerson + duration_s * kSimulatedPersonSecond) +
                static_cast<double>(job.drones.size()) * duration_s * kSimulatedDroneSecond +
                shards * kWorkerStartS;
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    const auto camera = camera_of_run(job.drones[i].camera, run.seed, camera_pointer(i));
    cost.cpu_s +=
        frames * image_cpu_s(job.quality, camera, in_view) + shards * camera_setup_cpu_s(camera);
    bytes +=
        frames * (static_cast<double>(camera.width) * camera.height * bytes_per_pixel(job.outputs) +
                  in_view * kAnnotationBytes);
  }
  cost.disk_bytes += static_cast<std::int64_t>(bytes);
  cost.shards += static_cast<std::int64_t>(shards);
  cost.images += job.frames_per_camera() * static_cast<std::int64_t>(job.drones.size());
}

}  // namespace

JobCost estimate_cost(const JobSpec& job, std::int64_t people) {
  JobCost cost;
  cost.runs = job.runs;
  for (const RunPlan& run : plan_runs(job)) {
    const JobSpec of_run = job_of_run(job, run.index);
    add_run(of_run, run, static_cast<double>(of_run.agents.value_or(static_cast<int>(people))),
            cost);
  }
  cost.memory_mib = TaskMemory(job, static_cast<int>(people)).max_mib();
  return cost;
}

nlohmann::json estimate_json(const JobCost& cost) {
  return {{"cpu_s", std::round(10 * cost.cpu_s) / 10},
          {"disk_bytes", cost.disk_bytes},
          {"memory_mib", cost.memory_mib}};
}

}  // namespace throng::jobs
