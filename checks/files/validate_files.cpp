#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "checks/findings.h"
#include "checks/ground_truth_checks.h"
#include "checks/pixels.h"
#include "formats/dataset/instances.h"
#include "formats/dataset/mask.h"
#include "formats/files/npy.h"

namespace throng::checks {

namespace fs = std::filesystem;

namespace {

/// Whether a pixel of the image of instances shows what has an annotation.
bool is_labeled(std::uint32_t id) {
  return formats::is_person(id) || (id >= formats::kFirstDrone && id < formats::kGround);
}

std::string relative(const formats::DatasetInfo& info, const fs::path& path) {
  return path.lexically_relative(info.root).string();
}

void check_map(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings) {
  const auto file = image.record.find("density_file");
  if (file == image.record.end()) return;
  const std::string path = *file;
  const formats::FloatMap map = formats::read_npy(info.root / path);
  const double sum = std::accumulate(map.value.begin(), map.value.end(), 0.0);
  const double count = image.record.at("density_count").get<double>();
  if (map.width != image.width || map.height != image.height) {
    findings.add("density-size", path, "", "another size than the image's");
    return;
  }
  if (!(std::abs(sum - count) <= 1e-3 * std::max(count, 1.0))) {
    findings.add("density-sum", path, "",
                 fmt::format("the map sums to {}, but density_count is {}", sum, count));
  }
  const bool has_negative =
      std::any_of(map.value.begin(), map.value.end(), [](float value) { return !(value >= 0); });
  if (has_negative) findings.add("density-sum", path, "", "a value below 0 or not a number");
  check_density_is_heads(image, path, map, info.density_sigma_px, findings);
}

}  // namespace

std::uint32_t instance_id(const formats::Person& object) {
  const auto number = object.number_in_run();
  if (number > annotate::kFirstDroneNumber) {
    return static_cast<std::uint32_t>(formats::kFirstDrone + number - annotate::kFirstDroneNumber -
                                      1);
  }
  if (number > annotate::kFirstVehicleNumber) {
    return formats::kFirstProp + object.track->value("prop", 0U);
  }
  return static_cast<std::uint32_t>(number);
}

namespace {

/// Instances that have annotations: people, drones and, if the dataset has their labels, vehicles.
class LabeledIds {
 public:
  explicit LabeledIds(const formats::Image& image) {
    for (const formats::Person& object : image.objects) {
      if (object.track->contains("vehicle")) vehicles_.insert(instance_id(object));
    }
  }
  bool contains(std::uint32_t id) const {
    if (is_labeled(id)) return true;
    return id >= formats::kFirstProp && id < formats::kFirstDrone && vehicles_.contains(id);
  }

