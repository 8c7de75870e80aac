// Keypoints in the world against the body's box and heading, and in the image against its parts.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/angle.h"
#include "checks/shares.h"
#include "checks/shot.h"
#include "formats/files/json_vectors.h"

namespace throng::checks {

namespace {

// COCO's numbers.
constexpr std::size_t kLeftShoulder = 5;
constexpr std::size_t kLeftHip = 11;

/// One limb's keypoint and what of the body it is in: the same on the other side is one more.
struct Limb {
  std::size_t left_keypoint;  ///< the right one follows
  std::uint16_t left_part;    ///< of the images of parts; the right one follows
};
constexpr std::array<Limb, 4> kLimbs = {{{7, 3}, {9, 3}, {13, 5}, {15, 7}}};

Eigen::Vector3d keypoint_at(const formats::Person& person, std::size_t i) {
  return formats::numbers_at<3>(person.record.at("keypoints_3d").at(i));
}

double angle_between(double a_rad, double b_rad) {
  return std::abs(geometry::turn_rad(b_rad, a_rad));
}

/// Facing direction of a body, from its left side to its right one.
double facing_angle(const Eigen::Vector3d& right_to_left) {
  return std::atan2(-right_to_left.x(), right_to_left.y());
}

void check_in_box(const formats::Person& person, Findings& findings) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(-person.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  constexpr double kSlackM = 0.05;
  for (std::size_t i = 0; i < person.record.at("keypoints_3d").size(); ++i) {
    const Eigen::Vector3d at = turn * (keypoint_at(person, i) - person.box_middle);
    const double off = (at.cwiseAbs() - 0.5 * person.box_size).maxCoeff();
    if (off <= kSlackM) continue;
    findings.add("keypoints-in-box", person,
                 fmt::format("keypoint {} is {:.2f} m outside of box_3d", i + 1, off));
    return;
  }
}

/// Hips and shoulders lie across the heading, the left ones on its left.
void check_facing(const formats::Person& person, Findings& findings) {
  constexpr double kUpright = 1.2;  // times as high as wide
  if (person.box_size.z() < kUpright * person.box_size.head<2>().maxCoeff()) return;
  struct Pair {
    std::size_t left;
    double max_rad;
    const char* name;
  };
  for (const Pair& pair : {Pair{kLeftHip, 0.5, "hips"}, Pair{kLeftShoulder, 0.9, "shoulders"}}) {
    const Eigen::Vector3d across =
        keypoint_at(person, pair.left) - keypoint_at(person, pair.left + 1);
    constexpr double kMinSizeM = 0.06;
    if (across.head<2>().norm() < kMinSizeM) continue;
    const double off = angle_between(facing_angle(across), person.heading_rad);
    if (off <= pair.max_rad) continue;
    findings.add("heading-is-body", person,
                 fmt::format("the {} face {:.2f} rad away from heading", pair.name, off));
    return;
  }
}

/// Which sides the images of parts show at the limbs' visible keypoints.
struct Sides {
  int own = 0;
  int opposite = 0;
  int kind = 0;        ///< arms at elbows and wrists, legs at knees and ankles
  int other_kind = 0;  ///< the other way round
  std::size_t looked_at = 0;
  std::size_t no_limb = 0;  ///< of these, without any limb within a pixel
};

Sides find_sides(const Pixels& pixels, const formats::Person& person) {
  Sides sides;
  const std::uint32_t id = instance_id(person);
  for (const Limb& limb : kLimbs) {
    for (std::uint16_t side = 0; side < 2; ++side) {
      const formats::Keypoint& point = person.keypoints[limb.left_keypoint + side];
      const int x = static_cast<int>(point.x);
      const int y = static_cast<int>(point.y);
      if (point.visibility != 2 || !pixels.holds(x, y, 1)) continue;
      bool has_own = false;
      bool has_opposite = false;
      bool has_other_kind = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t pixel = pixels.at(x + dx, y + dy);
          if (!pixels.ids.empty() && pixels.ids[pixel] != id) continue;
          const int part = pixels.parts[pixel];
          // A foot goes on as a leg.
          const auto is_part = [&](int first) {
            return part == first || (limb.left_part == 7 && part == first - 2);
          };
          has_own |= is_part(limb.left_part + side);
          has_opposite |= is_part(limb.left_part + 1 - side);
          const bool is_arm = part == 3 || part == 4;
          const bool is_leg = part >= 5 && part <= 8;
          has_other_kind |= limb.left_part == 3 ? is_leg : is_arm;
        }
      }
      ++sides.looked_at;
      sides.no_limb += has_own || has_opposite || has_other_kind ? 0 : 1;
      sides.own += has_own && !has_opposite ? 1 : 0;
      sides.opposite += has_opposite && !has_own ? 1 : 0;
      sides.kind += (has_own || has_opposite) && !has_other_kind ? 1 : 0;
      sides.other_kind += has_other_kind && !has_own && !has_opposite ? 1 : 0;
    }
  }
  return sides;
}

/// Whether parts of a body are less than the two pixels wide that places and neighbors are off.
bool is_small(const formats::Person& person) {
  constexpr double kMinSizePx = 12;
  return std::max(person.amodal.width, person.amodal.height) < kMinSizePx;
}

