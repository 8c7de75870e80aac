#include "spec/estimates/job_cost.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "spec/estimates/task_memory.h"
#include "spec/job/environment.h"
#include "spec/job/plan.h"
#include "spec/job/render_cost.h"
#include "spec/job/spec.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

// CPU time beside that of images (scripts/studies/estimates.py of commit abf006d6 measured all of
// these).
constexpr double kRunS = 0.4;      ///< simulation and figures: processes, place
constexpr double kShardS = 2.9;    ///< driver, character library, place
constexpr double kDatasetS = 0.2;  ///< of a job: collecting, hashing
/// The light of a place and an hour by quality: means of three places (November 2026).
constexpr std::array<double, 3> kLightS = {1.6, 2.4, 8.3};
constexpr double kLoadedPersonS = 0.0001;
constexpr double kSimulatedSecondS = 0.027;
constexpr double kPersonSecondS = 28e-6;          ///< of a person who is present, simulated
constexpr double kMeasuredPersonSecondS = 35e-6;  ///< figures look at all people at all times
constexpr double kDroneSecondS = 0.01;
constexpr double kImageS = 0.07;        ///< of an image, however small
constexpr double kImageFactor = 1.75;   ///< labels and files beside the image
constexpr double kCloudsFactor = 1.25;  ///< light from everywhere, reflections on wet ground
constexpr double kPreviewMegapixelS = 0.05;

// Bytes of the job's folder, in which labels are twice: in the dataset and in the shards' outputs.
constexpr double kRunBytes = 130e3;    ///< scenario in the trace, records of tasks
constexpr double kLightBytes = 300e3;  ///< of the surfaces of a place
constexpr double kLightProbeBytes = 24;
constexpr double kMaxLightBytes = 64.0 * 1024 * 1024;
constexpr double kTracePersonStepBytes = 14;
constexpr double kFleeingPersonStepBytes = 22;
constexpr double kStepsPerSecond = 10;
constexpr double kPersonBytes = 600;  ///< figures of a person
constexpr double kTrackBytes = 1300;  ///< of a person whom a shard shows
constexpr double kImageRecordBytes = 12e3;
constexpr double kPersonLabelBytes = 1450;    ///< of a person in an image
constexpr double kFormatPersonBytes = 130;    ///< of a label in another format
constexpr double kDensityPersonBytes = 2700;  ///< of a head at kDensitySigmaPx
constexpr double kDensitySigmaPx = 4;
constexpr double kDensityShare = 0.5;  ///< of an image that a crowd fills, where heads overlap
constexpr double kJpegBytesPerPixel = 0.42;  ///< at kJpegQuality and kJpegMegapixels
constexpr double kJpegMegapixels = 0.92;
constexpr double kJpegExponent = -0.15;  ///< larger images hold less in a pixel
constexpr double kJpegOctave = 12;       ///< steps of quality that double the bytes
constexpr double kJpegQuality = 95;
constexpr double kDraftShare = 0.42;  ///< flat colors
constexpr double kPixelsPerMegapixel = 1e6;

/// Cells of the grids in fields/ beside those of a job's own size.
constexpr double kFieldCellM = 0.5;
constexpr double kFieldCellBytes = 16;

struct KindBytes {
  std::string_view kind;
  double per_pixel;
  double per_person = 0;
  double per_moving_pixel = 0;  ///< instead, of a camera that moves
};
constexpr std::array kKindBytes = {
    KindBytes{"depth", 0.2},           KindBytes{"instances", 0.045},
    KindBytes{"parts", 0.022},         KindBytes{"normals", 0.3},
    KindBytes{"flow", 0.1, 0, 0.6},    KindBytes{"flow_backward", 0.1, 0, 0.6},
    KindBytes{"flow_occlusion", 0.02}, KindBytes{"scene_flow", 0.09},
    KindBytes{"hazard_opacity", 0.01}, KindBytes{"semantic", 0.04},
    KindBytes{"keypoints", 0, 1300},   KindBytes{"skeletons", 0, 3800},
    KindBytes{"amodal", 0, 200},       KindBytes{"difficulty", 0, 200},
    KindBytes{"heads", 0, 120}};

bool has_kind(const JobSpec& job, std::string_view kind) {
  const auto& names = job.outputs.annotations;
  return std::find(names.begin(), names.end(), kind) != names.end();
}

