#include "render/lens/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/compute/srgb.h"
#include "base/error.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStillPx = 0.25;
constexpr int kMaxSamples = 15;
constexpr double kStripMotionPx = 0.5;
constexpr int kMaxStrips = 32;

double moved_px(const camera::Camera& before, const Vector3d& point_before,
                const camera::Camera& after, const Vector3d& point_after) {
  const camera::Camera::Projection a = before.project(point_before);
  const camera::Camera::Projection b = after.project(point_after);
  const camera::Intrinsics& k = before.intrinsics;
  const Eigen::AlignedBox2d image(Vector2d(0, 0), Vector2d(k.width, k.height));
  if (!a.visible || !b.visible || !(image.contains(a.pixel) || image.contains(b.pixel))) return 0;
  return (a.pixel - b.pixel).norm();
}

/// Ground point seen by a pixel, or, above the horizon, a far point.
std::optional<Vector3d> far_point(const camera::Camera& camera, const Vector2d& pixel) {
  constexpr double kFarM = 300;
  const Vector3d center = camera.pose.center();
  const Vector3d ray = camera.unproject(pixel, 1) - center;
  if (ray.hasNaN()) return std::nullopt;
  const double to_ground = -center.z() / ray.z();
  return center + ray * (to_ground > 0 ? std::min(to_ground, kFarM) : kFarM);
}

double camera_motion_px(const camera::Camera& before, const camera::Camera& after) {
  constexpr int kSteps = 4;
  const camera::Intrinsics& k = before.intrinsics;
  double max_motion_px = 0;
  for (int row = 0; row <= kSteps; ++row) {
    for (int column = 0; column <= kSteps; ++column) {
      const Vector2d pixel((k.width - 1.0) * column / kSteps, (k.height - 1.0) * row / kSteps);
      const std::optional<Vector3d> point = far_point(before, pixel);
      if (point) max_motion_px = std::max(max_motion_px, moved_px(before, *point, after, *point));
    }
  }
  return max_motion_px;
}

/// An odd number, so that one sample is in the middle.
int samples_for(double motion_px) {
  if (motion_px < kStillPx) return 1;
  const int wanted = std::max(3, static_cast<int>(std::ceil(motion_px)));
  return std::min(wanted + 1 - wanted % 2, kMaxSamples);
}

int strips_for(double motion_px, int rows) {
  if (motion_px < kStillPx) return 1;
  const int wanted = static_cast<int>(std::ceil(std::min(motion_px, 1e3) / kStripMotionPx));
  return std::min({wanted, kMaxStrips, rows});
}

/// How far beside the image people are measured in each strip, because another strip may show them.
/// Bodies may be much nearer to the camera than the places whose motion is known.
int find_margin(double motion_px, const camera::Intrinsics& image) {
  constexpr double kNearer = 4;
  return std::min(static_cast<int>(std::ceil(std::min(kNearer * motion_px, 1e6))), image.width / 2);
}

double motion_during(const MomentAt& moment_at, double time_s, double duration_s) {
  if (duration_s <= 0) return 0;
  return image_motion_px(moment_at(time_s - duration_s / 2), moment_at(time_s + duration_s / 2));
}

/// Positions of people, by agent.
std::unordered_map<std::uint32_t, Vector3d> person_positions(const Scene& scene) {
  std::unordered_map<std::uint32_t, Vector3d> places;
  for (const PersonInstance& person : scene.people) {
    places[person.agent] = person.position.cast<double>();
  }
  return places;
}

/// Sets how far everybody's middle, at half of the standing height, moves in the image meanwhile.
void set_blur(const ShutterMoment& open, const ShutterMoment& closed, Frame& frame) {
  const auto before = person_positions(*open.scene);
  const auto after = person_positions(*closed.scene);
  for (PersonInView& person : frame.people) {
    const auto first = before.find(person.agent);
    const auto last = after.find(person.agent);
    if (first == before.end() || last == after.end()) continue;
    const Vector3d half(0, 0, person.stature_m / 2);
    const camera::Camera::Projection from = open.camera.project(first->second + half);
    const camera::Camera::Projection to = closed.camera.project(last->second + half);
    if (from.visible && to.visible) person.blur_px = (to.pixel - from.pixel).norm();
  }
}

