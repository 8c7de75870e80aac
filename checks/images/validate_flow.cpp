// Flow against depth, cameras and people.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "checks/median.h"
#include "checks/shares.h"
#include "checks/shot.h"
#include "formats/dataset/mask.h"
#include "formats/dataset/raster_files.h"

namespace throng::checks {

namespace {

constexpr double kFlowReachPx = 511;  ///< farther is not written
/// Rounding of flow and boxes, and pixels whose middle is just outside of the outline.
constexpr double kFlowSlackPx = 2;

/// Flow to the next frame, or to the previous one.
struct FlowPlane {
  const char* kind;
  std::vector<std::uint16_t> Pixels::*samples;

  std::string file(const Shot& shot) const { return raster_name(kind, shot.image); }
};
constexpr FlowPlane kForward{"flow", &Pixels::flow};
constexpr FlowPlane kBackward{"flow_backward", &Pixels::flow_backward};

std::optional<Eigen::Vector2d> flow_at(const FlowPlane& plane, const Pixels& pixels,
                                       std::size_t pixel) {
  return formats::decode_flow(&(pixels.*plane.samples)[3 * pixel]);
}

/// Counts of the pixels that show still surfaces or sky.
struct StillFlow {
  std::size_t looked_at = 0;
  std::size_t wrong = 0;
  std::size_t unknown = 0;
  Eigen::Vector2d found = Eigen::Vector2d::Zero();  ///< at the first wrong one
  Eigen::Vector2d expected = Eigen::Vector2d::Zero();
};

void look_at_still(const FlowPlane& plane, const Shot& before, const Shot& after, int x, int y,
                   StillFlow& tally) {
  const Pixels& pixels = before.pixels;
  const std::size_t pixel = pixels.at(x, y);
  const bool is_sky = pixels.ids[pixel] == 0;
  if (!is_sky && (!is_still(pixels.ids[pixel]) || pixels.depth_cm[pixel] == 0)) return;
  constexpr double kFarM = 1e7;
  const double z = is_sky ? kFarM : pixels.depth_m(pixel);
  const auto moved_to = [&](double depth_m) {
    return after.camera.project(before.point_at(x, y, depth_m));
  };
  const auto seen = moved_to(z);
  const auto beside = moved_to(z + 0.01);
  if (!seen.visible || !beside.visible || !(seen.depth_m > 0.5)) return;
  const Eigen::Vector2d expected = seen.pixel - Eigen::Vector2d(x, y);
  if (!(expected.cwiseAbs().maxCoeff() < kFlowReachPx)) return;
  ++tally.looked_at;
  const auto flow = flow_at(plane, pixels, pixel);
  if (!flow) {
    ++tally.unknown;
    return;
  }
  // A lens is looked up at the nearest pixel of a pinhole image.
  const double slack_px = (before.is_plain ? 0.1 : 1.2 * pixels_per_pixel(before, after, x, y, z)) +
                          (beside.pixel - seen.pixel).norm();
  if ((*flow - expected).norm() <= slack_px + 0.01 * expected.norm()) return;
  if (tally.wrong++ == 0) {
    tally.found = *flow;
    tally.expected = expected;
  }
}

void check_still_flow(const FlowPlane& plane, const Shot& before, const Shot& after,
                      Findings& findings) {
  const Pixels& pixels = before.pixels;
  constexpr int kMaxPoints = 6000;
  const int step =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(pixels.count()) / kMaxPoints)));
  std::map<bool, StillFlow> tallies;  // by whether it is the ground
  for (int y = 0; y < pixels.height; y += step) {
    for (int x = y % step; x < pixels.width; x += step) {
      look_at_still(plane, before, after, x, y,
                    tallies[pixels.ids[pixels.at(x, y)] == formats::kGround]);
    }
  }
  for (const auto& [is_ground, tally] : tallies) {
    constexpr double kMaxWrong = 0.03;
    if (is_above_share(tally.wrong, tally.looked_at, kMaxWrong)) {
      findings.add("flow-of-still", plane.file(before), before.record(),
                   fmt::format("{} of {} still pixels do not move as depth and cameras say: "
                               "({:.2f}, {:.2f}), expected ({:.2f}, {:.2f})",
                               tally.wrong, tally.looked_at, tally.found.x(), tally.found.y(),
                               tally.expected.x(), tally.expected.y()));
    }
    if (is_above_share(tally.unknown, tally.looked_at, kMaxWrong)) {
      findings.add(
          "flow-of-still", plane.file(before), before.record(),
          fmt::format("flow of {} of {} still pixels is unknown", tally.unknown, tally.looked_at));
    }
  }
}

/// Motion of a person's pixels.
struct Led {
  double left = 1e9;
  double top = 1e9;
  double right = -1e9;
  double bottom = -1e9;
  std::size_t known = 0;
  std::size_t pixels = 0;
  std::size_t on_body = 0;  ///< of the known ones, if there is a mask to look at
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
};