/// Bytes of an image file.
double jpeg_bytes(const JobSpec& job, double pixels) {
  const double megapixels = pixels / kPixelsPerMegapixel;
  return pixels * kJpegBytesPerPixel * std::pow(megapixels / kJpegMegapixels, kJpegExponent) *
         std::exp2((job.outputs.image_quality - kJpegQuality) / kJpegOctave) *
         (job.quality == render::Quality::draft ? kDraftShare : 1);
}

/// Bytes of ground truth of an image, and of its labels in other formats.
double truth_bytes(const JobSpec& job, bool is_moving, double pixels, double people) {
  double bytes = people * kFormatPersonBytes * static_cast<double>(job.outputs.formats.size());
  for (const KindBytes& kind : kKindBytes) {
    if (!has_kind(job, kind.kind)) continue;
    const bool is_other = is_moving && kind.per_moving_pixel > 0;
    bytes +=
        pixels * (is_other ? kind.per_moving_pixel : kind.per_pixel) + people * kind.per_person;
  }
  if (has_kind(job, "coco")) bytes += kImageRecordBytes + people * kPersonLabelBytes;
  if (has_kind(job, "density")) {
    const double scale = job.outputs.density_sigma_px / kDensitySigmaPx;
    const double full = kDensityShare * pixels * sizeof(float);
    bytes += full * -std::expm1(-people * kDensityPersonBytes * scale * scale / full);
  }
  return bytes;
}

double weather_factor(const JobSpec& job, const RunPlan& run) {
  const render::Weather weather = environment_of_run(job.environment, run.seed).light.weather;
  const bool is_cloudy = weather == render::Weather::overcast || weather == render::Weather::rain;
  return is_cloudy ? kCloudsFactor : 1;
}

void add_camera(const JobSpec& job, const camera::CameraSpec& camera, bool is_moving, double people,
                double shards, double image_factor, JobCost& cost) {
  const auto frames = static_cast<double>(job.frames_per_camera());
  const double previews = std::min<double>(frames, job.outputs.previews);
  const double pixels = static_cast<double>(camera.width) * camera.height;
  cost.cpu_s += frames * (kImageS + image_factor * image_cpu_s(job.quality, camera, people)) +
                shards * camera_setup_cpu_s(camera) +
                previews * kPreviewMegapixelS * pixels / kPixelsPerMegapixel;
  cost.disk_bytes +=
      static_cast<std::int64_t>((frames + previews) * jpeg_bytes(job, pixels) +
                                frames * truth_bytes(job, is_moving, pixels, people) +
                                (shards + 1) * people * kTrackBytes / 2);
}

void add_run(const JobSpec& job, const RunPlan& run, const ExpectedRun& expected, JobCost& cost) {
  const double duration_s = job.capture.end_s();
  const auto shards = static_cast<double>(plan_shards(job, run.index).size());
  const auto drones = static_cast<double>(job.drones.size());
  const double step_bytes = expected.is_fled ? kFleeingPersonStepBytes : kTracePersonStepBytes;
  cost.cpu_s += kRunS + static_cast<double>(expected.people) * kLoadedPersonS +
                duration_s * (kSimulatedSecondS + expected.at_a_time * kPersonSecondS +
                              expected.taking_part * kMeasuredPersonSecondS) +
                drones * duration_s * kDroneSecondS + shards * kShardS;
  cost.disk_bytes += static_cast<std::int64_t>(
      kRunBytes + expected.at_a_time * (kPersonBytes + duration_s * kStepsPerSecond * step_bytes));
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    const DroneSpec& drone = job.drones[i];
    add_camera(job, camera_of_run(drone.camera, run.seed, camera_pointer(i)),
               drone.mission.policy != "hover",
               expected.in_view.at(i).value_or(kShareInView * expected.at_a_time), shards,
               kImageFactor * weather_factor(job, run), cost);
  }
  if (has_kind(job, "fields")) {
    double cells_m2 = 1 / (kFieldCellM * kFieldCellM);
    for (const double cell_m : job.outputs.field_cells_m) cells_m2 += 1 / (cell_m * cell_m);
    cost.disk_bytes += static_cast<std::int64_t>(static_cast<double>(job.frames_per_camera()) *
                                                 expected.ground_m2 * cells_m2 * kFieldCellBytes);
  }
  cost.shards += static_cast<std::int64_t>(shards);
  cost.images += job.frames_per_camera() * static_cast<std::int64_t>(job.drones.size());
}

