// Motion in the world and flow's occlusion, against depth, cameras and people.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "checks/median.h"
#include "checks/shares.h"
#include "checks/shot.h"
#include "formats/dataset/raster_files.h"

namespace throng::checks {

namespace {

/// Values of flow_occlusion/ (docs/formats_pixels.md).
enum class FlowTarget : std::uint16_t { unknown, visible, hidden, outside };

/// Stands for depths beyond 655.35 m, which are written as 0.
constexpr double kTooFarM = 1e9;

/// Meters.
std::optional<Eigen::Vector3d> motion_at(const Pixels& pixels, std::size_t pixel) {
  constexpr double kZero = 32768;
  constexpr double kPerMeter = 1000;
  const std::uint16_t* sample = &pixels.scene_flow[3 * pixel];
  if (sample[0] == 0) return std::nullopt;
  return (Eigen::Vector3d(sample[0], sample[1], sample[2]).array() - kZero) / kPerMeter;
}

/// Pixels that were looked at, and the first of those that are wrong.
struct Verdict {
  double max_wrong_share = 0.03;
  std::size_t looked_at = 0;
  std::size_t wrong = 0;
  std::string first = {};

  void add(bool is_right, int x, int y) {
    ++looked_at;
    if (is_right) return;
    if (wrong++ == 0) first = fmt::format("({}, {})", x, y);
  }
  bool is_bad() const { return is_above_share(wrong, looked_at, max_wrong_share); }
};

/// Every pixel of a grid of about 10 000.
template <typename Visit>
void for_samples(const Pixels& pixels, const Visit& visit) {
  constexpr double kSamples = 10000;
  const int step =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(pixels.count()) / kSamples)));
  for (int y = 0; y < pixels.height; y += step) {
    for (int x = y % step; x < pixels.width; x += step) visit(x, y, pixels.at(x, y));
  }
}

void report(const Verdict& verdict, const char* rule, const char* kind, const char* claim,
            const Shot& shot, Findings& findings) {
  if (!verdict.is_bad()) return;
  findings.add(rule, raster_name(kind, shot.image), shot.record(),
               fmt::format("{} of {} pixels {}, the first at {}", verdict.wrong, verdict.looked_at,
                           claim, verdict.first));
}

/// Whether motion in the world leads to the pixel that flow leads to; nothing where they do not
/// say.
std::optional<bool> leads_like_flow(const Shot& before, const Shot& after, int x, int y,
                                    const Eigen::Vector3d& motion) {
  const Pixels& pixels = before.pixels;
  const std::size_t pixel = pixels.at(x, y);
  if (pixels.flow.empty() || pixels.depth_cm.empty() || pixels.depth_cm[pixel] == 0) return {};
  const auto flow = formats::decode_flow(&pixels.flow[3 * pixel]);
  if (!flow) return {};
  const Eigen::Vector3d from = before.point_at(x, y, pixels.depth_m(pixel));
  const auto seen = after.camera.project(from + motion);
  // Depth is rounded to centimeters.
  const auto beside =
      after.camera.project(before.point_at(x, y, pixels.depth_m(pixel) + 0.01) + motion);
  if (!seen.visible || !beside.visible || !(seen.depth_m > 0.5)) return {};
  const double spread =
      before.is_plain ? 1 : pixels_per_pixel(before, after, x, y, pixels.depth_m(pixel));
  const double slack_px =
      (before.is_plain ? 0.3 : 1.5 * spread) + (beside.pixel - seen.pixel).norm();
  return (seen.pixel - Eigen::Vector2d(x, y) - *flow).norm() <= slack_px + 0.01 * flow->norm();
}

bool is_upright(const formats::Person& person) {
  return person.state != "lying" && person.state != "falling" && person.state != "getting_up" &&
         person.state != "squatting";
}

/// How much farther than the place of somebody who falls or gets up their pixels may move on the
/// average: bodies turn about their feet, and the visible half may be the upper one.
double turn_m(const formats::Person& then, const formats::Person& now) {
  if (is_upright(then) && is_upright(now)) return 0;
  constexpr double kMiddleOfUpperHalf = 0.75;
  return kMiddleOfUpperHalf * std::max(then.box_size.maxCoeff(), now.box_size.maxCoeff());
}

/// Somebody of two frames: the mean motion of the pixels, and that of the position.
struct PersonMotion {
  const formats::Person* then = nullptr;
  const formats::Person* now = nullptr;
  Eigen::Vector3d of_pixels = Eigen::Vector3d::Zero();
  Eigen::Vector3d of_position = Eigen::Vector3d::Zero();
};

