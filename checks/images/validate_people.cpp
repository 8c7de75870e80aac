// Each annotation of an image by itself: boxes, masks, visibility, keypoints in the image.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "annotate/people/person_record.h"
#include "base/error.h"
#include "checks/body_slack.h"
#include "checks/findings.h"
#include "formats/dataset/image_camera.h"
#include "formats/dataset/mask.h"

namespace throng::checks {

namespace {

/// False if there is no mask to look at.
bool check_mask(const formats::Image& image, const formats::Person& person, Findings& findings) {
  const auto pixels =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  const nlohmann::json& size = person.record.at("segmentation").at("size");
  if (size != nlohmann::json{image.height, image.width}) {
    findings.add("mask-size", person, "the mask's size is not the image's: " + size.dump());
    return false;
  }
  formats::Bitmap mask;
  try {
    mask = formats::decode_bitmap(formats::decode_runs(person.mask, pixels), image.height);
  } catch (const InputError& error) {
    findings.add("mask-runs", person, error.problems().front().expected);
    return false;
  }
  const formats::Box& box = person.box;
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
void check_whole_mask(const formats::Image& image, const formats::Person& person,
                      Findings& findings) {
  const auto found = person.record.find("amodal_segmentation");
  if (found == person.record.end()) return;
  const auto pixels =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  formats::Bitmap whole;
  try {
    whole = formats::decode_bitmap(
        formats::decode_runs(found->at("counts").get<std::string>(), pixels), image.height);
  } catch (const InputError& error) {
    findings.add("mask-runs", person, error.problems().front().expected);
    return;
  }
  const formats::Bitmap mask =
      formats::decode_bitmap(formats::decode_runs(person.mask, pixels), image.height);
  for (int y = mask.y; y < mask.y + mask.height; ++y) {
    for (int x = mask.x; x < mask.x + mask.width; ++x) {
      if (!mask.at(x, y) || whole.at(x, y)) continue;
      findings.add("visible-in-amodal", person, "the visible mask leaves amodal_segmentation");
      return;
    }
  }
  const double area = person.record.at("area_amodal").get<double>();
  const auto covered = static_cast<double>(whole.area());
  const formats::Box& box = person.amodal;
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

void check_box(const formats::Image& image, const formats::Person& person, Findings& findings) {
  const formats::Box& box = person.box;
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

void check_visibility(const formats::Person& person, Findings& findings) {
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
int expected_category(const formats::Person& object) {
  if (object.number_in_run() > annotate::kFirstDroneNumber) return annotate::kDroneCategory;
  if (object.number_in_run() <= annotate::kFirstVehicleNumber) return annotate::kPersonCategory;
  const std::string vehicle = object.track->value("vehicle", "");
  for (const annotate::ObjectCategory& known : annotate::kObjectCategories) {
    if (known.name == vehicle) return known.id;
  }
  return 0;
}

void check_category(const formats::Person& object, Findings& findings) {
  const int expected = expected_category(object);
  if (object.record.at("category_id") == expected) return;
  findings.add("category", object,
               fmt::format("category {}, expected {}", object.record.at("category_id").dump(),
                           expected == 0 ? "that of its track" : std::to_string(expected)));
}

/// Whether the mask shows somebody within a pixel of a place, and one more for its rounding.
bool shows_near(const formats::Bitmap& mask, const formats::Keypoint& point) {
  constexpr int kReach = 2;
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      if (mask.at(static_cast<int>(point.x) + x, static_cast<int>(point.y) + y)) return true;
    }
  }
  return false;
}

void check_visible_keypoints(const formats::Image& image, const formats::Person& person,
                             Findings& findings) {
  if (std::none_of(person.keypoints.begin(), person.keypoints.end(),
                   [](const formats::Keypoint& point) { return point.visibility == 2; })) {
    return;
  }
  const auto pixels =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  const formats::Bitmap mask =
      formats::decode_bitmap(formats::decode_runs(person.mask, pixels), image.height);
  for (const formats::Keypoint& point : person.keypoints) {
    if (point.visibility != 2 || shows_near(mask, point)) continue;
    findings.add("keypoints", person, "a visible keypoint away from the mask");
  }
}

void check_keypoints(const formats::Image& image, const formats::Person& person,
                     Findings& findings) {
  if (person.keypoints.empty()) return;
  const double slack_px = keypoint_slack_px(formats::image_camera(image), person);
  int labeled = 0;
  for (const formats::Keypoint& point : person.keypoints) {
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

}  // namespace

void check_people(const formats::Image& image, Findings& findings) {
  for (const formats::Person& person : list_objects(image)) {
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
    const auto truncated = std::count_if(
        image.people.begin(), image.people.end(),
        [](const formats::Person& person) { return person.record.contains("truncation"); });
    if (counts->at("visible") != image.people.size() ||
        counts->at("all") != image.people.size() + image.hidden.size() ||
        counts->at("truncated") != truncated ||
        counts->value("drones", 0U) + counts->value("vehicles", 0U) != image.objects.size()) {
      findings.add(
          "counts", formats::kCocoFile, fmt::format("image {}", image.id),
          fmt::format("counts {}, but {} have annotations and {} are hidden, {} are truncated",
                      counts->dump(), image.people.size(), image.hidden.size(), truncated));
    }
  }
}

}  // namespace throng::checks
