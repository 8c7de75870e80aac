#include "spec/job/render_cost.h"

#include <array>
#include <cstddef>

namespace throng::jobs {

namespace {

struct RenderCost {
  double per_megapixel_s;
  double per_person_s;  ///< in view; people small enough to be far away cost less
};
constexpr std::array kRenderCosts = {RenderCost{0.0152, 0.000047}, RenderCost{0.051, 0.000076},
                                     RenderCost{0.345, 0.00086}};
constexpr double kLensSetupMegapixelS = 2;
constexpr double kLensMegapixelS = 0.08;
constexpr double kShutterFactor = 2.5;  ///< motion blur or a rolling shutter

double supersampled_megapixels(const camera::CameraSpec& camera) {
  constexpr double kPerMegapixel = 1e6;
  return static_cast<double>(camera.width) * camera.height / kPerMegapixel;
}

bool has_lens(const camera::CameraSpec& camera) {
  return camera.lens.model != camera::LensModel::pinhole || camera.calibrated;
}

}  // namespace

double image_cpu_s(render::Quality quality, const camera::CameraSpec& camera,
                   double people_in_view) {
  const RenderCost& cost = kRenderCosts.at(static_cast<std::size_t>(quality));
  double image_s =
      supersampled_megapixels(camera) * cost.per_megapixel_s + people_in_view * cost.per_person_s;
  if (camera.exposure.exposure_s > 0 || camera.exposure.readout_s > 0) image_s *= kShutterFactor;
  if (camera.exposure.field_s > 0) image_s *= 2;
  if (has_lens(camera)) image_s += supersampled_megapixels(camera) * kLensMegapixelS;
  return image_s;
}

double camera_setup_cpu_s(const camera::CameraSpec& camera) {
  return has_lens(camera) ? supersampled_megapixels(camera) * kLensSetupMegapixelS : 0;
}

}  // namespace throng::jobs
