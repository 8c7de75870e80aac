#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "annotate/people/person_record.h"
#include "base/error.h"
#include "formats/dataset/image_camera.h"
#include "formats/dataset/mask.h"
#include "formats/validate/findings.h"

namespace throng::formats {

namespace {

/// Boxes and areas of whole bodies come from another draw than masks: outlines may be off by less
/// than a pixel.
constexpr double kBoxSlackPx = 1;

bool holds(const Box& outer, double x, double y, double slack) {
  return x >= outer.x - slack && y >= outer.y - slack && x <= outer.x + outer.width + slack &&
         y <= outer.y + outer.height + slack;
}

/// False if there is no mask to look at.
bool check_mask(const Image& image, const Person& person, Findings& findings) {
  const auto pixels =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  const nlohmann::json& size = person.record.at("segmentation").at("size");
  if (size != nlohmann::json{image.height, image.width}) {
    findings.add("mask-size", person, "the mask's size is not the image's: " + size.dump());
    return false;
  }
  Bitmap mask;
  try {
    mask = decode_bitmap(decode_runs(person.mask, pixels), image.height);
  } catch (const InputError& error) {
    findings.add("mask-runs", person, error.problems().front().expected);
    return false;
  }
  const Box& box = person.box;
  if (mask.x != box.x || mask.y != box.y || mask.width != box.width || mask.height != box.height) {
    findings.add(
        "box-is-mask-bounds", person,
        fmt::format("bbox [{},{},{},{}], but the mask's bounds are [{},{},{},{}]", box.x, box.y,
                    box.width, box.height, mask.x, mask.y, mask.width, mask.height));
  }
  if (static_cast<double>(mask.area()) != person.area) {
    findings.add("area-is-mask", person,
                 fmt::format("area {}, but the mask has {} pixels", person.area, mask.area()));
  }
  return true;
}

/// The mask of the whole person, if there is one: it holds the visible one, and has as many pixels
/// as the person covers, unless some of these are outside of the image.
void check_whole_mask(const Image& image, const Person& person, Findings& findings) {
  const auto found = person.record.find("amodal_segmentation");
  if (found == person.record.end()) return;
  const auto pixels =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  Bitmap whole;
  try {
    whole =
        decode_bitmap(decode_runs(found->at("counts").get<std::string>(), pixels), image.height);
  } catch (const InputError& error) {
    findings.add("mask-runs", person, error.problems().front().expected);
    return;
  }
  const Bitmap mask = decode_bitmap(decode_runs(person.mask, pixels), image.height);
  for (int y = mask.y; y < mask.y + mask.height; ++y) {
    for (int x = mask.x; x < mask.x + mask.width; ++x) {
      if (!mask.at(x, y) || whole.at(x, y)) continue;
      findings.add("visible-in-amodal", person, "the visible mask leaves amodal_segmentation");
      return;
    }
  }
  const double area = person.record.at("area_amodal").get<double>();
  const auto covered = static_cast<double>(whole.area());
  const Box& box = person.amodal;
  const bool is_inside = box.x >= 0 && box.y >= 0 && box.x + box.width <= image.width &&
                         box.y + box.height <= image.height;
  if (covered > area || (is_inside && covered < area)) {
    findings.add(
        "area-is-mask", person,
        fmt::format("area_amodal {}, but amodal_segmentation has {} pixels", area, covered));
  }
  if (!holds(box, whole.x, whole.y, kBoxSlackPx) ||
      !holds(box, whole.x + whole.width, whole.y + whole.height, kBoxSlackPx)) {
    findings.add("visible-in-amodal", person, "amodal_segmentation leaves bbox_amodal");
  }
}

void check_box(const Image& image, const Person& person, Findings& findings) {
  const Box& box = person.box;
  if (!(box.width > 0 && box.height > 0 && person.amodal.width > 0 && person.amodal.height > 0)) {
    findings.add("box-not-empty", person, "a box without a pixel");
    return;
  }
  if (!holds({0, 0, static_cast<double>(image.width), static_cast<double>(image.height)}, box.x,
             box.y, 0) ||
      box.x + box.width > image.width || box.y + box.height > image.height) {
    findings.add("box-in-image", person, "bbox leaves the image");
  }
  if (!holds(person.amodal, box.x, box.y, kBoxSlackPx) ||
      !holds(person.amodal, box.x + box.width, box.y + box.height, kBoxSlackPx)) {
    findings.add("visible-in-amodal", person, "bbox leaves bbox_amodal");
  }
}

void check_visibility(const Person& person, Findings& findings) {
  const double whole = person.record.at("area_amodal").get<double>();
  constexpr double kRounding = 6e-4;  // three digits are written
  if (!(whole >= person.area)) {
    findings.add("visible-in-amodal", person,
                 fmt::format("area {} above area_amodal {}", person.area, whole));
  } else if (!(std::abs(person.visibility - person.area / whole) <= kRounding)) {
    findings.add("visibility-is-ratio", person,
                 fmt::format("visibility {}, but area / area_amodal is {}", person.visibility,
                             person.area / whole));
  }
  if (person.record.at("iscrowd") != 0) {
    findings.add("iscrowd", person, "iscrowd of an individual is not 0");
  }
}

/// That of people, drones, or what a vehicle's track says; 0 for a vehicle that is none.
int expected_category(const Person& object) {
  if (object.number_in_run() > annotate::kFirstDroneNumber) return annotate::kDroneCategory;
  if (object.number_in_run() <= annotate::kFirstVehicleNumber) return annotate::kPersonCategory;
  const std::string vehicle = object.track->value("vehicle", "");
  for (const annotate::ObjectCategory& known : annotate::kObjectCategories) {
    if (known.name == vehicle) return known.id;
  }
  return 0;
}

void check_category(const Person& object, Findings& findings) {
  const int expected = expected_category(object);
  if (object.record.at("category_id") == expected) return;
  findings.add("category", object,
               fmt::format("category {}, expected {}", object.record.at("category_id").dump(),
                           expected == 0 ? "that of its track" : std::to_string(expected)));
}

/// Whether the mask shows somebody within a pixel of a place, and one more for its rounding.
bool shows_near(const Bitmap& mask, const Keypoint& point) {
  constexpr int kReach = 2;
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      if (mask.at(static_cast<int>(point.x) + x, static_cast<int>(point.y) + y)) return true;
    }
  }
  return false;
}

