// Whole bodies, hidden or not: amodal masks, boxes in the world, heads.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "checks/shot.h"
#include "formats/dataset/mask.h"

namespace throng::checks {

namespace {

/// Outlines of masks are pixels whose middles are inside; thin ends of limbs have none.
constexpr double kOutlineSlackPx = 2.5;

double max_distance_m(const Shot& shot, const formats::Person& person) {
  return corners_in_camera(shot.image, person).row(2).maxCoeff();
}

/// The mask of the whole body fills its box.
bool check_mask_fills_box(const Shot& shot, const formats::Person& person,
                          const formats::Bitmap& whole, Findings& findings) {
  const formats::Box& box = person.amodal;
  const bool is_inside = box.x >= 0 && box.y >= 0 && box.x + box.width <= shot.image.width &&
                         box.y + box.height <= shot.image.height;
  const std::array<double, 4> off = {whole.x - box.x, whole.y - box.y,
                                     box.x + box.width - (whole.x + whole.width),
                                     box.y + box.height - (whole.y + whole.height)};
  const double max_gap_px = *std::max_element(off.begin(), off.end());
  // Small bodies lose whole limbs between the pixels.
  constexpr std::uint64_t kMinPixels = 60;
  constexpr double kArmM = 0.08;
  constexpr double kArmLengthM = 0.7;
  constexpr double kThinPx = 2;
  const auto across_px = [&](double size_m) {
    return formats::pixels_across(shot.camera, person.box_middle, size_m);
  };
  const double limb_px = across_px(kArmM) < kThinPx ? across_px(kArmLengthM) : 0;
  const double slack_px =
      kOutlineSlackPx + std::max(0.05 * std::max(box.width, box.height), limb_px);
  if (!is_inside || whole.area() < kMinPixels || max_gap_px <= slack_px) return true;
  findings.add("amodal-mask-fills-box", person,
               fmt::format("amodal_segmentation ends {:.1f} px inside of bbox_amodal", max_gap_px));
  return false;
}

/// Joints are inside of the body.
bool check_joints_on_mask(const formats::Person& person, const formats::Bitmap& whole,
                          Findings& findings) {
  int outside = 0;
  for (const formats::Keypoint& point : person.keypoints) {
    if (point.visibility == 0) continue;
    bool is_on = false;
    for (int dy = -2; dy <= 2 && !is_on; ++dy) {
      for (int dx = -2; dx <= 2 && !is_on; ++dx) {
        is_on = whole.at(static_cast<int>(point.x) + dx, static_cast<int>(point.y) + dy);
      }
    }
    outside += is_on ? 0 : 1;
  }
  constexpr std::uint64_t kLargePixels = 200;
  constexpr int kMaxOutside = 3;  // thin limbs between the pixels
  if (whole.area() < kLargePixels || outside <= kMaxOutside) return true;
  findings.add("amodal-mask-fills-box", person,
               fmt::format("{} keypoints are outside of amodal_segmentation", outside));
  return false;
}

/// Objects that hide the body are nearer than it.
void check_hidden_by_nearer(const Shot& shot, const formats::Person& person,
                            const formats::Bitmap& whole, Findings& findings) {
  const Pixels& pixels = shot.pixels;
  if (pixels.ids.empty() || pixels.depth_cm.empty()) return;
  const double far_m = max_distance_m(shot, person) + 0.1;
  const std::uint32_t own = instance_id(person);
  std::size_t hidden = 0;
  std::size_t open = 0;
  for (int y = whole.y; y < whole.y + whole.height; ++y) {
    for (int x = whole.x; x < whole.x + whole.width; ++x) {
      const std::size_t pixel = pixels.at(x, y);
      if (!whole.at(x, y) || pixels.ids[pixel] == own) continue;
      ++hidden;
      open += pixels.depth_cm[pixel] == 0 || pixels.depth_m(pixel) > far_m ? 1 : 0;
    }
  }
  const auto outline = static_cast<double>(whole.width + whole.height);
  if (static_cast<double>(open) > 2 + 0.15 * outline) {
    findings.add("hidden-by-nearer", person,
                 fmt::format("{} of {} pixels of amodal_segmentation that show somebody or "
                             "something else show what is farther away",
                             open, hidden));
  }
}

void check_whole_mask_place(const Shot& shot, const formats::Person& person, Findings& findings) {
  const auto found = person.record.find("amodal_segmentation");
  // The rows of a rolling shutter see parts of a body at other times than its box.
  if (found == person.record.end() || !shot.at_once) return;
  const auto runs =
      formats::decode_runs(found->at("counts").get<std::string>(), shot.pixels.count());
  const formats::Bitmap whole = formats::decode_bitmap(runs, shot.image.height);
  if (check_mask_fills_box(shot, person, whole, findings) &&
      check_joints_on_mask(person, whole, findings)) {
    check_hidden_by_nearer(shot, person, whole, findings);
  }
}

/// Each side of box_3d touches the body, so that bbox_amodal reaches what the side projects to.
void check_box_is_tight(const Shot& shot, const formats::Person& person, double shutter_px,
                        Findings& findings) {
  const Eigen::Matrix<double, 3, 8> corners =
      shot.image.camera_matrix * corners_in_camera(shot.image, person);
  if (!(corners.row(2).minCoeff() > 0.5)) return;
  Eigen::Matrix<double, 2, 8> seen;
  for (int i = 0; i < 8; ++i) {
    seen.col(i) = formats::in_amodal_limit(
        shot.image, Eigen::Vector3d(corners.col(i)).hnormalized().array() + 0.5);
  }
  const formats::Box& box = person.amodal;
  // The box holds finer meshes than the drawn one, which ends beside them by up to a pixel
  // (skinning::extent_slack_m()); those of people who are small in the image may have lost a
  // twentieth of a stature in older datasets.
  constexpr double kSmallPx = 60;
  const double px_per_m = shot.image.camera_matrix(0, 0) / corners.row(2).minCoeff();
  const double slack_m = box.height < kSmallPx ? 0.09 : 0.05;
  const double slack_px = 1.5 + slack_m * px_per_m + shutter_px;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      Eigen::AlignedBox2d face;
      for (int i = 0; i < 8; ++i) {
        if (((i >> axis) & 1) == side) face.extend(Eigen::Vector2d(seen.col(i)));
      }
      const double off = std::max({face.min().x() - (box.x + box.width), box.x - face.max().x(),
                                   face.min().y() - (box.y + box.height), box.y - face.max().y()});
      if (off <= slack_px) continue;
      findings.add("box-3d", person,
                   fmt::format("bbox_amodal ends {:.1f} px before a side of box_3d, which touches "
                               "the body",
                               off));
      return;
    }
  }
}

