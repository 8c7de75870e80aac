#include "render/truth/objects_in_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "base/geometry/polygon.h"
#include "render/frame/view.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float kUnknownFlow = std::numeric_limits<float>::quiet_NaN();

/// A triangle in the image, in box coordinates.
using Corners = std::array<Vector2d, 3>;

/// Splits triangles until their edges are straight in the image and in front of the camera.
class PropProjector {
 public:
  explicit PropProjector(const camera::Camera& camera)
      : camera_(&camera),
        is_straight_(!camera.intrinsics.distortion),
        around_(Vector2d(-camera.intrinsics.width, -camera.intrinsics.height),
                Vector2d(2 * camera.intrinsics.width, 2 * camera.intrinsics.height)) {}

  void add(const std::array<Vector3d, 3>& corners, int splits = 0) {
    Corners pixels;
    int seen = 0;
    double max_depth_m = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const camera::Camera::Projection place = camera_->project(corners[i]);
      max_depth_m = std::max(max_depth_m, place.depth_m);
      if (!place.visible || place.depth_m < static_cast<double>(kNear)) continue;
      pixels[i] = place.pixel.array() + 0.5;
      ++seen;
    }
    if (max_depth_m < static_cast<double>(kNear)) return;
    if (seen == 3 && (is_straight_ || splits == kMaxSplits || is_fine(pixels))) {
      triangles_.push_back(pixels);
      for (const Vector2d& pixel : pixels) box_.extend(pixel);
      return;
    }
    // Triangles that the camera sees in part are split down to the cut; of others only large ones
    // may still reach into the image.
    const double edge_m = max_edge(corners);
    if (splits == kMaxSplits || (seen < 3 && edge_m < (seen > 0 ? kCutM : kReachM))) return;
    split(corners, splits);
  }

  const std::vector<Corners>& triangles() const { return triangles_; }
  const Eigen::AlignedBox2d& box() const { return box_; }

 private:
  static constexpr double kStraightPx = 16;
  static constexpr double kCutM = 0.05;
  static constexpr double kReachM = 1;
  static constexpr int kMaxSplits = 24;

  template <typename Points>
  static double max_edge(const Points& corners) {
    return std::max({(corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(),
                     (corners[0] - corners[2]).norm()});
  }

  /// Whether splitting would change nothing in or around the image.
  bool is_fine(const Corners& pixels) const {
    Eigen::AlignedBox2d box;
    for (const Vector2d& pixel : pixels) box.extend(pixel);
    return max_edge(pixels) < kStraightPx || !box.intersects(around_);
  }

  /// In two, at the middle of the longest edge.
  void split(const std::array<Vector3d, 3>& corners, int splits) {
    std::size_t first = 0;
    double max_edge_m = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double edge_m = (corners[(i + 1) % 3] - corners[i]).norm();
      if (edge_m > max_edge_m) first = i;
      max_edge_m = std::max(max_edge_m, edge_m);
    }
    const Vector3d& a = corners[first];
    const Vector3d& b = corners[(first + 1) % 3];
    const Vector3d& c = corners[(first + 2) % 3];
    const Vector3d middle = (a + b) / 2;
    add({a, middle, c}, splits + 1);
    add({middle, b, c}, splits + 1);
  }

  const camera::Camera* camera_;
  bool is_straight_;
  Eigen::AlignedBox2d around_;
  std::vector<Corners> triangles_;
  Eigen::AlignedBox2d box_;
};

PropProjector projected(const PropMesh& mesh, const camera::Camera& camera) {
  PropProjector projector(camera);
  const auto at = [&](std::size_t index) -> Vector3d {
    return Eigen::Map<const Eigen::Vector3f>(mesh.vertices[index].position.data()).cast<double>();
  };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    projector.add({at(mesh.indices[i]), at(mesh.indices[i + 1]), at(mesh.indices[i + 2])});
  }
  return projector;
}

