#include "jobs/pipeline/lens_check.h"

#include <fmt/core.h>

#include "render/lens/lens.h"

namespace throng::jobs {

void check_lens(const camera::CameraSpec& run_camera, const std::string& pointer,
                std::vector<Problem>& problems) {
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
  }
}

}  // namespace throng::jobs