void check_sides(const Shot& shot, Findings& findings) {
  if (shot.pixels.parts.empty()) return;
  Sides all;
  constexpr int kMinCount = 4;
  for (const formats::Person& person : shot.image.people) {
    if (person.keypoints.size() <= kLimbs.back().left_keypoint + 1 || is_small(person)) continue;
    const Sides sides = find_sides(shot.pixels, person);
    all.own += sides.own;
    all.opposite += sides.opposite;
    all.kind += sides.kind;
    all.other_kind += sides.other_kind;
    all.looked_at += sides.looked_at;
    all.no_limb += sides.no_limb;
    if (sides.opposite >= kMinCount && sides.opposite > 4 * sides.own) {
      findings.add("parts-at-keypoints", person,
                   fmt::format("{} shows the other side's limbs at {} of {} visible keypoints",
                               raster_name("parts", shot.image), sides.opposite,
                               sides.own + sides.opposite));
    }
  }
  constexpr int kMinOfAll = 12;
  const auto judge = [&](int right, int wrong, const char* what) {
    if (right + wrong < kMinOfAll || wrong <= right) return;
    findings.add(
        "parts-at-keypoints", raster_name("parts", shot.image), shot.record(),
        fmt::format("{} of {} visible keypoints of limbs are on {}", wrong, right + wrong, what));
  };
  judge(all.own, all.opposite, "the other side's");
  constexpr double kMaxNoLimb = 0.2;  // sound images: 0.02
  if (is_above_share(all.no_limb, all.looked_at, kMaxNoLimb)) {
    findings.add(
        "parts-at-keypoints", raster_name("parts", shot.image), shot.record(),
        fmt::format("{} of {} visible keypoints of limbs are on none", all.no_limb, all.looked_at));
  }
  judge(all.kind, all.other_kind, "arms instead of legs or legs instead of arms");
}

/// Keypoints are visible where the depth shows the person's surface at them, and hidden where not.
void check_visibility_of_keypoints(const Shot& shot, const formats::Person& person,
                                   Findings& findings) {
  const Pixels& pixels = shot.pixels;
  const std::uint32_t id = instance_id(person);
  int contradictions = 0;
  for (std::size_t i = 0; i < person.keypoints.size(); ++i) {
    const formats::Keypoint& point = person.keypoints[i];
    const int x = static_cast<int>(point.x);
    const int y = static_cast<int>(point.y);
    if (point.visibility == 0 || !pixels.holds(x, y, 2)) continue;
    const double z = shot.camera.project(keypoint_at(person, i)).depth_m;
    // A joint is up to 20 cm inside of the body; depth is written in centimeters.
    bool is_at_surface = false;
    bool may_be_seen = false;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const std::size_t pixel = pixels.at(x + dx, y + dy);
        if (pixels.ids[pixel] != id) continue;
        const double behind_m = z - pixels.depth_m(pixel);
        is_at_surface |= dx == 0 && dy == 0 && behind_m > -0.06 && behind_m < 0.025;
        may_be_seen |= behind_m > -0.13 && behind_m < 0.23;
      }
    }
    contradictions += (point.visibility == 1 && is_at_surface) ||
                              (point.visibility == 2 && !may_be_seen && shot.is_plain)
                          ? 1
                          : 0;
  }
  if (contradictions < 2) return;
  findings.add("keypoints", person,
               fmt::format("{} keypoints are called hidden where the depth shows them, or visible "
                           "where it does not",
                           contradictions));
}

/// Heads are labeled where heads are.
void check_heads_are_heads(const Shot& shot, Findings& findings) {
  const Pixels& pixels = shot.pixels;
  if (pixels.parts.empty() || pixels.ids.empty()) return;
  int looked_at = 0;
  int heads = 0;
  for (const formats::Person& person : shot.image.people) {
    if (!person.head || is_small(person)) continue;
    const int x = static_cast<int>(person.head->x());
    const int y = static_cast<int>(person.head->y());
    if (!pixels.holds(x, y, 1) || pixels.ids[pixels.at(x, y)] != instance_id(person)) continue;
    ++looked_at;
    bool has_head = false;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) has_head |= pixels.parts[pixels.at(x + dx, y + dy)] == 1;
    }
    heads += has_head ? 1 : 0;
  }
  constexpr int kMinCount = 6;
  if (looked_at < kMinCount || 2 * heads >= looked_at) return;
  findings.add("parts-at-keypoints", raster_name("parts", shot.image), shot.record(),
               fmt::format("{} of {} visible heads are labeled as heads", heads, looked_at));
}

}  // namespace

void check_skeletons(const Shot& shot, Findings& findings) {
  for (const formats::Person& person : shot.image.people) {
    if (!person.record.contains("keypoints_3d")) continue;
    check_in_box(person, findings);
    check_facing(person, findings);
    if (shot.at_once && !shot.pixels.ids.empty() && !shot.pixels.depth_cm.empty()) {
      check_visibility_of_keypoints(shot, person, findings);
    }
  }
  check_sides(shot, findings);
  check_heads_are_heads(shot, findings);
}

}  // namespace throng::checks
