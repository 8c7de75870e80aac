#include "spec/estimates/task_memory.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "spec/annotate/ground_truth.h"
#include "spec/job/spec.h"
#include "spec/render/quality.h"

namespace throng::jobs {

namespace {

constexpr double kMibPerPerson = 0.006;
constexpr double kSimulateMib = 192;
constexpr double kRenderMib = 290;       // beside models, textures of the place and images
constexpr double kGroundTextures = 5;    // one per material of the ground
constexpr double kTexelBytes = 16. / 3;  // with mipmaps
constexpr double kShadowTexelBytes = 4;
// The actions of people are measured with the poses of their characters; their textures, which take
// most of the library, are in memory once instead of twice with mipmaps.
constexpr double kMeasuredShare = 0.5;
// MiB per million pixels, that is bytes per pixel.
constexpr double kImageBytes = 42;
constexpr double kSampleBytes = 28;  // each further sample of color
constexpr double kTruthBytes = 52;   // ground truth per pixel
constexpr double kMegapixel = 1e6;

bool has_pixel_truth(const OutputSpec& outputs) {
  return std::any_of(outputs.annotations.begin(), outputs.annotations.end(), [](const auto& name) {
    const annotate::GroundTruthKind* kind = annotate::find_kind(name);
    return kind != nullptr && kind->extent == annotate::Extent::pixel;
  });
}

/// Pixels of the flat image from which a lens that distorts takes its own, about; else the image's.
double rendered_megapixels(const camera::CameraSpec& camera) {
  const double image = static_cast<double>(camera.width) * camera.height / kMegapixel;
  const std::optional<camera::Intrinsics> lens = camera.intrinsics();
  if (!lens || !lens->distortion) return image;
  constexpr int kSteps = 32;
  Eigen::AlignedBox2d field;
  for (int y = 0; y <= kSteps; ++y) {
    for (int x = 0; x <= kSteps; ++x) {
      const Eigen::Vector2d pixel(1.0 * x * (lens->width - 1) / kSteps,
                                  1.0 * y * (lens->height - 1) / kSteps);
      if (const auto direction = lens->direction_of(pixel)) field.extend(*direction);
    }
  }
  if (field.isEmpty()) return image;
  const Eigen::Vector2d size =
      field.sizes().cwiseProduct(Eigen::Vector2d(lens->fx_px, lens->fy_px));
  return std::max(image, size.prod() / kMegapixel);
}

/// Textures of the ground and the shadow map.
double place_mib(const render::QualitySettings& quality) {
  const double ground = 1.0 * quality.ground_texels * quality.ground_texels * kGroundTextures;
  const double shadow = 1.0 * quality.shadow_texels * quality.shadow_texels;
  return (ground * kTexelBytes + shadow * kShadowTexelBytes) / kMegapixel;
}

double render_mib(const JobSpec& job, std::uint64_t run_seed) {
  double megapixels = 0;
  double kept = 0;  // images that wait for what follows them
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    const auto camera = camera_of_run(job.drones[i].camera, run_seed, camera_pointer(i));
    megapixels = std::max(megapixels, rendered_megapixels(camera));
    kept += static_cast<double>(camera.width) * camera.height / kMegapixel;
  }
  const render::QualitySettings& quality = render::quality_settings(job.quality);
  const int side = quality.supersampling;
  const double bytes = kImageBytes + (side * side - 1) * kSampleBytes +
                       (has_pixel_truth(job.outputs) ? kTruthBytes : 0);
  const bool keeps =
      annotate::holds(job.outputs.annotations, annotate::GroundTruth::flow_occlusion);
  return kRenderMib + place_mib(quality) + megapixels * bytes + (keeps ? kept * kTruthBytes : 0);
}

}  // namespace

TaskMemory::TaskMemory(const JobSpec& job, SceneLoad load) {
  const auto models = static_cast<double>(load.models_mib);
  for (const RunPlan& run : plan_runs(job)) {
    const JobSpec of_run = job_of_run(job, run.index);
    const double people = of_run.agents.value_or(load.people) * kMibPerPerson;
    const bool has_actions =
        annotate::holds(job.outputs.annotations, annotate::GroundTruth::actions);
    runs_.push_back({static_cast<std::int64_t>(kSimulateMib + people),
                     static_cast<std::int64_t>(kSimulateMib + people +
                                               (has_actions ? kMeasuredShare * models : 0)),
                     static_cast<std::int64_t>(render_mib(of_run, run.seed) + people + models)});
  }
}

std::int64_t TaskMemory::mib_of(const Task& task) const {
  if (task.kind == Task::Kind::report) return kReportMemoryMib;
  if (task.kind == Task::Kind::publish) return kPublishMemoryMib;
  // Beyond the job's runs there are tasks of all runs: the largest stands for them.
  const auto run = std::min(static_cast<std::size_t>(task.run), runs_.size() - 1);
  if (task.kind == Task::Kind::render) return runs_[run].render_mib;
  return task.kind == Task::Kind::measure ? runs_[run].measure_mib : runs_[run].simulate_mib;
}

std::int64_t TaskMemory::max_mib() const {
  std::int64_t most = 0;
  for (const Run& run : runs_) most = std::max({most, run.measure_mib, run.render_mib});
  return most;
}

std::int64_t calibration_memory_mib(std::int64_t max_image_pixels) {
  constexpr double kBaseMib = 192;
  constexpr double kBytesPerPixel = 8;
  return static_cast<std::int64_t>(kBaseMib + static_cast<double>(max_image_pixels) *
                                                  kBytesPerPixel / kMegapixel);
}

}  // namespace throng::jobs
