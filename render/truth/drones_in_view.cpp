#include "render/truth/drones_in_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "geometry/polygon.h"
#include "render/view.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float kUnknownFlow = std::numeric_limits<float>::quiet_NaN();

/// A mesh in the image: its vertices in box coordinates, NaN where the camera sees nothing.
struct Projected {
  std::vector<Vector2d> vertices;
  Eigen::AlignedBox2d box;
  bool is_cut = false;  ///< some vertices are nowhere in the image
};

Projected projected(const PropMesh& mesh, const camera::Camera& camera) {
  Projected seen;
  seen.vertices.reserve(mesh.vertices.size());
  for (const PropVertex& vertex : mesh.vertices) {
    const Eigen::Map<const Eigen::Vector3f> at(vertex.position.data());
    const camera::Camera::Projection place = camera.project(at.cast<double>());
    const bool is_seen = place.visible && place.depth_m >= static_cast<double>(kNear);
    seen.vertices.emplace_back(is_seen ? Vector2d(place.pixel.array() + 0.5)
                                       : Vector2d::Constant(std::nan("")));
    if (is_seen) seen.box.extend(seen.vertices.back());
    seen.is_cut = seen.is_cut || !is_seen;
  }
  return seen;
}

/// Sets the pixels whose middles are in the triangle or on its edges.
void fill(const std::array<Vector2d, 3>& corners, PixelMask& mask) {
  const auto [a, b, c] = corners;
  const double twice_area = geometry::cross(b - a, c - a);
  if (!(twice_area != 0)) return;
  Eigen::AlignedBox2d box(a);
  box.extend(b);
  box.extend(c);
  const Eigen::AlignedBox2i pixels = mask.pixels.intersection(Eigen::AlignedBox2i(
      box.min().array().floor().cast<int>(), box.max().array().ceil().cast<int>()));
  const double sign = twice_area > 0 ? 1 : -1;
  const auto is_inside = [&](const Vector2d& from, const Vector2d& to, const Vector2d& point) {
    return sign * geometry::cross(to - from, point - from) >= 0;
  };
  for (int y = pixels.min().y(); y < pixels.max().y(); ++y) {
    for (int x = pixels.min().x(); x < pixels.max().x(); ++x) {
      const Vector2d middle(x + 0.5, y + 0.5);
      if (is_inside(a, b, middle) && is_inside(b, c, middle) && is_inside(c, a, middle)) {
        mask.put(x, y);
      }
    }
  }
}

/// Pixels covered by a drone in these rows and, at the image's borders, beyond them.
PixelMask covered(const PropMesh& mesh, const Projected& seen, const Rows& rows,
                  const Frame& frame) {
  const int width = frame.width();
  const int height = frame.camera.intrinsics.height;
  const Eigen::AlignedBox2i domain(
      Eigen::Vector2i(-width, rows.first == 0 ? -height : rows.first),
      Eigen::Vector2i(2 * width, rows.end == height ? 2 * height : rows.end));
  const Vector2d far(1e6, 1e6);
  const Vector2d low = seen.box.min().cwiseMax(-far);
  const Vector2d high = seen.box.max().cwiseMin(far);
  PixelMask mask(domain.intersection(Eigen::AlignedBox2i(low.array().floor().cast<int>() - 1,
                                                         high.array().ceil().cast<int>() + 1)));
  if (mask.set.empty()) return mask;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::array<Vector2d, 3> corners = {seen.vertices[mesh.indices[i]],
                                             seen.vertices[mesh.indices[i + 1]],
                                             seen.vertices[mesh.indices[i + 2]]};
    if (!(corners[0] + corners[1] + corners[2]).hasNaN()) fill(corners, mask);
  }
  return mask;
}

/// Adds the pixels that show the drone.
void add_shown(const Frame& frame, std::uint32_t id, const Rows& rows, PixelMask& mask) {
  for (int y = std::max(mask.pixels.min().y(), rows.first);
       y < std::min(mask.pixels.max().y(), rows.end); ++y) {
    for (int x = std::max(mask.pixels.min().x(), 0);
         x < std::min(mask.pixels.max().x(), frame.width()); ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y - rows.first) * static_cast<std::size_t>(frame.width()) +
          static_cast<std::size_t>(x);
      if (frame.id[pixel] == id) mask.put(x, y);
    }
  }
}