/// Sets the pixels whose middles are in the triangle or on its edges.
void fill(const Corners& corners, PixelMask& mask) {
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

/// Pixels covered by an object in a part of the image.
PixelMask covered(const PropProjector& seen, const Eigen::AlignedBox2i& domain) {
  const Vector2d far(1e6, 1e6);
  const Vector2d low = seen.box().min().cwiseMax(-far);
  const Vector2d high = seen.box().max().cwiseMin(far);
  PixelMask mask(domain.intersection(Eigen::AlignedBox2i(low.array().floor().cast<int>() - 1,
                                                         high.array().ceil().cast<int>() + 1)));
  if (mask.set.empty()) return mask;
  for (const Corners& corners : seen.triangles()) fill(corners, mask);
  return mask;
}

/// Adds the pixels that show the object.
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

/// The upright box around the mesh, turned as the object heads.
void set_box(const PropMesh& mesh, ObjectInView& object) {
  const Eigen::AngleAxisd back(-object.yaw_rad, Vector3d::UnitZ());
  Eigen::AlignedBox3d box;
  for (const PropVertex& vertex : mesh.vertices) {
    const Eigen::Map<const Eigen::Vector3f> at(vertex.position.data());
    box.extend(Vector3d(back * (at.cast<double>() - object.position)));
  }
  object.box_middle = object.position + back.inverse() * box.center();
  object.box_size = box.sizes();
}

/// Measures an object, whose id, place and heading are known; false if no pixel of it would be
/// where it is measured.
bool measure_object(const PropMesh& mesh, const Rows& rows, const Frame& frame,
                    ObjectInView& object) {
  const Eigen::AlignedBox2d image(Vector2d(0, 0), Vector2d(frame.width(), rows.end));
  const Eigen::AlignedBox2i measured = measured_pixels(frame.camera.intrinsics, rows);
  const bool is_whole = rows.are_all(frame.camera.intrinsics);
  const PropProjector seen = projected(mesh, frame.camera);
  const Eigen::AlignedBox2d wanted = is_whole ? image : measured.cast<double>();
  if (seen.box().isEmpty() || !seen.box().intersects(wanted)) return false;
  PixelMask mask = covered(seen, measured);
  add_shown(frame, object.id, rows, mask);
  Eigen::AlignedBox2d bounds;
  object.amodal_area_px = measure(mask, bounds);
  if (object.amodal_area_px == 0) return false;
  object.amodal_box = is_whole ? seen.box() : bounds;
  object.whole_mask = std::make_shared<PixelMask>(inside(mask, frame));
  set_box(mesh, object);
  return true;
}

}  // namespace

void measure_objects(const Scene& scene, std::span<const Vehicle> vehicles, const Rows& rows,
                     Frame& frame) {
  frame.objects.clear();
  for (std::uint32_t i = 0; i < vehicles.size(); ++i) {
    const Vehicle& vehicle = vehicles[i];
    ObjectInView object;
    object.id = vehicle.id;
    object.number = i;
    object.surface = vehicle.surface;
    object.position = vehicle.position;
    object.yaw_rad = vehicle.yaw_rad;
    object.orientation = Eigen::AngleAxisd(vehicle.yaw_rad, Vector3d::UnitZ());
    if (measure_object(vehicle.mesh, rows, frame, object)) {
      frame.objects.push_back(std::move(object));
    }
  }
  const Vector3d eye = frame.camera.pose.center();
  for (const DroneInstance& instance : scene.drones) {
    if (carries(instance, eye)) continue;
    ObjectInView object;
    object.id = kIdDrone + instance.drone;
    object.number = instance.drone;
    object.position = instance.position;
    object.velocity = instance.velocity;
    object.orientation = instance.orientation;
    const Vector3d ahead = instance.orientation * Vector3d::UnitX();
    object.yaw_rad = std::atan2(ahead.y(), ahead.x());
    if (measure_object(airframe_mesh(instance), rows, frame, object)) {
      frame.objects.push_back(std::move(object));
    }
  }
}

void fill_drone_flow(const Scene& scene, const NeighborFrame& other, const Frame& frame,
                     std::vector<float>& flow, std::vector<float>* depth_m) {
  if (scene.drones.empty()) return;
  // From the world now to the world then, as seen from each drone.
  std::map<std::uint32_t, Eigen::Isometry3d> motion;
  for (const DroneInstance& before : scene.drones) {
    for (const DroneInstance& after : other.scene.drones) {
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
      const auto there = other.camera.project(found == motion.end() ? here : found->second * here);
      const bool is_known = found != motion.end() && there.visible;
      flow[pixel * 2] = is_known ? static_cast<float>(there.pixel.x() - x) : kUnknownFlow;
      flow[pixel * 2 + 1] = is_known ? static_cast<float>(there.pixel.y() - y) : kUnknownFlow;
      if (depth_m == nullptr) continue;
      (*depth_m)[pixel] = is_known ? static_cast<float>(there.depth_m) : kUnknownFlow;
    }
  }
}

}  // namespace throng::render