void check_visible_keypoints(const Image& image, const Person& person, Findings& findings) {
  if (std::none_of(person.keypoints.begin(), person.keypoints.end(),
                   [](const Keypoint& point) { return point.visibility == 2; })) {
    return;
  }
  const auto pixels =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  const Bitmap mask = decode_bitmap(decode_runs(person.mask, pixels), image.height);
  for (const Keypoint& point : person.keypoints) {
    if (point.visibility != 2 || shows_near(mask, point)) continue;
    findings.add("keypoints", person, "a visible keypoint away from the mask");
  }
}

void check_keypoints(const Image& image, const Person& person, Findings& findings) {
  if (person.keypoints.empty()) return;
  // Joints of the skeleton may lie outside of the coarse meshes of small people, the coarsest of
  // which have 64 triangles and no forearms.
  constexpr double kCoarseShare = 0.1;
  constexpr double kSmallPx = 120;
  constexpr double kForearmM = 0.5;
  const double size_px = std::max(person.amodal.width, person.amodal.height);
  const double limb_px =
      size_px < kSmallPx ? pixels_across(image_camera(image), person.box_middle, kForearmM) : 0;
  const double slack_px = kBoxSlackPx + std::max(kCoarseShare * size_px, limb_px);
  int labeled = 0;
  for (const Keypoint& point : person.keypoints) {
    if (point.visibility == 0) {
      if (point.x != 0 || point.y != 0) {
        findings.add("keypoints", person, "a keypoint that is not labeled has a place");
      }
      continue;
    }
    ++labeled;
    if (point.x < 0 || point.y < 0 || point.x > image.width || point.y > image.height ||
        !holds(person.amodal, point.x, point.y, slack_px)) {
      findings.add("keypoints", person, "a keypoint outside of bbox_amodal or the image");
    }
  }
  if (person.record.at("num_keypoints") != labeled) {
    findings.add("keypoints", person,
                 fmt::format("num_keypoints {}, but {} are labeled",
                             person.record.at("num_keypoints").dump(), labeled));
  }
}