/// Sets everybody's actions at the time of the frame, which are the same in all cameras: strips are
/// of other times, some before the first step of the run.
void set_actions(const Scene& scene, std::vector<PersonInView>& people) {
  std::unordered_map<std::uint32_t, skinning::Actions> actions;
  for (const PersonInstance& person : scene.people) actions[person.agent] = person.actions;
  for (PersonInView& person : people) {
    const auto known = actions.find(person.agent);
    if (known != actions.end()) person.actions = known->second;
  }
}

NeighborTimes shifted(NeighborTimes times, double by_s) {
  for (std::optional<double>* time_s : {&times.next_s, &times.previous_s}) {
    if (*time_s) **time_s += by_s;
  }
  return times;
}

/// A part of an exposure.
struct Strip {
  double time_s = 0;
  int samples = 1;
  Rows rows;
  NeighborTimes neighbors;
  int margin_px = 0;  ///< of people beside the image, whom other strips may show
};

/// A strip of rows: the middle moment's everything, with the colors of all moments.
Frame exposed_strip(Lens& lens, const MomentAt& moment_at, double exposure_s, double gain,
                    const Strip& part) {
  std::vector<float> light;
  Frame strip;
  for (int i = 0; i < part.samples; ++i) {
    const bool middle = 2 * i + 1 == part.samples;
    // The middles of equal parts of the exposure; the middle one's share is exactly 0.
    const double offset_s = exposure_s * (2 * i + 1 - part.samples) / (2.0 * part.samples);
    const ShutterMoment moment = moment_at(part.time_s + offset_s);
    const auto neighbor_at = [&](const std::optional<double>& other_s) {
      if (!middle || !other_s) return std::optional<NeighborFrame>();
      const ShutterMoment other = moment_at(*other_s);
      return std::optional(NeighborFrame{*other.scene, other.camera});
    };
    const std::optional<NeighborFrame> next = neighbor_at(part.neighbors.next_s);
    const std::optional<NeighborFrame> previous = neighbor_at(part.neighbors.previous_s);
    Frame frame = lens.draw_rows(*moment.scene, moment.camera, part.rows, next ? &*next : nullptr,
                                 {.margin_px = part.margin_px,
                                  .truth = middle,
                                  .previous = previous ? &*previous : nullptr,
                                  .exposure_gain = gain});
    if (part.samples == 1) return frame;
    light.resize(frame.rgb.size());
    for (std::size_t j = 0; j < light.size(); ++j) light[j] += linear_from_srgb(frame.rgb[j]);
    if (middle) {
      strip = std::move(frame);
    } else {
      lens.recycle(std::move(frame));
    }
  }
  for (std::size_t j = 0; j < light.size(); ++j) {
    strip.rgb[j] = srgb_from_linear(light[j] / static_cast<float>(part.samples));
  }
  return strip;
}

