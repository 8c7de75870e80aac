// Files that follow from what the records say of cameras, and the values of parts and normals.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "camera/files.h"
#include "checks/findings.h"
#include "checks/ground_truth_checks.h"
#include "checks/pixels.h"
#include "formats/dataset/image_camera.h"
#include "formats/dataset/instances.h"

namespace throng::checks {

namespace fs = std::filesystem;
using nlohmann::json;

void check_camera_files(const formats::DatasetInfo& info, const formats::Image& image,
                        Findings& findings) {
  const std::string place = fmt::format("cameras/{}/{}", image.run, image.camera);
  if (!fs::exists(info.root / (place + ".opencv.yaml"))) return;
  const camera::Intrinsics lens = formats::image_camera(image).intrinsics;
  const auto compare = [&](const std::string& path, const std::string& expected) {
    if (fs::is_regular_file(info.root / path) && read_file(info.root / path) == expected) return;
    findings.add("camera", path, fmt::format("image {}", image.id),
                 "not the lens that the image's record has");
  };
  compare(place + ".opencv.yaml", camera::opencv_yaml(lens));
  compare(place + ".ros.yaml", camera::ros_yaml(lens, image.camera));
}

namespace {

/// Pixels whose values of a kind are wrong, as one finding.
template <typename IsGood>
void check_samples(const char* kind, const formats::Image& image, const Pixels& pixels,
                   const std::vector<std::uint16_t>& samples, std::size_t channels,
                   const char* what, Findings& findings, const IsGood& is_good) {
  if (samples.empty()) return;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < pixels.ids.size(); ++i) {
    wrong += is_good(pixels.ids[i], &samples[i * channels]) ? 0 : 1;
  }
  if (wrong == 0) return;
  findings.add(kind, raster_name(kind, image), fmt::format("image {}", image.id),
               fmt::format("{} pixels {}", wrong, what));
}

/// A body that is whole and not small shows several parts.
void check_several_parts(const formats::Image& image, const Pixels& pixels, Findings& findings) {
  constexpr std::size_t kParts = 10;
  std::map<std::uint32_t, std::array<std::size_t, kParts>> counts;
  for (std::size_t i = 0; i < pixels.count(); ++i) {
    if (formats::is_person(pixels.ids[i]) && pixels.parts[i] < kParts) {
      ++counts[pixels.ids[i]].at(pixels.parts[i]);
    }
  }
  for (const formats::Person& person : image.people) {
    constexpr double kMinAreaPx = 150;
    constexpr double kMinVisibility = 0.9;
    constexpr double kMaxShare = 0.95;
    const auto found = counts.find(instance_id(person));
    if (found == counts.end() || person.area < kMinAreaPx || person.truncation > 0 ||
        person.visibility < kMinVisibility) {
      continue;
    }
    const auto largest = std::max_element(found->second.begin(), found->second.end());
    if (static_cast<double>(*largest) <= kMaxShare * person.area) continue;
    findings.add("parts", raster_name("parts", image), fmt::format("annotation {}", person.id),
                 fmt::format("{} of {} pixels of a whole body are of part {}", *largest,
                             person.area, largest - found->second.begin()));
    return;
  }
}

}  // namespace

void check_parts(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                 const Pixels& pixels, Findings& findings) {
  check_samples("parts", image, pixels, pixels.parts, 1,
                "are of no person, or of one without a part", findings,
                [](std::uint32_t id, const std::uint16_t* part) {
                  constexpr std::uint16_t kLastPart = 9;
                  return (part[0] > 0) == formats::is_person(id) && part[0] <= kLastPart;
                });
  if (!pixels.parts.empty() && !pixels.ids.empty()) check_several_parts(image, pixels, findings);
}

void check_normal_lengths(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                          const Pixels& pixels, Findings& findings) {
  check_samples("normals", image, pixels, pixels.normals, 3,
                "have no normal of length 1, or one although they show the sky", findings,
                [](std::uint32_t id, const std::uint16_t* n) {
                  if (id == 0) return n[0] == 0 && n[1] == 0 && n[2] == 0;
                  constexpr double kScale = 127;
                  double sum = 0;
                  for (int c = 0; c < 3; ++c) {
                    const double value = (n[c] - 128.0) / kScale;
                    sum += value * value;
                  }
                  return std::abs(std::sqrt(sum) - 1) < 0.05;
                });
}

}  // namespace throng::checks
