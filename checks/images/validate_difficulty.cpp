// How hard people are to see, against the image, and what hides them, against instances.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "annotate/people/contrast.h"
#include "checks/shot.h"
#include "formats/dataset/mask.h"
#include "formats/files/json_vectors.h"

namespace throng::checks {

using annotate::GroundTruth;
using nlohmann::json;

namespace {

/// Whether both contrasts are the image's.
bool check_contrast(const Shot& shot, const formats::Person& person, const json& difficulty,
                    Findings& findings) {
  if (shot.pixels.rgb.empty() || !shot.has_final_contrasts) return true;
  const annotate::Contrast seen =
      annotate::measure_contrast({shot.pixels.width, shot.pixels.height, shot.pixels.rgb},
                                 formats::to_pixel_mask(shot.instance_mask(person)));
  const auto compare = [&](const char* key, double expected) {
    constexpr double kRounding = 0.1;  // of the records, to one digit, and of sums
    const double found = difficulty.at(key).get<double>();
    if (std::abs(found - expected) <= kRounding) return true;
    findings.add("difficulty", person,
                 fmt::format("{} {}, but the image has {:.1f}", key, found, expected));
    return false;
  };
  return compare("contrast", seen.region) && compare("edge_contrast", seen.edge);
}

/// How far the middle of a body moves in the image during the exposure, but for the camera's turn.
double blur_by_motion_px(const Shot& shot, const formats::Person& person, const json& sensor) {
  Eigen::Vector3d motion_mps(person.velocity.x(), person.velocity.y(), 0);
  if (const auto flight = shot.image.record.find("flight"); flight != shot.image.record.end()) {
    motion_mps -= formats::numbers_at<3>(flight->at("true").at("velocity"));
  }
  const Eigen::Vector3d at = shot.camera.pose.R * person.box_middle + shot.camera.pose.t;
  // Bodies reach a meter beyond their middles.
  constexpr double kNearM = 0.1;
  const double nearest_m = std::max(at.z() - 1, kNearM);
  const double slant = at.norm() / std::max(at.z(), kNearM);
  return shot.camera.intrinsics.fx_px * sensor.value("exposure_s", 0.0) * motion_mps.norm() *
         slant / nearest_m;
}

void check_blur(const Shot& shot, const formats::Person& person, double blur_px,
                Findings& findings) {
  const json sensor = shot.image.record.value("sensor", json::object());
  // That of the image is measured at people's feet and at some places of the background, from
  // where bodies may come much nearer to the camera and so move farther in the image.
  const double max_px =
      1.5 * (sensor.value("blur_px", blur_px) + blur_by_motion_px(shot, person, sensor)) + 0.5;
  const bool is_open = sensor.value("exposure_s", 1.0) > 0;
  if (blur_px >= 0 && blur_px <= max_px && (is_open || blur_px == 0)) return;
  findings.add(
      "difficulty", person,
      fmt::format("blur_px {}, but the image's is {}", blur_px, sensor.value("blur_px", 0.0)));
}

void check_visible_keypoints(const formats::Person& person, int visible, Findings& findings) {
  constexpr int kKeypoints = 17;
  const auto shown =
      std::count_if(person.keypoints.begin(), person.keypoints.end(),
                    [](const formats::Keypoint& point) { return point.visibility == 2; });
  if (visible >= 0 && visible <= kKeypoints && (person.keypoints.empty() || visible == shown)) {
    return;
  }
  findings.add(
      "difficulty", person,
      fmt::format("visible_keypoints {}, but {} of keypoints are visible", visible, shown));
}

/// Shares of the amodal area by instance.
std::map<std::uint32_t, double> hidden_shares(const Shot& shot, const formats::Person& person,
                                              const json& segmentation, double area_px) {
  const auto runs =
      formats::decode_runs(segmentation.at("counts").get<std::string>(), shot.pixels.count());
  const formats::Bitmap whole = formats::decode_bitmap(runs, shot.image.height);
  const std::uint32_t own = instance_id(person);
  std::map<std::uint32_t, double> shares;
  for (int y = whole.y; y < whole.y + whole.height; ++y) {
    for (int x = whole.x; x < whole.x + whole.width; ++x) {
      if (!whole.at(x, y)) continue;
      const std::uint32_t id = shot.pixels.ids[shot.pixels.at(x, y)];
      if (id != own) shares[id] += 1 / area_px;
    }
  }
  return shares;
}

void check_occluders(const Shot& shot, const formats::Person& person, const json& occluders,
                     Findings& findings) {
  const auto fault = [&](const std::string& what) { findings.add("occluders", person, what); };
  std::map<std::uint32_t, double> listed;
  double last = 1;
  double sum = 0;
  for (const json& occluder : occluders) {
    const double share = occluder.at(1).get<double>();
    listed[occluder.at(0).get<std::uint32_t>()] = share;
    if (share > last) fault("occluded_by is not in the order of the shares");
    last = share;
    sum += share;
  }
  if (listed.contains(instance_id(person))) fault("occluded_by has the person");
  constexpr double kRounding = 0.0011;
  const double hidden = 1 - person.visibility;
  const bool is_cut = person.truncation > 0;
  const double slack = 0.01 + kRounding * static_cast<double>(listed.size() + 4);
  if (sum > hidden + slack || (!is_cut && sum < hidden - slack)) {
    fault(fmt::format("occluded_by sums to {:.3f}, but visibility is {}", sum, person.visibility));
  }
  const auto whole = person.record.find("amodal_segmentation");
  if (whole == person.record.end() || shot.pixels.ids.empty()) return;
  const double area_px = person.record.at("area_amodal").get<double>();
  for (const auto& [id, share] : hidden_shares(shot, person, *whole, area_px)) {
    const auto found = listed.find(id);
    const double said = found == listed.end() ? 0 : found->second;
    if (std::abs(said - share) > kRounding) {
      fault(
          fmt::format("occluded_by says {} of instance {}, but it hides {:.3f}", said, id, share));
    }
    listed.erase(id);
  }
  if (!listed.empty()) {
    fault(fmt::format("occluded_by has instance {}, which hides nothing", listed.begin()->first));
  }
}

}  // namespace

void check_difficulty(const formats::DatasetInfo& info, const Shot& shot, Findings& findings) {
  // Nobody has the contrasts of another image: one finding says so, and leaves room for others.
  bool are_contrasts_right = true;
  for (const formats::Person& person : shot.image.people) {
    for (const auto& [kind, key] : {std::pair(GroundTruth::difficulty, "difficulty"),
                                    std::pair(GroundTruth::occluders, "occluded_by")}) {
      if (info.has(kind) == person.record.contains(key)) continue;
      findings.add("schema", person, fmt::format("{} is missing, or not of this job", key));
    }
    if (const auto found = person.record.find("difficulty"); found != person.record.end()) {
      are_contrasts_right = are_contrasts_right && check_contrast(shot, person, *found, findings);
      check_blur(shot, person, found->at("blur_px").get<double>(), findings);
      check_visible_keypoints(person, found->at("visible_keypoints").get<int>(), findings);
    }
    if (const auto found = person.record.find("occluded_by"); found != person.record.end()) {
      check_occluders(shot, person, *found, findings);
    }
  }
}

}  // namespace throng::checks