/// How many pixels are set, and their bounds.
std::uint64_t measure(const PixelMask& mask, Eigen::AlignedBox2d& bounds) {
  std::uint64_t area = 0;
  for (int y = mask.pixels.min().y(); y < mask.pixels.max().y(); ++y) {
    for (int x = mask.pixels.min().x(); x < mask.pixels.max().x(); ++x) {
      if (!mask.at(x, y)) continue;
      ++area;
      bounds.extend(Vector2d(x, y));
      bounds.extend(Vector2d(x + 1, y + 1));
    }
  }
  return area;
}

/// The part of a mask that is in the image.
PixelMask inside(const PixelMask& mask, const Frame& frame) {
  PixelMask part(mask.pixels.intersection(Eigen::AlignedBox2i(
      Eigen::Vector2i::Zero(), Eigen::Vector2i(frame.width(), frame.camera.intrinsics.height))));
  if (part.set.empty()) return part;
  for (int y = part.pixels.min().y(); y < part.pixels.max().y(); ++y) {
    for (int x = part.pixels.min().x(); x < part.pixels.max().x(); ++x) {
      if (mask.at(x, y)) part.put(x, y);
    }
  }
  return part;
}

/// The upright box around the mesh, turned as the drone heads.
void set_box(const PropMesh& mesh, DroneInView& drone) {
  const Eigen::AngleAxisd back(-drone.yaw_rad, Vector3d::UnitZ());
  Eigen::AlignedBox3d box;
  for (const PropVertex& vertex : mesh.vertices) {
    const Eigen::Map<const Eigen::Vector3f> at(vertex.position.data());
    box.extend(Vector3d(back * (at.cast<double>() - drone.position)));
  }
  drone.box_middle = drone.position + back.inverse() * box.center();
  drone.box_size = box.sizes();
}

}  // namespace

void measure_drones(const Scene& scene, const Rows& rows, Frame& frame) {
  frame.drones.clear();
  const Vector3d eye = frame.camera.pose.center();
  const bool is_whole = rows.first == 0 && rows.end == frame.camera.intrinsics.height;
  const Eigen::AlignedBox2d image(Vector2d(0, rows.first), Vector2d(frame.width(), rows.end));
  for (const DroneInstance& instance : scene.drones) {
    if (carries(instance, eye)) continue;
    const PropMesh mesh = airframe_mesh(instance);
    const Projected seen = projected(mesh, frame.camera);
    if (seen.box.isEmpty() || !seen.box.intersects(image)) continue;
    PixelMask mask = covered(mesh, seen, rows, frame);
    add_shown(frame, kIdDrone + instance.drone, rows, mask);
    Eigen::AlignedBox2d bounds;
    DroneInView drone;
    drone.amodal_area_px = measure(mask, bounds);
    if (drone.amodal_area_px == 0) continue;
    drone.drone = instance.drone;
    drone.position = instance.position;
    drone.velocity = instance.velocity;
    drone.orientation = instance.orientation;
    const Vector3d ahead = instance.orientation * Vector3d::UnitX();
    drone.yaw_rad = std::atan2(ahead.y(), ahead.x());
    drone.amodal_box = is_whole ? seen.box : bounds;
    if (is_whole && seen.is_cut) drone.amodal_box.extend(bounds);
    drone.whole_mask = std::make_shared<PixelMask>(inside(mask, frame));
    set_box(mesh, drone);
    frame.drones.push_back(std::move(drone));
  }
}

void fill_drone_flow(const Scene& scene, const NextFrame& next, Frame& frame) {
  if (scene.drones.empty()) return;
  // From the world now to the world then, as seen from each drone.
  std::map<std::uint32_t, Eigen::Isometry3d> motion;
  for (const DroneInstance& before : scene.drones) {
    for (const DroneInstance& after : next.scene.drones) {
      if (after.drone != before.drone) continue;
      motion[kIdDrone + before.drone] = Eigen::Translation3d(after.position) *
                                        (after.orientation * before.orientation.conjugate()) *
                                        Eigen::Translation3d(-before.position);
    }
  }
  std::size_t pixel = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x, ++pixel) {
      if (!is_drone(frame.id[pixel])) continue;
      const Vector3d here =
          frame.camera.unproject({x, y}, static_cast<double>(frame.depth_m[pixel]));
      const auto found = motion.find(frame.id[pixel]);
      const auto there = next.camera.project(found == motion.end() ? here : found->second * here);
      const bool is_known = found != motion.end() && there.visible;
      frame.flow[pixel * 2] = is_known ? static_cast<float>(there.pixel.x() - x) : kUnknownFlow;
      frame.flow[pixel * 2 + 1] = is_known ? static_cast<float>(there.pixel.y() - y) : kUnknownFlow;
    }
  }
}

}  // namespace throng::render