std::vector<PersonMotion> person_motions(const Shot& before, const Shot& after) {
  const Pixels& pixels = before.pixels;
  struct Sum {
    Eigen::Vector3d motion = Eigen::Vector3d::Zero();
    std::size_t pixels = 0;
  };
  std::map<std::uint32_t, Sum> sums;
  std::vector<PersonMotion> motions;
  for (std::size_t i = 0; i < pixels.ids.size(); ++i) {
    if (pixels.ids[i] == 0 || pixels.ids[i] >= formats::kFirstBuilding) continue;
    const auto motion = motion_at(pixels, i);
    if (!motion) continue;
    Sum& sum = sums[pixels.ids[i]];
    sum.motion += *motion;
    ++sum.pixels;
  }
  for (const formats::Person& then : before.image.people) {
    const formats::Person* now = after.find(then.track_id);
    const auto sum = sums.find(instance_id(then));
    constexpr std::size_t kMinPixels = 12;
    constexpr double kMinVisibility = 0.5;  // else a foot on the ground may be all that shows
    if (then.visibility < kMinVisibility || then.truncation > 1 - kMinVisibility) continue;
    if (now == nullptr || sum == sums.end() || sum->second.pixels < kMinPixels) continue;
    motions.push_back({&then, now, sum->second.motion / static_cast<double>(sum->second.pixels),
                       now->position - then.position});
  }
  return motions;
}

/// The mean motion of somebody's pixels is that of their place, but for what limbs and falls do.
void check_people_move(const Shot& before, const std::vector<PersonMotion>& motions,
                       Findings& findings) {
  for (const PersonMotion& person : motions) {
    const Eigen::Vector3d& mean = person.of_pixels;
    const Eigen::Vector3d& moved = person.of_position;
    const double slack_m = 0.3 + 0.3 * moved.norm() + turn_m(*person.then, *person.now);
    if ((mean - moved).head<2>().norm() <= slack_m) continue;
    findings.add("scene-flow", raster_name("scene_flow", before.image),
                 fmt::format("annotation {}", person.then->id),
                 fmt::format("pixels move by ({:.2f}, {:.2f}) m on the average, but the person by "
                             "({:.2f}, {:.2f})",
                             mean.x(), mean.y(), moved.x(), moved.y()));
    return;
  }
}

/// Over many people who walk, pixels move as far as their positions: limbs swing to and fro.
void check_scale(const std::vector<double>& ratios, const std::string& file,
                 const std::string& record, Findings& findings) {
  constexpr double kMaxOff = 0.05;
  if (ratios.empty()) return;
  const double ratio = median(ratios);
  if (!(std::abs(ratio - 1) > kMaxOff + median_error(ratios))) return;
  findings.add("scene-flow", file, record,
               fmt::format("pixels of {} people who walk move {:.3f} times as far as their "
                           "positions (median)",
                           ratios.size(), ratio));
}

/// Depth (m) in the next frame of what a pixel shows, 0: sky; nothing where it is unknown.
std::optional<double> next_depth(const Shot& before, const Shot& after, int x, int y) {
  const Pixels& pixels = before.pixels;
  const std::size_t pixel = pixels.at(x, y);
  if (pixels.ids[pixel] == 0) return 0;
  if (pixels.depth_cm[pixel] == 0) return {};
  Eigen::Vector3d point = before.point_at(x, y, pixels.depth_m(pixel));
  if (!is_still(pixels.ids[pixel])) {
    if (pixels.scene_flow.empty()) return {};
    const auto motion = motion_at(pixels, pixel);
    if (!motion) return {};
    point += *motion;
  }
  const auto seen = after.camera.project(point);
  if (!seen.visible) return {};
  return seen.depth_m;
}

/// The first and the last pixel about a place, on one axis; nothing where the rounding of flow may
/// take one off.
std::optional<std::pair<int, int>> pixels_about(double place_px) {
  constexpr double kAboutPx = 63 / 64.0;
  constexpr double kRoundingPx = 1 / 128.0;
  const auto first = [&](double reach_px) {
    return static_cast<int>(std::ceil(place_px - reach_px));
  };
  const auto last = [&](double reach_px) {
    return static_cast<int>(std::floor(place_px + reach_px));
  };
  if (first(kAboutPx - kRoundingPx) != first(kAboutPx + kRoundingPx) ||
      last(kAboutPx - kRoundingPx) != last(kAboutPx + kRoundingPx)) {
    return std::nullopt;
  }
  return std::pair(first(kAboutPx), last(kAboutPx));
}

