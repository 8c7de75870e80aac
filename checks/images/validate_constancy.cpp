// Values that do not change: environment, lens, bones, and what the tracks say of people.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "annotate/people/color_name.h"
#include "base/geometry/angle.h"
#include "base/text/words.h"
#include "checks/run_checks.h"
#include "formats/files/json_vectors.h"
#include "skinning/wardrobe/clothes.h"

namespace throng::checks {

using nlohmann::json;

namespace {

/// Pairs of COCO's keypoints on one bone, and by how much their distance may vary (m): bones are
/// blended between poses, so that limbs in fast motion shrink.
struct Bone {
  std::size_t from;
  std::size_t to;
  double slack_m;
};
constexpr std::array<Bone, 10> kBones = {{{0, 1, 0.03},
                                          {0, 2, 0.03},
                                          {1, 2, 0.03},
                                          {3, 4, 0.04},
                                          {5, 6, 0.04},
                                          {11, 12, 0.04},
                                          {11, 13, 0.08},
                                          {12, 14, 0.08},
                                          // Arms that are thrown up come down in a linear blend,
                                          // by 140 degrees: a third of their length is left.
                                          {5, 7, 0.17},
                                          {6, 8, 0.17}}};

/// The bytes of "#rrggbb".
std::optional<std::array<std::uint8_t, 3>> rgb_of_hex(const std::string& text) {
  if (text.size() != 7 || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdef", 1) != std::string::npos) {
    return std::nullopt;
  }
  std::array<std::uint8_t, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    constexpr int kHexadecimal = 16;
    rgb[c] = static_cast<std::uint8_t>(std::stoi(text.substr(1 + 2 * c, 2), nullptr, kHexadecimal));
  }
  return rgb;
}

/// Direction of the sun: Spencer's declination, solar time. Azimuth counter-clockwise from east.
struct SunPosition {
  double azimuth_deg;
  double elevation_deg;
};

SunPosition sun_position(double hours, double latitude_deg, double day_of_year) {
  const double day = 2 * EIGEN_PI * (day_of_year - 1) / 365;
  const double declination = 0.006918 - 0.399912 * std::cos(day) + 0.070257 * std::sin(day) -
                             0.006758 * std::cos(2 * day) + 0.000907 * std::sin(2 * day) -
                             0.002697 * std::cos(3 * day) + 0.00148 * std::sin(3 * day);
  const double latitude = latitude_deg * kDegree;
  const double angle = (hours - 12) * 15 * kDegree;
  const double east = -std::cos(declination) * std::sin(angle);
  const double north = std::cos(latitude) * std::sin(declination) -
                       std::sin(latitude) * std::cos(declination) * std::cos(angle);
  const double up = std::sin(latitude) * std::sin(declination) +
                    std::cos(latitude) * std::cos(declination) * std::cos(angle);
  return {std::atan2(north, east) / kDegree, std::asin(std::clamp(up, -1.0, 1.0)) / kDegree};
}

const char* age_band(double years) {
  return years < 13 ? "child" : years < 18 ? "teenager" : years < 65 ? "adult" : "senior";
}

bool contains_follow(std::string_view text) {
  return lower_case(text).find("follow") != std::string::npos;
}

/// Speeds that contradict states; "" if none does. Speeds are rounded.
std::string wrong_speed(const std::string& state, double speed_mps) {
  constexpr double kRounding = 0.01;
  constexpr double kStanding = 0.2;
  constexpr double kRunning = 2.07;
  if (state == "waiting" && speed_mps > kStanding + kRounding) return "above 0.2 m/s";
  if ((state == "walking" || state == "running" || state == "following") &&
      speed_mps < kStanding - kRounding) {
    return "below 0.2 m/s";
  }
  if (state == "walking" && speed_mps > kRunning + kRounding) return "above 2.07 m/s";
  if (state == "running" && speed_mps < kRunning - kRounding) return "below 2.07 m/s";
  return "";
}

/// `clothes` says what `wears`, `carries` and the colors of the tracks say.
void check_clothes(const json& attributes, const std::function<void(const std::string&)>& fault) {
  std::string worn;
  std::string carried = "nothing";
  for (const json& clothing : attributes.at("clothes")) {
    const std::string slot = clothing.at("slot");
    const std::string type = clothing.at("type");
    if (slot == "carried") {
      carried = type;
    } else {
      worn += (worn.empty() ? "" : ", ") + fmt::format("{} ({})", type, slot);
    }
    const std::string color = clothing.value("colour", "");
    const auto rgb = rgb_of_hex(color);
    if (color.empty() ? clothing.contains("colour_name")
                      : !rgb || clothing.at("colour_name") != annotate::color_name(rgb->data())) {
      fault(fmt::format("name and value of the color of {} differ", clothing.dump()));
    }
    const bool is_upper = slot == "upper" || slot == "whole";
    const char* key = is_upper ? "top_colour" : slot == "lower" ? "bottom_colour" : "shoes_colour";
    if (slot != "carried" && !color.empty() && attributes.value(key, "") != color) {
      fault(fmt::format("the color of {} is not that of {}", clothing.dump(), key));
    }
  }
  if (carried != attributes.at("carries")) {
    fault(fmt::format("clothes have {} carried, but carries is {}", carried,
                      attributes.at("carries").dump()));
  }
  const std::string wears = attributes.at("wears");
  std::string known;
  for (const skinning::Clothing& clothing : skinning::clothes_in(wears)) {
    known += (known.empty() ? "" : ", ") +
             fmt::format("{} ({})", clothing.type, to_string(clothing.slot));
  }
  if (worn != known) fault(fmt::format("clothes are {}, but wears is {}", worn, known));
}

}  // namespace