Led lead(const FlowPlane& plane, const Shot& before, const formats::Person& person,
         const formats::Bitmap& body) {
  Led led;
  const Pixels& pixels = before.pixels;
  const formats::Bitmap mask = before.instance_mask(person);
  for (int y = mask.y; y < mask.y + mask.height; ++y) {
    for (int x = mask.x; x < mask.x + mask.width; ++x) {
      if (!mask.at(x, y)) continue;
      ++led.pixels;
      const auto flow = flow_at(plane, pixels, pixels.at(x, y));
      if (!flow) continue;
      ++led.known;
      led.sum += *flow;
      const double u = x + 0.5 + flow->x();
      const double v = y + 0.5 + flow->y();
      led.left = std::min(led.left, u);
      led.right = std::max(led.right, u);
      led.top = std::min(led.top, v);
      led.bottom = std::max(led.bottom, v);
      const int column = static_cast<int>(std::floor(u));
      const int row = static_cast<int>(std::floor(v));
      bool is_on = false;
      for (int dy = -1; dy <= 1 && !is_on; ++dy) {
        for (int dx = -1; dx <= 1 && !is_on; ++dx) is_on = body.at(column + dx, row + dy);
      }
      led.on_body += is_on ? 1 : 0;
    }
  }
  return led;
}

/// The whole body's mask in the next frame, if it is known and in the image.
formats::Bitmap whole_mask(const Shot& shot, const formats::Person& person) {
  const auto amodal = person.record.find("amodal_segmentation");
  const formats::Box& box = person.amodal;
  const bool is_inside = box.x >= 0 && box.y >= 0 && box.x + box.width <= shot.image.width &&
                         box.y + box.height <= shot.image.height;
  if (!is_inside) return {};
  if (amodal != person.record.end()) {
    return formats::decode_bitmap(
        formats::decode_runs(amodal->at("counts").get<std::string>(), shot.pixels.count()),
        shot.image.height);
  }
  constexpr double kWhole = 0.99;
  if (person.visibility < kWhole) return {};
  return shot.instance_mask(person);
}

/// Whether the border of what the lens shows cuts a body off, beyond which flow is unknown: a body
/// that reaches it has a corner of its box outside, because that border is convex.
bool reaches_lens_border(const Shot& shot, const formats::Box& box) {
  const camera::Intrinsics& lens = shot.camera.intrinsics;
  if (!lens.distortion) return false;
  for (const double x : {box.x - kFlowSlackPx, box.x + box.width + kFlowSlackPx}) {
    for (const double y : {box.y - kFlowSlackPx, box.y + box.height + kFlowSlackPx}) {
      if (!lens.direction_of({x - 0.5, y - 0.5})) return true;
    }
  }
  return false;
}

void check_person_flow(const FlowPlane& plane, const Shot& before, const Shot& after,
                       const formats::Person& then, const formats::Person& now,
                       Findings& findings) {
  const std::string file = plane.file(before);
  const std::string record = fmt::format("annotation {}", then.id);
  const formats::Bitmap body = whole_mask(after, now);
  const Led led = lead(plane, before, then, body);
  constexpr std::size_t kMinCount = 12;
  if (led.pixels < kMinCount) return;
  const formats::Box& box = now.amodal;
  const Eigen::Vector2d moved(box.x + box.width / 2 - then.amodal.x - then.amodal.width / 2,
                              box.y + box.height / 2 - then.amodal.y - then.amodal.height / 2);
  if (static_cast<double>(led.known) < 0.9 * static_cast<double>(led.pixels)) {
    const bool is_cut = formats::reaches_amodal_limit(before.image, then.amodal) ||
                        formats::reaches_amodal_limit(after.image, box) ||
                        reaches_lens_border(after, box);
    if (!is_cut && moved.cwiseAbs().maxCoeff() < 0.8 * kFlowReachPx) {
      findings.add("flow-leads-to-boxes", file, record,
                   fmt::format("flow of {} of {} pixels is unknown, but the person is in the next "
                               "frame",
                               led.pixels - led.known, led.pixels));
    }
    return;
  }
  const Eigen::Vector2d first = formats::in_amodal_limit(after.image, {led.left, led.top});
  const Eigen::Vector2d last = formats::in_amodal_limit(after.image, {led.right, led.bottom});
  if (first.x() < box.x - kFlowSlackPx || first.y() < box.y - kFlowSlackPx ||
      last.x() > box.x + box.width + kFlowSlackPx || last.y() > box.y + box.height + kFlowSlackPx) {
    findings.add("flow-leads-to-boxes", file, record,
                 fmt::format("flow leads to [{:.1f}, {:.1f}] x [{:.1f}, {:.1f}], out of its "
                             "bbox_amodal in the next frame",
                             led.left, led.right, led.top, led.bottom));
    return;
  }
  if (body.width > 0 && led.known >= 20 &&
      static_cast<double>(led.on_body) < 0.7 * static_cast<double>(led.known)) {
    findings.add(
        "flow-leads-to-boxes", file, record,
        fmt::format("flow leads {} of {} pixels beside the person's mask in the next frame",
                    led.known - led.on_body, led.known));
    return;
  }
  // Pixels of the entire body move as the body does.
  constexpr double kMostlyWhole = 0.9;
  if (then.visibility < kMostlyWhole || !before.is_plain || then.truncation > 0 ||
      now.truncation > 0) {
    return;
  }
  const Eigen::Vector2d mean = led.sum / static_cast<double>(led.known);
  const double slack_px = 2 + 0.3 * std::max(box.width, box.height);
  if ((mean - moved).norm() > slack_px) {
    findings.add("flow-leads-to-boxes", file, record,
                 fmt::format("flow is ({:.1f}, {:.1f}) on the average, but its box moves by "
                             "({:.1f}, {:.1f})",
                             mean.x(), mean.y(), moved.x(), moved.y()));
  }
}

