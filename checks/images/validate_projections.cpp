// Bodies in the world against the image: box_3d, keypoints_3d and position, as the camera sees
// them.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "annotate/people/person_record.h"
#include "checks/body_slack.h"
#include "checks/findings.h"
#include "formats/dataset/image_camera.h"
#include "formats/files/json_vectors.h"

namespace throng::checks {

namespace {

/// The upright box holds the body: as seen by the camera, it holds the box in the image, and its
/// middle lies in that. Of people who reach behind the near plane, the image's box is that of a
/// part; close to it a millimeter, to which the box is written, is many pixels.
void check_projection(const formats::Image& image, const formats::Person& person, double shutter_px,
                      Findings& findings) {
  const Eigen::Matrix<double, 3, 8> in_camera = corners_in_camera(image, person);
  if (!(in_camera.row(2).maxCoeff() > camera::kNearPlaneM)) {
    findings.add("box-3d", person, "box_3d is behind the camera");
    return;
  }
  constexpr double kCloseM = 0.1;
  if (!(in_camera.row(2).minCoeff() > kCloseM)) return;
  const Eigen::Matrix<double, 3, 8> corners = image.camera_matrix * in_camera;
  const Eigen::Vector2d middle = formats::in_amodal_limit(
      image, Eigen::Vector3d(corners.rowwise().mean()).hnormalized().array() + 0.5);
  const double slack_px = kBoxSlackPx + shutter_px;
  if (!holds(person.amodal, middle.x(), middle.y(), slack_px)) {
    findings.add("box-3d", person, "the middle of box_3d does not project into bbox_amodal");
    return;
  }
  const Eigen::Matrix<double, 2, 8> seen = corners.colwise().hnormalized().array() + 0.5;
  const Eigen::Vector2d first = seen.rowwise().minCoeff();
  const Eigen::Vector2d size = seen.rowwise().maxCoeff() - first;
  const formats::Box outer{first.x(), first.y(), size.x(), size.y()};
  const formats::Box& box = person.amodal;
  if (!holds(outer, box.x, box.y, slack_px) ||
      !holds(outer, box.x + box.width, box.y + box.height, slack_px)) {
    findings.add("box-3d", person, "bbox_amodal leaves what box_3d projects to");
  }
}

/// The whole body's box holds its keypoints, also those outside of the image.
void check_keypoints_in_box(const formats::Image& image, const camera::Camera& camera,
                            const formats::Person& person, double shutter_px, Findings& findings) {
  const auto places = person.record.find("keypoints_3d");
  if (places == person.record.end()) return;
  const double slack_px = keypoint_slack_px(camera, person) + shutter_px;
  const formats::Box& box = person.amodal;
  for (std::size_t i = 0; i < places->size(); ++i) {
    const auto seen = camera.project(formats::numbers_at<3>(places->at(i)));
    constexpr double kNearM = 0.3;
    if (!seen.visible || seen.depth_m < kNearM) continue;
    const Eigen::Vector2d at = formats::in_amodal_limit(image, seen.pixel.array() + 0.5);
    if (holds(box, at.x(), at.y(), slack_px)) continue;
    findings.add("keypoints", person,
                 fmt::format("keypoint {} is seen at ({:.1f}, {:.1f}), outside of bbox_amodal",
                             i + 1, at.x(), at.y()));
    return;
  }
}

/// Keypoints in the image are those in the world, seen by the camera.
void check_keypoints_3d(const camera::Camera& camera, const formats::Person& person,
                        Findings& findings) {
  const auto places = person.record.find("keypoints_3d");
  if (places == person.record.end()) return;
  for (std::size_t i = 0; i < person.keypoints.size(); ++i) {
    const formats::Keypoint& point = person.keypoints[i];
    if (point.visibility == 0) continue;
    const nlohmann::json& at = places->at(i);
    const auto seen =
        camera.project({at.at(0).get<double>(), at.at(1).get<double>(), at.at(2).get<double>()});
    // Places are written to a millimeter, pixels to a hundredth; the truth is in float.
    const double slack =
        0.03 + 2e-3 * camera.intrinsics.fx_px / std::max(seen.depth_m, camera::kNearPlaneM);
    if (seen.visible &&
        std::hypot(seen.pixel.x() + 0.5 - point.x, seen.pixel.y() + 0.5 - point.y) <= slack) {
      continue;
    }
    findings.add("keypoints", person,
                 fmt::format("keypoint {} is not where keypoints_3d is seen", i + 1));
    return;
  }
}

void check_state(const formats::Person& person, Findings& findings) {
  const std::vector<std::string> states = formats::class_values("state");
  if (!person.state.empty() &&
      std::find(states.begin(), states.end(), person.state) == states.end()) {
    findings.add("state", person, "a state that nobody can be in: " + person.state);
  }
}

void check_truncation(const formats::Image& image, const formats::Person& person,
                      Findings& findings) {
  const formats::Box& box = person.amodal;
  const Eigen::AlignedBox2d bounds(Eigen::Vector2d(box.x, box.y),
                                   Eigen::Vector2d(box.x + box.width, box.y + box.height));
  camera::Intrinsics size;
  size.width = image.width;
  size.height = image.height;
  constexpr double kRounding = 0.01;  // of boxes a few pixels small
  const double expected = annotate::measure_truncation(bounds, size);
  if (!(std::abs(person.truncation - expected) <= kRounding)) {
    findings.add(
        "truncation", person,
        fmt::format("truncation {}, but bbox_amodal says {:.4f}", person.truncation, expected));
  }
}

/// Somebody's place on the ground is below their body, or beside it when they lie.
void check_position(const formats::Person& person, Findings& findings) {
  constexpr double kReachM = 1.6;
  if (!((person.position - person.box_middle).head<2>().norm() <= kReachM)) {
    findings.add("position", person, "position is away from box_3d");
  }
  // Bodies stand or lie on the ground; runners leave it by a few centimeters.
  constexpr double kFlightM = 0.15;
  const double above_m = person.box_middle.z() - person.box_size.z() / 2 - person.position.z();
  if (person.track->contains("attributes") && !(std::abs(above_m) <= kFlightM)) {
    findings.add(
        "position", person,
        fmt::format("box_3d begins {:.2f} m above position, which is on the ground", above_m));
  }
}

}  // namespace

Eigen::Matrix<double, 3, 8> corners_in_camera(const formats::Image& image,
                                              const formats::Person& person) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(person.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  constexpr double kRoundingM = 0.02;  // of the box's middle and size, on both sides
  const Eigen::Vector3d size = person.box_size.array() + kRoundingM;
  Eigen::Matrix<double, 3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d side((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5,
                               (i & 4) != 0 ? 0.5 : -0.5);
    corners.col(i) = image.R * (person.box_middle + turn * side.cwiseProduct(size)) + image.t;
  }
  return corners;
}

void check_bodies(const formats::Image& image, Findings& findings) {
  const std::optional<double> shutter_px = shutter_slack_px(image);
  const bool pinhole = is_pinhole(image);
  const bool at_once = is_shot_at_once(image);
  const camera::Camera camera = formats::image_camera(image);
  for (const formats::Person& person : list_objects(image)) {
    check_position(person, findings);
    check_state(person, findings);
    check_truncation(image, person, findings);
    if (shutter_px && pinhole) check_projection(image, person, *shutter_px, findings);
    if (shutter_px) check_keypoints_in_box(image, camera, person, *shutter_px, findings);
    if (at_once) check_keypoints_3d(camera, person, findings);
  }
}

bool is_pinhole(const formats::Image& image) {
  return image.record.at("camera").value("model", "pinhole") == "pinhole";
}

bool is_plain(const formats::Image& image) { return is_pinhole(image) && is_shot_at_once(image); }

bool is_shot_at_once(const formats::Image& image) {
  const auto sensor = image.record.find("sensor");
  return sensor == image.record.end() || sensor->value("strips", 1) == 1;
}

std::optional<double> shutter_slack_px(const formats::Image& image) {
  if (is_shot_at_once(image)) return 0;
  // How far keypoints in the image are from where its camera sees them: the motion of the rows
  // until then, of people at all distances.
  const camera::Camera camera = formats::image_camera(image);
  std::size_t count = 0;
  double max_off_px = 0;
  for (const formats::Person& person : image.people) {
    const auto places = person.record.find("keypoints_3d");
    if (places == person.record.end()) continue;
    for (std::size_t i = 0; i < person.keypoints.size(); ++i) {
      const formats::Keypoint& point = person.keypoints[i];
      const auto seen = camera.project(formats::numbers_at<3>(places->at(i)));
      if (point.visibility == 0 || !seen.visible) continue;
      ++count;
      max_off_px =
          std::max(max_off_px, (Eigen::Vector2d(point.x - 0.5, point.y - 0.5) - seen.pixel).norm());
    }
  }
  constexpr std::size_t kMinCount = 50;  // of three people and more
  if (count < kMinCount) return std::nullopt;
  constexpr double kBeyond = 1.5;  // of people beside the image
  constexpr double kStripPx = 1;
  return kBeyond * max_off_px + kStripPx;
}

}  // namespace throng::checks