void ConstancyCheck::check_environment(const formats::Image& image, Findings& findings) {
  const auto environment = image.record.find("environment");
  if (environment == image.record.end()) return;
  const std::string record = fmt::format("image {}", image.id);
  for (const json& run : manifest_.at("runs")) {
    if (run.at("run") != image.run || !run.contains("environment")) continue;
    if (run.at("environment") != *environment) {
      findings.add("environment", formats::kCocoFile, record, "environment is not the manifest's");
    }
    const json drawn = image.record.value("drawn", json::object());
    const json drawn_for_run = run.value("drawn", json::object());
    for (const auto& [path, value] : drawn_for_run.items()) {
      if (drawn.contains(path) && drawn.at(path) == value) continue;
      findings.add("environment", formats::kCocoFile, record,
                   fmt::format("drawn {} is not the manifest's {}", path, value.dump()));
    }
  }
  if (!environment->contains("time_of_day")) return;
  const std::string clock = environment->at("time_of_day");
  if (clock.size() != 5) return;
  const double hours = std::atoi(clock.c_str()) + std::atoi(clock.c_str() + 3) / 60.0;
  const SunPosition sun = sun_position(hours, environment->at("latitude_deg").get<double>(),
                                       environment->at("day_of_year").get<double>());
  const double azimuth_off =
      std::remainder(environment->at("sun_azimuth_deg").get<double>() - sun.azimuth_deg, 360);
  const double elevation_off =
      environment->at("sun_elevation_deg").get<double>() - sun.elevation_deg;
  if (std::abs(azimuth_off) > 0.1 || std::abs(elevation_off) > 0.1) {
    findings.add("environment", formats::kCocoFile, record,
                 fmt::format("the sun is not where time, day and latitude put it, azimuth {:.2f}, "
                             "elevation {:.2f} degrees",
                             sun.azimuth_deg, sun.elevation_deg));
  }
}