double median_of_axis(const std::vector<Eigen::Vector2d>& values, int axis) {
  std::vector<double> of_axis;
  of_axis.reserve(values.size());
  for (const Eigen::Vector2d& value : values) of_axis.push_back(value[axis]);
  return median(std::move(of_axis));
}

/// Flow where keypoints are seen is the motion of these, on the average over an image's people: a
/// joint is inside of the limb whose surface flows, so that one alone differs by some of its
/// motion.
void check_keypoint_flow(const FlowPlane& plane, const Shot& before, const Shot& after,
                         Findings& findings) {
  const Pixels& pixels = before.pixels;
  std::vector<Eigen::Vector2d> off;
  for (const formats::Person& then : before.image.people) {
    const formats::Person* now = after.find(then.track_id);
    if (now == nullptr || now->keypoints.size() != then.keypoints.size()) continue;
    for (std::size_t i = 0; i < then.keypoints.size(); ++i) {
      const formats::Keypoint& a = then.keypoints[i];
      const formats::Keypoint& b = now->keypoints[i];
      const int x = static_cast<int>(a.x);
      const int y = static_cast<int>(a.y);
      if (a.visibility != 2 || b.visibility == 0 || !pixels.holds(x, y)) continue;
      const auto flow = flow_at(plane, pixels, pixels.at(x, y));
      if (flow) off.emplace_back(*flow - Eigen::Vector2d(b.x - a.x, b.y - a.y));
    }
  }
  constexpr std::size_t kMinCount = 30;
  if (off.size() < kMinCount) return;
  const Eigen::Vector2d median(median_of_axis(off, 0), median_of_axis(off, 1));
  for (Eigen::Vector2d& value : off) value = (value - median).cwiseAbs();
  const Eigen::Vector2d spread(median_of_axis(off, 0), median_of_axis(off, 1));
  constexpr double kSlackPx = 0.3;
  if ((median.cwiseAbs() - 2 * spread).maxCoeff() <= kSlackPx) return;
  findings.add("flow-of-keypoints", plane.file(before), before.record(),
               fmt::format("flow at {} keypoints is ({:.2f}, {:.2f}) px other than their motion "
                           "(median)",
                           off.size(), median.x(), median.y()));
}

/// Flow of `from` that leads to `to`, a frame of the same camera.
void check_flow_between(const FlowPlane& plane, const Shot& from, const Shot& to,
                        Findings& findings) {
  if ((from.pixels.*plane.samples).empty() || !from.at_once || !to.at_once) return;
  if (!from.pixels.ids.empty() && !from.pixels.depth_cm.empty()) {
    check_still_flow(plane, from, to, findings);
  }
  check_keypoint_flow(plane, from, to, findings);
  for (const formats::Person& then : from.image.people) {
    const formats::Person* now = to.find(then.track_id);
    if (now != nullptr) check_person_flow(plane, from, to, then, *now, findings);
  }
}

void check_no_flow(const FlowPlane& plane, const Shot& shot, Findings& findings) {
  const std::vector<std::uint16_t>& samples = shot.pixels.*plane.samples;
  std::size_t known = 0;
  for (std::size_t i = 2; i < samples.size(); i += 3) known += samples[i] != 0 ? 1 : 0;
  if (known == 0) return;
  findings.add(
      "flow", plane.file(shot), shot.record(),
      fmt::format("flow of {} pixels is known, but there is no frame that it could lead to",
                  known));
}

}  // namespace

void check_flow_between(const Shot& before, const Shot& after, Findings& findings) {
  check_flow_between(kForward, before, after, findings);
  check_flow_between(kBackward, after, before, findings);
  check_flow_occlusion(before, after, findings);
}

void check_first_flow(const Shot& shot, Findings& findings) {
  check_no_flow(kBackward, shot, findings);
}

void check_last_flow(const Shot& shot, Findings& findings) {
  check_no_flow(kForward, shot, findings);
  const auto is_known = [](std::uint16_t value) { return value != 0; };
  const Pixels& pixels = shot.pixels;
  if (std::any_of(pixels.scene_flow.begin(), pixels.scene_flow.end(), is_known)) {
    findings.add("scene-flow", raster_name("scene_flow", shot.image), shot.record(),
                 "motion is known, but no frame follows");
  }
  if (std::any_of(pixels.flow_occlusion.begin(), pixels.flow_occlusion.end(), is_known)) {
    findings.add("flow-occlusion", raster_name("flow_occlusion", shot.image), shot.record(),
                 "what the next frame shows is known, but no frame follows");
  }
}

}  // namespace throng::checks