/// The head is seen near the upper end of an upright body, and among its keypoints.
void check_head(const Shot& shot, const formats::Person& person, Findings& findings) {
  if (!person.head || !shot.at_once) return;
  const Eigen::Vector3d center = shot.camera.pose.center();
  const Eigen::Vector3d at = shot.camera.unproject(Eigen::Vector2d(person.head->array() - 0.5), 1);
  if (!at.allFinite()) return;
  const Eigen::ParametrizedLine<double, 3> ray(center, (at - center).normalized());
  Eigen::Vector3d expected = person.box_middle;
  double slack_m = 0.5;
  const auto keypoints = person.record.find("keypoints_3d");
  if (keypoints != person.record.end()) {
    constexpr std::size_t kFacePoints = 5;  // nose, eyes, ears
    expected.setZero();
    for (std::size_t i = 0; i < kFacePoints; ++i) {
      for (int c = 0; c < 3; ++c) {
        expected[c] += keypoints->at(i).at(static_cast<std::size_t>(c)).get<double>() / kFacePoints;
      }
    }
    slack_m = 0.16;
  } else {
    const double height = person.box_size.z();
    if (height < 1.3 * person.box_size.head<2>().maxCoeff()) return;  // lies or bends
    constexpr double kHeadShare = 0.42;                               // above the middle
    expected.z() += kHeadShare * height;
  }
  const double depth_m = (center - expected).norm();
  const double off = ray.distance(expected);
  if (off <= slack_m + 0.01 * depth_m / shot.image.camera_matrix(0, 0)) return;
  findings.add("head", person,
               fmt::format("head is seen {:.2f} m beside the middle of the face{}", off,
                           keypoints == person.record.end() ? " that box_3d suggests" : ""));
}

}  // namespace

const formats::Person* Shot::find(std::int64_t track_id) const {
  for (const std::vector<formats::Person>* objects : {&image.people, &image.objects}) {
    for (const formats::Person& object : *objects) {
      if (object.track_id == track_id) return &object;
    }
  }
  return nullptr;
}

formats::Bitmap Shot::instance_mask(const formats::Person& person) const {
  return formats::decode_bitmap(formats::decode_runs(person.mask, pixels.count()), image.height);
}

Eigen::Vector3d Shot::point_at(int x, int y, double depth_m) const {
  if (!rays) return camera.unproject({x, y}, depth_m);
  const Eigen::Vector2d direction = rays->direction(x, y);
  const Eigen::Vector3d point(direction.x() * depth_m, direction.y() * depth_m, depth_m);
  return camera.pose.R.transpose() * (point - camera.pose.t);
}

double pixels_per_pixel(const Shot& from, const Shot& to, int x, int y, double depth_m) {
  const auto here = to.camera.project(from.point_at(x, y, depth_m));
  double apart_px = 1;
  for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1)}) {
    if (!from.pixels.holds(x + dx, y + dy)) continue;
    const auto there = to.camera.project(from.point_at(x + dx, y + dy, depth_m));
    if (there.visible) apart_px = std::max(apart_px, (there.pixel - here.pixel).norm());
  }
  return apart_px;
}

void check_whole_bodies(const Shot& shot, Findings& findings) {
  const std::optional<double> shutter_px =
      is_pinhole(shot.image) ? shutter_slack_px(shot.image) : std::nullopt;
  for (const formats::Person& person : shot.image.people) {
    check_whole_mask_place(shot, person, findings);
    // Only characters have a known shape.
    if (!person.track->contains("attributes")) continue;
    if (shutter_px) check_box_is_tight(shot, person, *shutter_px, findings);
    check_head(shot, person, findings);
  }
  for (const formats::Person& object : shot.image.objects) {
    if (shutter_px && object.track->contains("vehicle")) {
      check_box_is_tight(shot, object, *shutter_px, findings);
    }
  }
}

}  // namespace throng::checks