/// The upright box holds the body: as seen by the camera, it holds the box in the image, and its
/// middle lies in that. Of people who reach behind the near plane, the image's box is that of a
/// part; close to it a millimeter, to which the box is written, is many pixels.
void check_projection(const Image& image, const Person& person, Findings& findings) {
  const Eigen::Matrix<double, 3, 8> in_camera = corners_in_camera(image, person);
  if (!(in_camera.row(2).maxCoeff() > camera::kNearPlaneM)) {
    findings.add("box-3d", person, "box_3d is behind the camera");
    return;
  }
  constexpr double kCloseM = 0.1;
  if (!(in_camera.row(2).minCoeff() > kCloseM)) return;
  const Eigen::Matrix<double, 3, 8> corners = image.camera_matrix * in_camera;
  const Eigen::Vector2d middle =
      in_amodal_limit(image, Eigen::Vector3d(corners.rowwise().mean()).hnormalized().array() + 0.5);
  if (!holds(person.amodal, middle.x(), middle.y(), kBoxSlackPx)) {
    findings.add("box-3d", person, "the middle of box_3d does not project into bbox_amodal");
    return;
  }
  const Eigen::Matrix<double, 2, 8> seen = corners.colwise().hnormalized().array() + 0.5;
  const Eigen::Vector2d first = seen.rowwise().minCoeff();
  const Eigen::Vector2d size = seen.rowwise().maxCoeff() - first;
  const Box outer{first.x(), first.y(), size.x(), size.y()};
  const Box& box = person.amodal;
  if (!holds(outer, box.x, box.y, kBoxSlackPx) ||
      !holds(outer, box.x + box.width, box.y + box.height, kBoxSlackPx)) {
    findings.add("box-3d", person, "bbox_amodal leaves what box_3d projects to");
  }
}

/// Keypoints in the image are those in the world, seen by the camera.
void check_keypoints_3d(const camera::Camera& camera, const Person& person, Findings& findings) {
  const auto places = person.record.find("keypoints_3d");
  if (places == person.record.end()) return;
  for (std::size_t i = 0; i < person.keypoints.size(); ++i) {
    const Keypoint& point = person.keypoints[i];
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

void check_state(const Person& person, Findings& findings) {
  const std::vector<std::string> states = class_values("state");
  if (!person.state.empty() &&
      std::find(states.begin(), states.end(), person.state) == states.end()) {
    findings.add("state", person, "a state that nobody can be in: " + person.state);
  }
}

void check_truncation(const Image& image, const Person& person, Findings& findings) {
  const Box& box = person.amodal;
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
void check_position(const Person& person, Findings& findings) {
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

Eigen::Matrix<double, 3, 8> corners_in_camera(const Image& image, const Person& person) {
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

void check_bodies(const Image& image, Findings& findings) {
  const bool plain = is_plain(image);
  const bool at_once = is_shot_at_once(image);
  const camera::Camera camera = image_camera(image);
  for (const Person& person : list_objects(image)) {
    check_position(person, findings);
    check_state(person, findings);
    check_truncation(image, person, findings);
    if (plain) check_projection(image, person, findings);
    if (at_once) check_keypoints_3d(camera, person, findings);
  }
}

bool is_plain(const Image& image) {
  return image.record.at("camera").value("model", "pinhole") == "pinhole" && is_shot_at_once(image);
}

bool is_shot_at_once(const Image& image) {
  const auto sensor = image.record.find("sensor");
  return sensor == image.record.end() || sensor->value("strips", 1) == 1;
}

void check_people(const Image& image, Findings& findings) {
  for (const Person& person : list_objects(image)) {
    check_box(image, person, findings);
    const bool is_whole = check_mask(image, person, findings);
    check_visibility(person, findings);
    check_category(person, findings);
    check_keypoints(image, person, findings);
    if (is_whole) {
      check_visible_keypoints(image, person, findings);
      check_whole_mask(image, person, findings);
    }
  }
  if (const auto counts = image.record.find("counts"); counts != image.record.end()) {
    const auto truncated =
        std::count_if(image.people.begin(), image.people.end(),
                      [](const Person& person) { return person.record.contains("truncation"); });
    if (counts->at("visible") != image.people.size() ||
        counts->at("all") != image.people.size() + image.hidden.size() ||
        counts->at("truncated") != truncated ||
        counts->value("drones", 0U) + counts->value("vehicles", 0U) != image.objects.size()) {
      findings.add(
          "counts", kCocoFile, fmt::format("image {}", image.id),
          fmt::format("counts {}, but {} have annotations and {} are hidden, {} are truncated",
                      counts->dump(), image.people.size(), image.hidden.size(), truncated));
    }
  }
}

}  // namespace throng::formats