template <typename Value>
void append(std::vector<Value>& to, const std::vector<Value>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// People of strips put together.
class PeopleInStrips {
 public:
  void add(const Frame& strip, const Rows& rows) {
    for (const PersonInView& person : strip.people) {
      Known& known = people_[person.agent];
      const std::uint64_t area_px = person.amodal_area_px;
      if (known.strips == 0 || area_px > known.largest_px) {
        known.person = person;
        known.largest_px = area_px;
      }
      ++known.strips;
      known.area_px += area_px;
      known.box.extend(person.amodal_box);
      if (person.whole_mask != nullptr) {
        known.whole = unite_masks(known.whole, *person.whole_mask);
      }
      see_head(strip.camera, person, rows, known);
      see_keypoints(strip.camera, person, rows, known);
    }
  }

  /// People who reach into the image in some strip.
  std::vector<PersonInView> take(const Eigen::AlignedBox2d& image) const {
    std::vector<PersonInView> people;
    for (const auto& [agent, known] : people_) {
      if (!known.box.intersects(image)) continue;
      people.push_back(known.person);
      people.back().amodal_box = known.box;
      people.back().amodal_area_px = known.area_px;
      people.back().head_px = known.head_px;
      people.back().head_box = known.head_box;
      people.back().keypoints_px = known.keypoints_px;
      if (known.person.whole_mask != nullptr) {
        people.back().whole_mask = std::make_shared<PixelMask>(known.whole);
      }
    }
    return people;
  }

 private:
  struct Known {
    PersonInView person;  ///< in the strip that has most of them
    std::uint64_t largest_px = 0;
    int strips = 0;
    std::uint64_t area_px = 0;
    Eigen::AlignedBox2d box;
    PixelMask whole;
    std::optional<Vector2d> head_px;
    Eigen::AlignedBox2d head_box;
    double head_off_rows = std::numeric_limits<double>::infinity();
    skinning::Keypoints keypoints_px =
        skinning::keypoints_at(Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
    std::array<float, skinning::kJointCount> keypoints_off_rows{};
    Known() { keypoints_off_rows.fill(std::numeric_limits<float>::infinity()); }
  };

  /// Keeps the sight of the head from the strip whose rows it is in, or nearest to.
  static void see_head(const camera::Camera& camera, const PersonInView& person, const Rows& rows,
                       Known& known) {
    const camera::Camera::Projection seen = camera.project(person.head);
    if (!seen.visible) return;
    const Vector2d at = seen.pixel.array() + 0.5;
    const double off = std::max({rows.first - at.y(), at.y() - rows.end, 0.0});
    if (off >= known.head_off_rows) return;
    known.head_off_rows = off;
    known.head_px = at;
    known.head_box = person.head_box;
  }

  /// The same for each keypoint.
  static void see_keypoints(const camera::Camera& camera, const PersonInView& person,
                            const Rows& rows, Known& known) {
    const skinning::Keypoints seen = keypoints_in(person, camera);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i].allFinite()) continue;
      const float y = seen[i].y();
      const float off =
          std::max({static_cast<float>(rows.first) - y, y - static_cast<float>(rows.end), 0.0F});
      if (off >= known.keypoints_off_rows[i]) continue;
      known.keypoints_off_rows[i] = off;
      known.keypoints_px[i] = seen[i];
    }
  }

  std::map<std::uint32_t, Known> people_;
};

/// Drones and vehicles of strips put together.
class ObjectsInStrips {
 public:
  void add(const Frame& strip) {
    for (const ObjectInView& object : strip.objects) {
      const auto [entry, is_new] = objects_.try_emplace(object.id, Known{object, 0});
      Known& known = entry->second;
      if (is_new) {
        known.largest_px = object.amodal_area_px;
        continue;
      }
      ObjectInView sum = object.amodal_area_px > known.largest_px ? object : known.object;
      known.largest_px = std::max(known.largest_px, object.amodal_area_px);
      sum.amodal_area_px = known.object.amodal_area_px + object.amodal_area_px;
      sum.amodal_box = known.object.amodal_box.merged(object.amodal_box);
      sum.whole_mask =
          std::make_shared<PixelMask>(unite_masks(*known.object.whole_mask, *object.whole_mask));
      known.object = std::move(sum);
    }
  }

  /// Objects that reach into the image in some strip.
  std::vector<ObjectInView> take(const Eigen::AlignedBox2d& image) const {
    std::vector<ObjectInView> objects;
    for (const auto& [id, known] : objects_) {
      if (known.object.amodal_box.intersects(image)) objects.push_back(known.object);
    }
    return objects;
  }

 private:
  struct Known {
    ObjectInView object;  ///< in the strip that has most of it
    std::uint64_t largest_px = 0;
  };
  std::map<std::uint32_t, Known> objects_;
};

}  // namespace

