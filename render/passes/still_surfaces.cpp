#include "render/passes/still_surfaces.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "render/frame/view.h"

namespace throng::render {

namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Inverse depth around a pixel. On a plane it is an affine function of the pixel.
class InverseDepth {
 public:
  explicit InverseDepth(const Frame& frame) : frame_(frame) {}

  float at(std::size_t pixel) const { return 1 / frame_.depth_m[pixel]; }

  /// Its slope along one axis of the image, where `place` of `size` pixels lie before the pixel:
  /// from the side on which the surface goes on more evenly.
  float slope(std::size_t pixel, std::size_t stride, int place, int size) const {
    const float here = at(pixel);
    const std::uint32_t id = frame_.id[pixel];
    struct Side {
      float slope = 0;
      float bend = std::numeric_limits<float>::infinity();
      bool known = false;
    };
    const auto look = [&](bool forwards) {
      Side side;
      const int room = forwards ? size - 1 - place : place;
      const float sign = forwards ? 1.0F : -1.0F;
      const auto beside = [&](std::size_t steps) {
        return forwards ? pixel + steps * stride : pixel - steps * stride;
      };
      if (room < 1 || frame_.id[beside(1)] != id) return side;
      side.known = true;
      const float first = at(beside(1));
      side.slope = sign * (first - here);
      if (room < 2 || frame_.id[beside(2)] != id) return side;
      side.bend = std::abs(at(beside(2)) - 2 * first + here);
      return side;
    };
    const Side before = look(false);
    const Side after = look(true);
    if (!before.known) return after.slope;
    return after.known && after.bend < before.bend ? after.slope : before.slope;
  }

 private:
  const Frame& frame_;
};

}  // namespace

void fill_still_normals(Frame& frame) {
  const camera::Intrinsics& k = frame.camera.intrinsics;
  const Eigen::Matrix3f to_world = frame.camera.pose.R.transpose().cast<float>();
  const InverseDepth inverse(frame);
  const auto width = static_cast<std::size_t>(frame.width());
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      if (is_posed(frame.id[pixel]) || std::isinf(frame.depth_m[pixel])) continue;
      const float across = inverse.slope(pixel, 1, x, frame.width());
      const float down = inverse.slope(pixel, width, y, frame.height());
      // The plane n . X = d gives 1 / z = (n / d) . K^-1 (x, y, 1); n / d points away from the eye.
      const Eigen::Vector3f away(across * static_cast<float>(k.fx_px),
                                 down * static_cast<float>(k.fy_px),
                                 inverse.at(pixel) - across * static_cast<float>(x - k.cx_px) -
                                     down * static_cast<float>(y - k.cy_px));
      const Eigen::Vector3f normal = to_world * -away.normalized();
      for (Eigen::Index c = 0; c < 3; ++c) {
        frame.normal[pixel * 3 + static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>(std::lround(128 + 127 * normal[c]));
      }
    }
  }
}

void fill_still_flow(const camera::Camera& other, const Frame& frame, std::vector<float>& flow,
                     std::vector<float>* depth_m) {
  const camera::Camera& here = frame.camera;
  const Eigen::Matrix3d turn = other.pose.R * here.pose.R.transpose();
  const Eigen::Matrix3d from_far =
      other.intrinsics.matrix() * turn * here.intrinsics.matrix().inverse();
  const Eigen::Vector3d from_near = other.intrinsics.matrix() * (other.pose.t - turn * here.pose.t);
  std::size_t pixel = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x, ++pixel) {
      if (is_posed(frame.id[pixel])) continue;
      const double here_m = frame.depth_m[pixel];
      // The point's place times 1 / depth, which is 0 for sky.
      const Eigen::Vector3d seen = from_far * Eigen::Vector3d(x, y, 1) + from_near / here_m;
      const double there_m = seen.z() * here_m;
      const bool known = seen.z() > 0 && (std::isinf(here_m) || there_m >= kNear);
      const Eigen::Vector2d moved = seen.head<2>() / seen.z() - Eigen::Vector2d(x, y);
      flow[pixel * 2] = known ? static_cast<float>(moved.x()) : kUnknown;
      flow[pixel * 2 + 1] = known ? static_cast<float>(moved.y()) : kUnknown;
      if (depth_m != nullptr) (*depth_m)[pixel] = known ? static_cast<float>(there_m) : kUnknown;
    }
  }
}

std::vector<float> compute_scene_flow(const Frame& frame, const camera::Camera& next) {
  std::vector<float> motion_m(frame.id.size() * 3, kUnknown);
  std::size_t pixel = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x, ++pixel) {
      if (std::isinf(frame.depth_m[pixel]) || std::isnan(frame.flow[pixel * 2])) continue;
      Eigen::Map<Eigen::Vector3f> motion(&motion_m[pixel * 3]);
      if (!is_posed(frame.id[pixel]) && !is_drone(frame.id[pixel])) {
        motion.setZero();
        continue;
      }
      const Eigen::Vector2d here(x, y);
      const Eigen::Vector2d moved(frame.flow[pixel * 2], frame.flow[pixel * 2 + 1]);
      const Eigen::Vector3d from =
          frame.camera.unproject(here, static_cast<double>(frame.depth_m[pixel]));
      const Eigen::Vector3d to =
          next.unproject(here + moved, static_cast<double>(frame.flow_depth_m[pixel]));
      motion = (to - from).cast<float>();
    }
  }
  return motion_m;
}

}  // namespace throng::render