void ConstancyCheck::check_camera(const formats::Image& image, Findings& findings) {
  json lens = image.record.at("camera");
  for (const char* pose : {"R", "t", "centre"}) lens.erase(pose);
  lens["size"] = {image.width, image.height};
  const auto [known, is_new] = lenses_.try_emplace(image.run + "/" + image.camera, lens);
  if (!is_new && known->second != lens) {
    findings.add("camera", formats::kCocoFile, fmt::format("image {}", image.id),
                 "another lens or size than the camera's images before");
  }
  if (!frames_[image.run + "/" + image.camera].insert(image.frame).second) {
    findings.add("ids", formats::kCocoFile, fmt::format("image {}", image.id),
                 fmt::format("frame {} of {} comes twice", image.frame, image.sequence()));
  }
}

void ConstancyCheck::check_person(const formats::Person& person, Findings& findings) {
  if (person.record.contains("state")) {
    const double speed = person.velocity.norm();
    const std::string wrong = wrong_speed(person.state, speed);
    if (!wrong.empty()) {
      findings.add("state", person,
                   fmt::format("{} at {:.2f} m/s, {}", person.state, speed, wrong));
    }
    const std::string behavior = person.record.value("behaviour", "");
    const bool follows = contains_follow(behavior);
    if ((person.state == "following" && !follows) ||
        (follows && (person.state == "walking" || person.state == "running"))) {
      findings.add("state", person, fmt::format("{} with behavior \"{}\"", person.state, behavior));
    }
  }
  const auto keypoints = person.record.find("keypoints_3d");
  if (keypoints == person.record.end()) return;
  std::vector<double> lengths;
  lengths.reserve(std::size(kBones));
  for (const Bone& bone : kBones) {
    lengths.push_back((formats::numbers_at<3>(keypoints->at(bone.from)) -
                       formats::numbers_at<3>(keypoints->at(bone.to)))
                          .norm());
  }
  const auto [known, is_new] = bones_.try_emplace(person.track_id, lengths);
  for (std::size_t i = 0; !is_new && i < lengths.size(); ++i) {
    if (std::abs(lengths[i] - known->second[i]) <= kBones.at(i).slack_m) continue;
    findings.add(
        "bones", person,
        fmt::format("keypoints {} and {} are {:.2f} m apart, in another image {:.2f} m",
                    kBones.at(i).from + 1, kBones.at(i).to + 1, lengths[i], known->second[i]));
    return;
  }
}

void ConstancyCheck::check_track(const formats::Image& image, const formats::Person& person,
                                 Findings& findings) {
  if (!tracks_.insert(person.track_id).second) return;
  if (person.track->value("run", image.run) != image.run) {
    findings.add("ids", formats::kCocoFile, fmt::format("track {}", person.track_id),
                 "its run is not that of its images");
  }
  const auto attributes = person.track->find("attributes");
  if (attributes == person.track->end()) return;
  const auto fault = [&](const std::string& what) {
    findings.add("attributes", formats::kCocoFile, fmt::format("track {}", person.track_id), what);
  };
  const double years = attributes->at("age_years").get<double>();
  if (attributes->at("age_band") != age_band(years)) {
    fault(fmt::format("age_band {} at {} years", attributes->at("age_band").dump(), years));
  }
  const double stature_m = attributes->at("stature_m").get<double>();
  const double upright = person.box_size.head<2>().maxCoeff();
  // Headgear and hair add a little; people who lie, bend or sit have a lower box.
  const double height_m = person.box_size.z();
  // Walkers neither raise their arms nor bend; people on a stand move as they get up, too.
  constexpr double kOnStandM = 0.05;
  const bool is_upright =
      person.state == "walking" && height_m > 1.5 * upright && person.position.z() < kOnStandM;
  const double highest_m = is_upright ? 1.1 * stature_m : stature_m + 0.35;
  const double lowest_m = is_upright ? 0.88 * stature_m : 0;
  if (height_m > highest_m || height_m < lowest_m) {
    fault(fmt::format("stature_m {}, but box_3d of annotation {} is {:.2f} m high", stature_m,
                      person.id, height_m));
  }
  // A character is known by its name, in datasets of earlier versions by stature and age.
  json others = *attributes;
  for (auto it = others.begin(); it != others.end();) {
    const std::string& key = it.key();
    const bool is_dyed = key.size() > 7 && key.substr(key.size() - 7) == "_colour";
    it = is_dyed ? others.erase(it) : std::next(it);
  }
  if (const auto clothes = others.find("clothes"); clothes != others.end()) {
    check_clothes(*attributes, fault);
    for (json& clothing : *clothes) {
      for (const char* dyed : {"colour", "colour_name"}) clothing.erase(dyed);
    }
  }
  const std::string key = attributes->value("character", fmt::format("{}/{}", stature_m, years));
  const auto [known, is_new] = characters_.try_emplace(key, person.track_id, others);
  if (!is_new && known->second.second != others) {
    fault(fmt::format("attributes {} contradict those of track {}, the same character: {}",
                      others.dump(), known->second.first, known->second.second.dump()));
  }
}

