// Hazards of image records: they stay what they are and do not shrink; dangers follow from them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "checks/run_checks.h"
#include "formats/dataset/image_camera.h"
#include "formats/files/json_vectors.h"
#include "spec/annotate/outlines.h"
#include "world/disasters.h"

namespace throng::checks {

using annotate::GroundTruth;
using nlohmann::json;

namespace {

/// Numbers are rounded to 1 mm, dangers to 1 cm.
constexpr double kHazardRoundingM = 0.02;
/// Times within reach are counted in steps of the crowd.
constexpr double kHazardStepsS = 0.5;

/// The point of the ground that a pixel shows; none above the horizon or beyond the lens.
std::optional<Eigen::Vector2d> ground_at(const camera::Camera& camera, const Eigen::Vector2d& at) {
  const Eigen::Vector3d center = camera.pose.center();
  const Eigen::Vector3d ray = camera.unproject(at.array() - 0.5, 1) - center;
  if (!ray.allFinite() || ray.z() > -1e-3) return std::nullopt;
  return Eigen::Vector2d((center - ray * (center.z() / ray.z())).head<2>());
}

/// Corners of the area lie on the circle, but for those where the camera's view ends.
bool is_circle(const formats::Image& image, const json& hazard) {
  constexpr double kMaxOffShare = 0.25;
  const camera::Camera camera = formats::image_camera(image);
  const Eigen::Vector2d center = formats::numbers_at<2>(hazard.at("position"));
  const double radius_m = hazard.at("radius_m").get<double>();
  const double height_m = camera.pose.center().z();
  int corners = 0;
  int off = 0;
  for (const json& corner : hazard.at("area")) {
    const auto ground = ground_at(camera, formats::numbers_at<2>(corner));
    if (!ground) continue;
    const double range_m = (*ground - camera.pose.center().head<2>()).norm();
    const double px_m = (range_m * range_m + height_m * height_m) /
                        (std::max(height_m, 1.0) * camera.intrinsics.fx_px);
    ++corners;
    // A polygon stands for the circle: the middles of its sides are within it.
    const double sagitta_m = radius_m * (1 - std::cos(std::numbers::pi / annotate::kHazardSides));
    const double beyond_m = (*ground - center).norm() - radius_m;
    const double slack_m = 0.03 + 0.05 * px_m;
    off += beyond_m > slack_m || beyond_m < -slack_m - sagitta_m ? 1 : 0;
  }
  return off <= kMaxOffShare * corners;
}

}  // namespace

void HazardCheck::check_hazard(const formats::Image& image, const json& hazard,
                               Findings& findings) {
  const auto fault = [&](const std::string& what) {
    findings.add("hazards", formats::kCocoFile, fmt::format("image {}", image.id),
                 fmt::format("hazard {} {}", hazard.at("id").dump(), what));
  };
  const std::string kind = hazard.at("kind").get<std::string>();
  if (std::find(world::kDisasterKinds.begin(), world::kDisasterKinds.end(), kind) ==
      world::kDisasterKinds.end()) {
    fault("is of no known kind: " + kind);
  }
  const double radius_m = hazard.at("radius_m").get<double>();
  if (!(radius_m > 0) || hazard.at("start_s").get<double>() > image.time_s) {
    fault("has not begun");
  }
  if (is_shot_at_once(image) && !is_circle(image, hazard)) {
    fault("has an area that is not its circle on the ground");
  }
  const auto key = std::pair(image.run, hazard.at("id").get<int>());
  const auto [known, is_new] = last_.try_emplace(key, Known{image.time_s, hazard});
  if (is_new) return;
  const json& before = known->second.record;
  const bool is_later = image.time_s >= known->second.time_s;
  const double before_m = before.at("radius_m").get<double>();
  if (is_later ? radius_m < before_m : radius_m > before_m) fault("shrinks");
  if (before.at("kind") != hazard.at("kind") || before.at("start_s") != hazard.at("start_s") ||
      (kind != "attacker" && before.at("position") != hazard.at("position"))) {
    fault("is not what it is in another image");
  }
  if (image.time_s == known->second.time_s && before_m != radius_m) {
    fault("has another radius in an image of the same time");
  }
  known->second = {image.time_s, hazard};
}

void HazardCheck::check_danger(const formats::Image& image, const formats::Person& person,
                               const json& hazards, Findings& findings) {
  const json& danger = person.record.at("danger");
  const auto fault = [&](const std::string& what) { findings.add("danger", person, what); };
  const double said_m = danger.at("distance_m").get<double>();
  std::optional<double> nearest_m;
  std::optional<double> of_named_m;
  double first_s = image.time_s;
  for (const json& hazard : hazards) {
    const double away_m =
        (person.position.head<2>() - formats::numbers_at<2>(hazard.at("position"))).norm();
    const double distance_m = std::max(0.0, away_m - hazard.at("radius_m").get<double>());
    nearest_m = std::min(nearest_m.value_or(distance_m), distance_m);
    if (hazard.at("id") == danger.at("hazard")) of_named_m = distance_m;
    first_s = std::min(first_s, hazard.at("start_s").get<double>());
  }
  if (!of_named_m || std::abs(*of_named_m - *nearest_m) > kHazardRoundingM ||
      std::abs(said_m - *nearest_m) > kHazardRoundingM) {
    fault(fmt::format("danger {}, but the nearest hazard is {:.2f} m away", danger.dump(),
                      nearest_m.value_or(-1)));
  }
  const double inside_s = danger.at("inside_s").get<double>();
  if (inside_s < 0 || inside_s > image.time_s - first_s + kHazardStepsS) {
    fault(fmt::format("inside_s {}, {:.2f} s after the first hazard began", inside_s,
                      image.time_s - first_s));
  }
  const auto [known, is_new] = inside_.try_emplace(person.track_id, Inside{image.time_s, inside_s});
  if (is_new) return;
  const double passed_s = image.time_s - known->second.time_s;
  const double more_s = inside_s - known->second.inside_s;
  const bool is_later = passed_s >= 0;
  if (is_later ? more_s < -0.01 || more_s > passed_s + kHazardStepsS
               : more_s > 0.01 || more_s < passed_s - kHazardStepsS) {
    fault(fmt::format("inside_s changes by {:.2f} s in {:.2f} s", more_s, passed_s));
  }
  known->second = {image.time_s, inside_s};
}

void HazardCheck::add(const formats::DatasetInfo& info, const formats::Image& image,
                      Findings& findings) {
  const auto hazards = image.record.find("hazards");
  const bool has_any = hazards != image.record.end();
  if (has_any != info.has(GroundTruth::hazards)) {
    findings.add("schema", formats::kCocoFile, fmt::format("image {}", image.id),
                 "hazards are missing, or not of this job");
  }
  if (!has_any) return;
  for (const json& hazard : *hazards) check_hazard(image, hazard, findings);
  for (const formats::Person& person : image.people) {
    if (person.record.contains("danger") == hazards->empty()) {
      findings.add("schema", person, "danger is missing, or there is no hazard");
    } else if (!hazards->empty()) {
      check_danger(image, person, *hazards, findings);
    }
  }
}

}  // namespace throng::checks