 private:
  std::set<std::uint32_t> vehicles_;
};

}  // namespace

void check_density(const formats::DatasetInfo& info, const formats::Image& image,
                   const Pixels& /*pixels*/, Findings& findings) {
  try {
    check_map(info, image, findings);
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    findings.add("density-sum", relative(info, problem.source), problem.where, problem.found);
  }
}

void check_instances(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                     const Pixels& values, Findings& findings) {
  const std::vector<std::uint32_t>& ids = values.ids;
  if (ids.empty()) return;
  const std::string path = raster_name("instances", image);
  std::map<std::uint32_t, std::uint64_t> areas;
  const LabeledIds labeled(image);
  for (const std::uint32_t id : ids) {
    if (labeled.contains(id)) ++areas[id];
  }
  const auto pixels =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  for (const formats::Person& person : list_objects(image)) {
    const std::uint32_t id = instance_id(person);
    const formats::Bitmap mask =
        formats::decode_bitmap(formats::decode_runs(person.mask, pixels), image.height);
    std::size_t wrong = 0;
    for (int y = mask.y; y < mask.y + mask.height; ++y) {
      for (int x = mask.x; x < mask.x + mask.width; ++x) {
        const bool shows = ids[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(x)] == id;
        wrong += shows == mask.at(x, y) ? 0 : 1;
      }
    }
    if (wrong > 0 || areas[id] != mask.area()) {
      findings.add("instances-are-masks", path, fmt::format("annotation {}", person.id),
                   fmt::format("instance {} has {} pixels, the mask {}; {} differ in its bounds",
                               id, areas[id], mask.area(), wrong));
    }
    areas.erase(id);
  }
  for (const auto& [id, area] : areas) {
    findings.add("instances-are-masks", path, fmt::format("instance {}", id),
                 fmt::format("{} pixels, but nobody has an annotation", area));
  }
}

void check_depth(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                 const Pixels& pixels, Findings& findings) {
  if (pixels.ids.empty() || pixels.depth_cm.empty()) return;
  const std::string path = raster_name("depth", image);
  const std::vector<std::uint32_t>& ids = pixels.ids;
  if (is_plain(image)) check_ground_depth(image, path, ids, pixels.depth_cm, findings);
  std::size_t in_sky = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) in_sky += ids[i] == 0 && pixels.depth_cm[i] != 0;
  if (in_sky > 0) {
    findings.add("depth", path, "", fmt::format("{} pixels of the sky have a depth", in_sky));
  }
  std::map<std::uint32_t, std::pair<double, double>> range;  // nearest and farthest, m
  const LabeledIds labeled(image);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!labeled.contains(ids[i])) continue;
    const double z = pixels.depth_m(i);
    auto& [low, high] =
        range.try_emplace(ids[i], std::numeric_limits<double>::infinity(), 0.0).first->second;
    low = std::min(low, z);
    high = std::max(high, z);
  }
  // Rounding of depth and boxes; a rolling shutter sees a person at several times.
  const double slack_m = is_shot_at_once(image) ? 0.03 : 1;
  for (const formats::Person& person : list_objects(image)) {
    const auto found = range.find(instance_id(person));
    if (found == range.end()) continue;  // a finding of another rule
    const Eigen::RowVectorXd z = corners_in_camera(image, person).row(2);
    const auto& [low, high] = found->second;
    // A lens's pixels have the depth of the nearest pixel's surface along their own ray.
    const double lens_m = is_plain(image) ? 0 : 0.01 * z.maxCoeff();
    if (low < z.minCoeff() - slack_m - lens_m || high > z.maxCoeff() + slack_m + lens_m) {
      findings.add("depth", path, fmt::format("annotation {}", person.id),
                   fmt::format("{:.2f} to {:.2f} m inside the mask, but the person is {:.2f} to "
                               "{:.2f} m away",
                               low, high, z.minCoeff(), z.maxCoeff()));
    }
  }
}

void check_flow_values(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                       const Pixels& pixels, Findings& findings) {
  const auto check_plane = [&](const char* kind, const std::vector<std::uint16_t>& samples) {
    for (std::size_t i = 0; i < samples.size(); i += 3) {
      const std::uint16_t* pixel = samples.data() + i;
      if (pixel[2] == 1 || (pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0)) continue;
      findings.add("flow", raster_name(kind, image), fmt::format("pixel {}", i / 3),
                   "neither known nor all 0");
      return;
    }
  };
  check_plane("flow", pixels.flow);
  check_plane("flow_backward", pixels.flow_backward);
}

void check_flow_occlusion_values(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                                 const Pixels& pixels, Findings& findings) {
  constexpr std::uint16_t kMaxTarget = 3;
  const auto found = std::find_if(pixels.flow_occlusion.begin(), pixels.flow_occlusion.end(),
                                  [](std::uint16_t value) { return value > kMaxTarget; });
  if (found == pixels.flow_occlusion.end()) return;
  findings.add("flow-occlusion", raster_name("flow_occlusion", image),
               fmt::format("pixel {}", found - pixels.flow_occlusion.begin()),
               fmt::format("{}, expected 0 to {}", *found, kMaxTarget));
}

void check_scene_flow_values(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                             const Pixels& pixels, Findings& findings) {
  for (std::size_t i = 0; i < pixels.scene_flow.size(); i += 3) {
    const std::uint16_t* pixel = pixels.scene_flow.data() + i;
    const auto zeros = std::count(pixel, pixel + 3, 0);
    if (zeros == 0 || zeros == 3) continue;
    findings.add("scene-flow", raster_name("scene_flow", image), fmt::format("pixel {}", i / 3),
                 "neither known nor all 0");
    return;
  }
}

}  // namespace throng::checks