/// Most characters who wear women's clothes are female, and so are some where anybody wears them. A
/// user's own library may have a few others.
void ConstancyCheck::check_sexes(Findings& findings) const {
  constexpr std::array kOfWomen = {"dress", "skirt", "straight skirt", "blouse"};
  std::size_t wearers = 0;
  std::size_t males = 0;
  bool has_females = false;
  for (const auto& [character, known] : characters_) {
    has_females = has_females || known.second.value("sex", "") == "female";
    const json clothes = known.second.value("clothes", json::array());
    const bool wears = std::any_of(clothes.begin(), clothes.end(), [&](const json& clothing) {
      return std::find(kOfWomen.begin(), kOfWomen.end(), clothing.value("type", "")) !=
             kOfWomen.end();
    });
    if (!wears) continue;
    ++wearers;
    males += known.second.value("sex", "") == "male" ? 1 : 0;
  }
  constexpr std::size_t kMinWearers = 3;
  constexpr std::size_t kMinCharacters = 6;
  const bool are_mostly_male = wearers >= kMinWearers && 2 * males > wearers;
  const bool are_all_male = males > 0 && !has_females && characters_.size() >= kMinCharacters;
  if (!are_mostly_male && !are_all_male) return;
  findings.add("attributes", formats::kCocoFile, "tracks",
               fmt::format("sex is male of {} of {} characters who wear dresses, skirts or blouses",
                           males, wearers));
}

void ConstancyCheck::add(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                         Findings& findings) {
  check_environment(image, findings);
  check_camera(image, findings);
  for (const formats::Person& person : image.people) {
    check_person(person, findings);
    check_track(image, person, findings);
    tracks_of_run_[image.run].insert(person.track_id);
  }
}

void ConstancyCheck::finish(const formats::DatasetInfo& info, Findings& findings) {
  check_sexes(findings);
  for (const auto& [series, frames] : frames_) {
    if (static_cast<std::int64_t>(frames.size()) == info.frames_per_camera &&
        *frames.begin() == 0 && *frames.rbegin() + 1 == info.frames_per_camera) {
      continue;
    }
    findings.add("time", formats::kCocoFile, series,
                 fmt::format("{} frames from {} to {}, expected 0 to {}", frames.size(),
                             *frames.begin(), *frames.rbegin(), info.frames_per_camera - 1));
  }
  for (const json& run : manifest_.at("runs")) {
    const auto tracks = tracks_of_run_.find(run.at("run").get<std::string>());
    if (!run.contains("agents")) continue;
    const std::size_t found = tracks == tracks_of_run_.end() ? 0 : tracks->second.size();
    if (run.at("agents") == found) continue;
    findings.add("counts", formats::kCocoFile, run.at("run").get<std::string>(),
                 fmt::format("{} people have annotations, but the manifest says {}", found,
                             run.at("agents").dump()));
  }
}

}  // namespace throng::checks