/// The light that is baked for each place and hour of a job (render/light/place_light.h).
class BakedLight {
 public:
  void add(const JobSpec& job, const RunPlan& run, const ExpectedRun& expected) {
    if (job.drones.empty()) return;
    const render::Environment sky = environment_of_run(job.environment, run.seed).light;
    const std::uint64_t props_seed = job.props_density < 1 ? run.seed : 0;
    if (!known_
             .emplace(job.scenario, sky.sun_azimuth_rad, sky.sun_elevation_rad, sky.weather,
                      props_seed)
             .second)
      return;
    constexpr double kProbesPerM2 = 0.5;  // two layers, 2 m apart
    constexpr double kMaxProbes = 12'000;
    bytes +=
        kLightBytes + kLightProbeBytes * std::min(kProbesPerM2 * expected.ground_m2, kMaxProbes);
    cpu_s += kLightS[static_cast<std::size_t>(job.quality)];
  }

  double cpu_s = 0;
  double bytes = 0;

 private:
  std::set<std::tuple<std::string, double, double, render::Weather, std::uint64_t>> known_;
};

}  // namespace

JobCost estimate_cost(const JobSpec& job, const std::vector<ExpectedRun>& expected,
                      std::int64_t models_mib) {
  JobCost cost;
  BakedLight light;
  cost.runs = job.runs;
  cost.cpu_s = kDatasetS;
  std::int64_t max_people = 0;
  for (const RunPlan& run : plan_runs(job)) {
    const ExpectedRun& of_run = expected.at(static_cast<std::size_t>(run.index));
    const JobSpec own = job_of_run(job, run.index);
    add_run(own, run, of_run, cost);
    light.add(own, run, of_run);
    max_people = std::max(max_people, of_run.people);
  }
  cost.cpu_s += light.cpu_s;
  cost.disk_bytes += static_cast<std::int64_t>(std::min(light.bytes, kMaxLightBytes));
  cost.memory_mib = TaskMemory(job, {static_cast<int>(max_people), models_mib}).max_mib();
  return cost;
}

JobCost estimate_cost(const JobSpec& job, SceneLoad load) {
  std::vector<ExpectedRun> of_runs;
  for (int run = 0; run < job.runs; ++run) {
    const std::int64_t all = job_of_run(job, run).agents.value_or(load.people);
    const auto count = static_cast<double>(all);
    of_runs.push_back({.people = all,
                       .at_a_time = count,
                       .in_view = std::vector<std::optional<double>>(job.drones.size()),
                       .taking_part = count});
  }
  return estimate_cost(job, of_runs, load.models_mib);
}

double rounded_cpu_s(double cpu_s) { return std::round(10 * cpu_s) / 10; }

json estimate_json(const JobCost& cost) {
  return {{"cpu_s", rounded_cpu_s(cost.cpu_s)},
          {"disk_bytes", cost.disk_bytes},
          {"memory_mib", cost.memory_mib},
          {"basis", "reference machine"}};
}

json warning_json(const Problem& warning) {
  return {{"pointer", warning.where},
          {"found", warning.found},
          {"expected", warning.expected},
          {"message", Problem{"", warning.where, warning.found, warning.expected}.text()}};
}

std::string size_text(double bytes) {
  constexpr double kStep = 1000;
  constexpr std::array kUnits = {"kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  double value = bytes / kStep;
  for (; value >= kStep && unit + 1 < kUnits.size(); ++unit) value /= kStep;
  return value < 10 ? fmt::format("{:.1f} {}", value, kUnits.at(unit))
                    : fmt::format("{:.0f} {}", value, kUnits.at(unit));
}

Problem too_large_for_disk(double planned_bytes, double disk_bytes, std::string_view disk) {
  return {"", "/runs", "a job of about " + size_text(planned_bytes),
          fmt::format("at most the {} {}: fewer runs, images or annotations", size_text(disk_bytes),
                      disk)};
}

void warn_of_full_disk(json& answer, double free_bytes, std::string_view disk) {
  const auto planned_bytes = answer.at("estimate").at("disk_bytes").get<double>();
  if (planned_bytes <= free_bytes) return;
  answer.at("warnings")
      .push_back(warning_json(
          too_large_for_disk(planned_bytes, free_bytes, fmt::format("that are free on {}", disk))));
}

}  // namespace throng::jobs
