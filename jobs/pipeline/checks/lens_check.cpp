#include "jobs/pipeline/checks/lens_check.h"

#include <fmt/core.h>

#include "render/lens/lens.h"
#include "render/renderer.h"

namespace throng::jobs {

namespace {

/// Larger images are not rendered. Only those beyond the software renderer's limit ask the device.
int max_rendered_px(int wanted_px) {
  constexpr int kSoftwarePx = 14336;
  if (wanted_px <= kSoftwarePx) return kSoftwarePx;
  try {
    static const int kDevicePx = render::max_image_px();
    return kDevicePx;
  } catch (const EnvironmentError&) {  // there is no device: workers will say so
    return kSoftwarePx;
  }
}

void check_rendered_size(const Eigen::Vector2i& size, render::Quality quality,
                         const std::string& pointer, std::vector<Problem>& problems) {
  const render::QualitySettings& settings = render::quality_settings(quality);
  const Eigen::Vector2i rendered = size * settings.supersampling;
  const int limit = max_rendered_px(rendered.maxCoeff());
  if (rendered.maxCoeff() <= limit) return;
  problems.push_back(
      {"", pointer,
       fmt::format("a camera whose images are rendered at {} x {} pixels in quality {}",
                   rendered.x(), rendered.y(), settings.word),
       fmt::format("at most {0} x {0} on this machine: a smaller image or a lower quality",
                   limit)});
}

}  // namespace

void check_lens(const camera::CameraSpec& run_camera, render::Quality quality,
                const std::string& pointer, std::vector<Problem>& problems) {
  constexpr int kMaxImagePx = 12000;  // px; what software GL draws with room around it
  const std::string at = pointer + "/distortion";
  const std::optional<camera::Intrinsics> k = run_camera.intrinsics();
  const Eigen::Vector2i size = k ? render::wide_size(*k) : Eigen::Vector2i::Zero();
  if (!k) {
    problems.push_back({"", at,
                        fmt::format("a lens whose model folds or ends (at most 80 degrees off its "
                                    "axis) within a field of view of {:g} degrees",
                                    run_camera.hfov_deg),
                        "a smaller field of view, or fx_px, with which the lens may show less than "
                        "the whole image"});
  } else if (size.minCoeff() == 0) {
    problems.push_back({"", at, "a lens whose model holds nowhere in the image",
                        "one that shows something of it"});
  } else if (k->distortion && size.maxCoeff() > kMaxImagePx) {
    problems.push_back(
        {"", at,
         fmt::format("a lens that a flat image of {} x {} pixels covers", size.x(), size.y()),
         fmt::format("one of at most {0} x {0}", kMaxImagePx)});
  } else {
    check_rendered_size(size, quality, pointer, problems);
  }
}

}  // namespace throng::jobs
