// Boxes of heads against heads, bodies and the camera; their visible share against the masks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "checks/shot.h"
#include "formats/dataset/image_camera.h"
#include "formats/dataset/mask.h"

namespace throng::checks {

using annotate::GroundTruth;
using nlohmann::json;

namespace {

/// Pixels of a mask of the image whose middles are in a box.
std::uint64_t pixels_in(const json& segmentation, const Shot& shot, const formats::Box& box) {
  const auto runs =
      formats::decode_runs(segmentation.at("counts").get<std::string>(), shot.pixels.count());
  const formats::Bitmap mask = formats::decode_bitmap(runs, shot.image.height);
  const auto first = [](double edge) { return static_cast<int>(std::ceil(edge - 0.5)); };
  const int left = std::max(first(box.x), mask.x);
  const int top = std::max(first(box.y), mask.y);
  const int right = std::min(first(box.x + box.width), mask.x + mask.width);
  const int bottom = std::min(first(box.y + box.height), mask.y + mask.height);
  std::uint64_t count = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) count += mask.at(x, y) ? 1 : 0;
  }
  return count;
}

void check_head_place(const Shot& shot, const formats::Person& person, double shutter_px,
                      Findings& findings) {
  constexpr double kRoundingPx = 0.05;
  // The middle of the head is where that of the average body is; meshes for small people are
  // coarse.
  constexpr double kSlackM = 0.08;
  const double slack_px =
      kRoundingPx + formats::pixels_across(shot.camera, person.box_middle, kSlackM) + shutter_px;
  const formats::Box& box = *person.head_box;
  const auto fault = [&](const std::string& what) { findings.add("heads", person, what); };
  if (person.head) {
    const auto is_held = [&](const Eigen::Vector2d& head) {
      return head.x() >= box.x - slack_px && head.x() <= box.x + box.width + slack_px &&
             head.y() >= box.y - slack_px && head.y() <= box.y + box.height + slack_px;
    };
    // A lens's boxes are cut off in the flat image, a quarter of whose size is more of the image.
    if (!is_held(*person.head) && !is_held(formats::in_amodal_limit(shot.image, *person.head))) {
      fault("head_box does not hold the head");
    }
  }
  const formats::Box& body = person.amodal;
  if (box.x < body.x - slack_px || box.y < body.y - slack_px ||
      box.x + box.width > body.x + body.width + slack_px ||
      box.y + box.height > body.y + body.height + slack_px) {
    fault("head_box leaves bbox_amodal");
  }
}

/// A head with hair and headwear is about as large as one is at its distance.
void check_head_size(const Shot& shot, const formats::Person& person, Findings& findings) {
  constexpr double kSmallestM = 0.12;
  constexpr double kLargestM = 0.8;
  constexpr double kNearM = 1.5;
  constexpr double kRoundingPx = 0.02;
  const formats::Box& box = *person.head_box;
  const double distance_m = (shot.camera.pose.R * person.box_middle + shot.camera.pose.t).z();
  if (!shot.is_plain || distance_m < kNearM || formats::reaches_amodal_limit(shot.image, box))
    return;
  const double scale = distance_m / (distance_m - 1);  // heads are up to a meter nearer
  const double low = formats::pixels_across(shot.camera, person.box_middle, kSmallestM) / scale;
  const double high = formats::pixels_across(shot.camera, person.box_middle, kLargestM) * scale;
  const double side = std::max(box.width, box.height);
  if (side >= low - kRoundingPx && side <= high + kRoundingPx) return;
  findings.add(
      "heads", person,
      fmt::format("head_box is {:.2f} px large, expected {:.2f} to {:.2f} at this distance", side,
                  low, high));
}

void check_head_visibility(const Shot& shot, const formats::Person& person, Findings& findings) {
  constexpr double kRounding = 0.0006;
  const std::uint64_t visible = pixels_in(person.record.at("segmentation"), shot, *person.head_box);
  const double said = person.head_visibility.value_or(0);
  const auto fault = [&](const std::string& what) { findings.add("heads", person, what); };
  if (said < 0 || said > 1) return fault(fmt::format("head_visibility {} is no share", said));
  const auto whole = person.record.find("amodal_segmentation");
  if (whole == person.record.end()) {
    if ((said > 0) == (visible > 0)) return;
    return fault(
        fmt::format("head_visibility {}, but {} pixels in head_box are visible", said, visible));
  }
  const std::uint64_t all = pixels_in(*whole, shot, *person.head_box);
  if ((all == 0) == person.head_visibility.has_value()) {
    return fault(fmt::format("head_visibility {}, but the person has {} pixels in head_box",
                             person.head_visibility ? "is a number" : "is null", all));
  }
  if (all == 0) return;
  const double share = static_cast<double>(visible) / static_cast<double>(all);
  if (std::abs(share - said) <= kRounding) return;
  fault(fmt::format("head_visibility {}, but the masks have {:.3f}", said, share));
}

}  // namespace

void check_heads(const formats::DatasetInfo& info, const Shot& shot, Findings& findings) {
  const std::optional<double> shutter_px = shutter_slack_px(shot.image);
  for (const formats::Person& person : shot.image.people) {
    if (info.has(GroundTruth::heads) != person.record.contains("head_box")) {
      findings.add("schema", person, "head_box is missing, or not of this job");
    }
    if (!person.head_box) continue;
    if (shutter_px) check_head_place(shot, person, *shutter_px, findings);
    check_head_size(shot, person, findings);
    check_head_visibility(shot, person, findings);
  }
}

}  // namespace throng::checks