double image_motion_px(const ShutterMoment& from, const ShutterMoment& to) {
  double max_motion_px = camera_motion_px(from.camera, to.camera);
  std::unordered_map<std::uint32_t, const PersonInstance*> later;
  for (const PersonInstance& person : to.scene->people) later[person.agent] = &person;
  for (const PersonInstance& person : from.scene->people) {
    const auto found = later.find(person.agent);
    if (found == later.end()) continue;
    max_motion_px =
        std::max(max_motion_px, moved_px(from.camera, person.position.cast<double>(), to.camera,
                                         found->second->position.cast<double>()));
  }
  for (const DroneInstance& drone : from.scene->drones) {
    if (carries(drone, from.camera.pose.center())) continue;
    for (const DroneInstance& after : to.scene->drones) {
      if (after.drone != drone.drone) continue;
      max_motion_px =
          std::max(max_motion_px, moved_px(from.camera, drone.position, to.camera, after.position));
    }
  }
  return max_motion_px;
}

void interlace(const Frame& field, Frame& frame) {
  check(field.rgb.size() == frame.rgb.size(), "fields are of one size");
  const auto row_bytes = static_cast<std::ptrdiff_t>(3) * frame.width();
  for (std::ptrdiff_t row = 1; row < frame.height(); row += 2) {
    std::copy_n(field.rgb.begin() + row * row_bytes, row_bytes,
                frame.rgb.begin() + row * row_bytes);
  }
}

Exposed expose(Lens& lens, const MomentAt& moment_at, double time_s,
               const camera::Exposure& exposure, const NeighborTimes& neighbors, bool is_metered) {
  check(exposure.exposure_s >= 0 && exposure.readout_s >= 0, "time runs forwards");
  Exposed exposed;
  exposed.illuminance_lux = lens.renderer().illuminance_lux();
  const ShutterMoment now = moment_at(time_s);
  const camera::Camera& camera = now.camera;
  if (is_metered) exposed.gain = lens.renderer().metered_gain(*now.scene, camera);
  std::optional<ShutterMoment> open;
  std::optional<ShutterMoment> closed;
  if (exposure.exposure_s > 0) {
    open = moment_at(time_s - exposure.exposure_s / 2);
    closed = moment_at(time_s + exposure.exposure_s / 2);
    exposed.blur_px = image_motion_px(*open, *closed);
  }
  exposed.samples = samples_for(exposed.blur_px);
  const int height = camera.intrinsics.height;
  const double motion_px = motion_during(moment_at, time_s, exposure.readout_s);
  const int strips = strips_for(motion_px, height);
  const int strip_rows = (height + strips - 1) / strips;
  Frame& frame = exposed.frame;
  PeopleInStrips people;
  ObjectsInStrips objects;
  exposed.strips = 0;
  for (int first = 0; first < height; first += strip_rows, ++exposed.strips) {
    const Rows rows{first, std::min(first + strip_rows, height)};
    const double middle_row = 0.5 * (rows.first + rows.end - height);
    const double strip_s = strips == 1 ? time_s : time_s + exposure.readout_s * middle_row / height;
    Frame strip =
        exposed_strip(lens, moment_at, exposure.exposure_s, exposed.gain,
                      {strip_s, exposed.samples, rows, shifted(neighbors, strip_s - time_s),
                       strips == 1 ? 0 : find_margin(motion_px, camera.intrinsics)});
    if (strips == 1) {
      frame = std::move(strip);
      frame.time_s = time_s;
      exposed.strips = 1;
      break;
    }
    people.add(strip, rows);
    objects.add(strip);
    frame.index = strip.index;
    append(frame.rgb, strip.rgb);
    append(frame.id, strip.id);
    append(frame.depth_m, strip.depth_m);
    append(frame.normal, strip.normal);
    append(frame.flow, strip.flow);
    append(frame.flow_backward, strip.flow_backward);
    append(frame.flow_depth_m, strip.flow_depth_m);
    append(frame.scene_flow_m, strip.scene_flow_m);
    append(frame.hazard_opacity, strip.hazard_opacity);
    append(frame.part, strip.part);
    append(frame.surface, strip.surface);
  }
  if (strips > 1) {
    frame.time_s = time_s;
    frame.camera = camera;
    const Eigen::AlignedBox2d image(Vector2d(0, 0), Vector2d(camera.intrinsics.width, height));
    frame.people = people.take(image);
    set_actions(*now.scene, frame.people);
    frame.objects = objects.take(image);
  }
  if (open && closed) set_blur(*open, *closed, frame);
  return exposed;
}

}  // namespace throng::render
