#include "annotate/keypoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "annotate/decimals.h"
#include "base/error.h"

namespace throng::annotate {

namespace {

/// How far (m) a keypoint may lie behind the surface that shows it: joints are inside of limbs, and
/// hips deepest.
constexpr std::array<float, skinning::kKeypointCount> kDepthInBodyM = {
    0.04F, 0.05F, 0.05F, 0.06F, 0.06F, 0.13F, 0.13F, 0.10F, 0.10F,
    0.08F, 0.08F, 0.20F, 0.20F, 0.13F, 0.13F, 0.13F, 0.13F};
/// Surfaces behind the keypoint by more are another part of the body, seen past it.
constexpr float kBehindM = 0.10F;

bool shows(const render::Frame& frame, std::uint32_t agent, const Eigen::Vector3f& at,
           float depth_in_body_m) {
  const int column = static_cast<int>(at.x());
  const int row = static_cast<int>(at.y());
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, frame.height() - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, frame.width() - 1); ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * frame.width() + x;
      if (frame.id[pixel] != render::id_of_agent(agent)) continue;
      const float behind_surface = at.z() - frame.depth_m[pixel];
      if (behind_surface <= depth_in_body_m && behind_surface >= -kBehindM) return true;
    }
  }
  return false;
}

/// Whether the camera sees a keypoint's place as it is recorded: where a lens's model ends,
/// rounding may decide that.
bool is_recorded_seen(const render::Frame& frame, const render::PersonInView& person,
                      std::size_t keypoint) {
  if (!frame.camera.intrinsics.distortion || person.keypoints_px) return true;
  const Eigen::Vector3d place = person.keypoints[keypoint].cast<double>().unaryExpr(
      [](double meters) { return rounded(meters, kMeterDecimals); });
  return frame.camera.project(place).visible;
}

}  // namespace

void add_keypoints(const render::Frame& frame, FrameLabels& labels) {
  check(frame.depth_m.size() == frame.id.size(), "keypoints are tested against the frame's depth");
  for (PersonLabel& label : labels.people) {
    const skinning::Keypoints seen = render::keypoints_in(label.person, frame.camera);
    label.keypoints.assign(seen.size(), {});
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i].allFinite() || !is_recorded_seen(frame, label.person, i)) continue;
      // As the record has it: rounding must not move a labeled point onto the image's edge.
      const double x = rounded(static_cast<double>(seen[i].x()), kPixelDecimals);
      const double y = rounded(static_cast<double>(seen[i].y()), kPixelDecimals);
      if (!(x >= 0 && y >= 0 && x < frame.width() && y < frame.height())) continue;
      const Eigen::Vector3f at(static_cast<float>(x), static_cast<float>(y), seen[i].z());
      const bool is_visible = shows(frame, label.agent, at, kDepthInBodyM[i]);
      label.keypoints[i] = {x, y, is_visible ? 2 : 1};
    }
  }
}

}  // namespace throng::annotate
