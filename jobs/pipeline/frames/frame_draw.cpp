#include "jobs/pipeline/frames/frame_draw.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/compute/random.h"

namespace throng::jobs {

namespace {

// The range of the field.
constexpr double kMinBalanceK = 1667;
constexpr double kMaxBalanceK = 25000;

}  // namespace

camera::FrameOffsets draw_of_frame(const camera::CameraSpec& run_camera, std::uint64_t run_seed,
                                   std::size_t drone, std::int64_t frame) {
  constexpr unsigned kFrameBits = 40;
  constexpr std::uint64_t kDraws = std::uint64_t{1} << 62;  // apart from the images' noise
  Random random(run_seed, Stream::camera_noise,
                kDraws + (static_cast<std::uint64_t>(drone) << kFrameBits) +
                    static_cast<std::uint64_t>(frame));
  // Always four numbers, so that one field does not depend on another.
  camera::FrameOffsets draw;
  draw.yaw_deg = random.normal(0, 1) * run_camera.per_frame.yaw_deg;
  draw.pitch_deg = random.normal(0, 1) * run_camera.per_frame.pitch_deg;
  draw.ev = random.normal(0, 1) * run_camera.per_frame.ev;
  draw.white_balance_k = random.normal(0, 1) * run_camera.per_frame.white_balance_k;
  // The recorded value is the sum, not the sample.
  draw.pitch_deg =
      std::clamp(run_camera.pitch_deg + draw.pitch_deg, -90.0, 90.0) - run_camera.pitch_deg;
  const double balance_k = run_camera.sensor.white_balance_k;
  draw.white_balance_k =
      std::clamp(balance_k + draw.white_balance_k, kMinBalanceK, kMaxBalanceK) - balance_k;
  return draw;
}

camera::CameraSpec camera_of_frame(const camera::CameraSpec& run_camera,
                                   const camera::FrameOffsets& draw) {
  camera::CameraSpec camera = run_camera;
  camera.yaw_deg += draw.yaw_deg;
  camera.pitch_deg += draw.pitch_deg;
  camera.sensor.ev += draw.ev;
  camera.sensor.white_balance_k += draw.white_balance_k;
  return camera;
}

nlohmann::json to_json(const camera::CameraSpec& run_camera, const camera::FrameOffsets& draw) {
  nlohmann::json drawn = nlohmann::json::object();
  if (run_camera.per_frame.yaw_deg > 0) drawn["frame.yaw_deg"] = draw.yaw_deg;
  if (run_camera.per_frame.pitch_deg > 0) drawn["frame.pitch_deg"] = draw.pitch_deg;
  if (run_camera.per_frame.ev > 0) drawn["frame.ev"] = draw.ev;
  if (run_camera.per_frame.white_balance_k > 0) {
    drawn["frame.white_balance_k"] = draw.white_balance_k;
  }
  return drawn;
}

}  // namespace throng::jobs