/// The value that the mask must have; nothing where rounded depth and flow cannot tell.
std::optional<FlowTarget> expected_target(const Shot& before, const Shot& after, int x, int y,
                                          const Eigen::Vector2d& flow) {
  const Pixels& next = after.pixels;
  const double u = x + flow.x();
  const double v = y + flow.y();
  constexpr double kBorderPx = 0.05;
  const double beyond = std::max({-0.5 - u, -0.5 - v, u - next.width + 0.5, v - next.height + 0.5});
  if (std::abs(beyond) < kBorderPx) return {};
  if (beyond > 0) return FlowTarget::outside;
  const auto depth = next_depth(before, after, x, y);
  if (!depth) return {};
  double max_m = 0;  // of what is shown around
  bool shows_sky = false;
  const auto columns = pixels_about(u);
  const auto rows = pixels_about(v);
  if (!columns || !rows) return {};
  for (int y_next = rows->first; y_next <= rows->second; ++y_next) {
    for (int x_next = columns->first; x_next <= columns->second; ++x_next) {
      if (!next.holds(x_next, y_next)) return {};
      const std::size_t pixel = next.at(x_next, y_next);
      shows_sky |= next.ids[pixel] == 0;
      const bool is_too_far = next.ids[pixel] != 0 && next.depth_cm[pixel] == 0;
      max_m = std::max(max_m, is_too_far ? kTooFarM : next.depth_m(pixel));
    }
  }
  if (*depth == 0) return shows_sky ? FlowTarget::visible : FlowTarget::hidden;
  if (shows_sky) return FlowTarget::visible;
  const double margin_m = 0.05 + 0.002 * *depth;
  const double behind_m = *depth - max_m;
  const double slack_m = 0.02 + 0.001 * *depth;
  if (std::abs(behind_m - margin_m) < slack_m) return {};
  return behind_m > margin_m ? FlowTarget::hidden : FlowTarget::visible;
}

}  // namespace

void SceneFlowCheck::finish(Findings& findings) const {
  for (const auto& [run, ratios] : ratios_) {
    check_scale(ratios, ground_truth_file(annotate::GroundTruth::scene_flow, run, "CAMERA", 0), run,
                findings);
  }
}

void SceneFlowCheck::add(const Shot& before, const Shot& after, Findings& findings) {
  const Pixels& pixels = before.pixels;
  if (pixels.scene_flow.empty() || pixels.ids.empty() || !before.at_once || !after.at_once) return;
  Verdict still;
  Verdict sky;
  Verdict like_flow;
  for_samples(pixels, [&](int x, int y, std::size_t pixel) {
    const auto motion = motion_at(pixels, pixel);
    if (pixels.ids[pixel] == 0) return sky.add(!motion, x, y);
    if (!motion) return;
    if (is_still(pixels.ids[pixel])) still.add(motion->isZero(), x, y);
    const auto is_right = leads_like_flow(before, after, x, y, *motion);
    if (is_right) like_flow.add(*is_right, x, y);
  });
  constexpr const char* kRule = "scene-flow";
  constexpr const char* kKind = "scene_flow";
  report(still, kRule, kKind, "of what stands still move", before, findings);
  report(sky, kRule, kKind, "of the sky have motion", before, findings);
  report(like_flow, kRule, kKind, "do not move where flow leads", before, findings);
  const std::vector<PersonMotion> motions = person_motions(before, after);
  check_people_move(before, motions, findings);
  std::vector<double> ratios;
  for (const PersonMotion& person : motions) {
    constexpr double kMinWayM = 0.2;
    const double way_m = person.of_position.norm();
    if (way_m < kMinWayM || !is_upright(*person.then) || !is_upright(*person.now)) continue;
    ratios.push_back(person.of_pixels.dot(person.of_position) / (way_m * way_m));
  }
  check_scale(ratios, raster_name("scene_flow", before.image), before.record(), findings);
  std::vector<double>& all = ratios_[before.image.run];
  all.insert(all.end(), ratios.begin(), ratios.end());
}

void check_flow_occlusion(const Shot& before, const Shot& after, Findings& findings) {
  const Pixels& pixels = before.pixels;
  if (pixels.flow_occlusion.empty() || pixels.flow.empty() || pixels.ids.empty() ||
      pixels.depth_cm.empty() || after.pixels.ids.empty() || after.pixels.depth_cm.empty() ||
      !before.at_once || !after.at_once) {
    return;
  }
  Verdict verdict;
  Verdict not_visible{.max_wrong_share = 0.15};  // found or expected: few pixels of most images
  for_samples(pixels, [&](int x, int y, std::size_t pixel) {
    const auto found = static_cast<FlowTarget>(pixels.flow_occlusion[pixel]);
    const auto flow = formats::decode_flow(&pixels.flow[3 * pixel]);
    // Flow that is too far for its file is not unknown.
    if (!flow) return;
    if (found == FlowTarget::unknown) return verdict.add(false, x, y);
    const auto expected = expected_target(before, after, x, y, *flow);
    if (!expected) return;
    verdict.add(found == *expected, x, y);
    if (found != FlowTarget::visible || *expected != FlowTarget::visible) {
      not_visible.add(found == *expected, x, y);
    }
  });
  for (const Verdict& part : {verdict, not_visible}) {
    report(part, "flow-occlusion", "flow_occlusion",
           "are not as depth and flow of the two frames say", before, findings);
  }
}

}  // namespace throng::checks
