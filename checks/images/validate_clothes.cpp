// Colors of clothes in the tracks against those in the images.
//
// What an image shows of a shirt is its color times the light, more or less veiled. So the colors
// themselves are not compared, but whose shirt is redder or bluer than the others': over many
// people, label and image agree.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/compute/srgb.h"
#include "checks/median.h"
#include "checks/shot.h"

namespace throng::checks {

namespace {

constexpr std::uint16_t kTorso = 2;
constexpr std::uint16_t kCarriedItem = 9;

constexpr double kDark = 0.005;
/// Cloth reflects up to so much of the light without giving it its color (Fresnel's share of 4 %).
constexpr double kGloss = 0.05;

/// Redness and blueness against green, of linear light to which some without color is added.
Eigen::Vector2d chromaticity(const Eigen::Vector3d& rgb, double added = kDark) {
  const Eigen::Vector3d light = (rgb.array() + added).log();
  return {light[0] - light[1], light[2] - light[1]};
}

std::optional<Eigen::Vector3d> recorded_color(const nlohmann::json& track) {
  const std::string text =
      track.value("attributes", nlohmann::json::object()).value("top_colour", "");
  if (text.size() != 7 || text.find_first_not_of("0123456789abcdef", 1) != std::string::npos) {
    return std::nullopt;
  }
  Eigen::Vector3d rgb;
  for (int c = 0; c < 3; ++c) {
    const std::string byte = text.substr(1 + 2 * static_cast<std::size_t>(c), 2);
    rgb[c] = linear_from_srgb(static_cast<std::uint8_t>(std::stoi(byte, nullptr, 16)));
  }
  return rgb;
}

/// Distance of a point from a segment.
double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                           const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double share = (point - from).dot(along) / std::max(1e-12, along.squaredNorm());
  return (from + std::clamp(share, 0.0, 1.0) * along - point).norm();
}

/// Somebody's top: chroma of the label and of the image.
struct Top {
  std::int64_t track;
  Eigen::Vector2d label;
  Eigen::Vector2d glossy_label;  ///< with the most gloss, which makes dark tops gray
  Eigen::Vector2d image;
};

/// Images show the colors of labels less saturated, by one factor for all people of a run, and in
/// one light: nobody's is far from that. Fitted by medians, so that one wrong label does not spoil
/// it.
void check_single_tops(std::vector<Top> tops, const std::string& run, Findings& findings) {
  constexpr std::size_t kMinPeople = 12;
  if (tops.size() < kMinPeople) return;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> labels;
    std::vector<double> images;
    for (const Top& top : tops) {
      labels.push_back(top.label[axis]);
      images.push_back(top.image[axis]);
    }
    const double label = median(std::move(labels));
    const double image = median(std::move(images));
    for (Top& top : tops) {
      top.label[axis] -= label;
      top.glossy_label[axis] -= label;
      top.image[axis] -= image;
    }
  }
  std::vector<double> slopes;
  constexpr double kColorful = 0.5;
  for (const Top& top : tops) {
    if (top.label.norm() < kColorful) continue;
    slopes.push_back(top.image.dot(top.label) / top.label.squaredNorm());
  }
  constexpr std::size_t kMinColorful = 4;
  if (slopes.size() < kMinColorful) return;
  const double slope = median(std::move(slopes));
  constexpr double kMinSlope = 0.25;  // by night and in fog colors say little
  if (slope < kMinSlope) return;
  for (const Top& top : tops) {
    const double off = distance_to_segment(top.image, slope * top.label, slope * top.glossy_label);
    constexpr double kMaxOff = 1.2;  // sound runs of 12 kinds: up to 0.8
    if (off <= kMaxOff) continue;
    findings.add("colors-are-clothes", formats::kCocoFile, fmt::format("track {}", top.track),
                 fmt::format("top_colour is not that of the torso in the images of {}: {:.1f} off "
                             "in redness and blueness (natural logarithms)",
                             run, off));
  }
}

/// Sound runs have correlations above 0.7. That of a few people is less by chance: three standard
/// errors below, by Fisher's transformation.
double min_correlation(double people) {
  constexpr double kSound = 0.7;
  constexpr double kMaxMinimum = 0.35;
  return std::min(kMaxMinimum, std::tanh(std::atanh(kSound) - 3 / std::sqrt(people - 3)));
}

/// Whether a pixel has only that torso around it. Others have some of the color of what is beside:
/// JPEG has half of the image's resolution in color, and interpolates between its samples.
bool is_inside_torso(const Pixels& pixels, std::size_t pixel) {
  constexpr int kAroundPx = 2;
  const auto width = static_cast<std::size_t>(pixels.width);
  const int x = static_cast<int>(pixel % width);
  const int y = static_cast<int>(pixel / width);
  if (!pixels.holds(x, y, kAroundPx)) return false;
  for (int v = y - kAroundPx; v <= y + kAroundPx; ++v) {
    for (int u = x - kAroundPx; u <= x + kAroundPx; ++u) {
      const std::size_t other = pixels.at(u, v);
      if (pixels.ids[other] != pixels.ids[pixel] || pixels.parts[other] != kTorso) return false;
    }
  }
  return true;
}

/// The color temperature of white in an image.
double white_balance_k(const formats::Image& image) {
  constexpr double kDaylightK = 6500;
  return image.record.value("sensor", nlohmann::json::object())
      .value("white_balance_k", kDaylightK);
}

/// Whether all people are in the light of one color, so that differences are those of clothes. A
/// low sun is red and the shadows beside are blue; by night each lamp lights those near it.
bool is_in_one_light(const formats::Image& image) {
  const nlohmann::json environment = image.record.value("environment", nlohmann::json::object());
  constexpr double kLowSunDeg = 5;
  const double elevation_deg = environment.value("sun_elevation_deg", 90.0);
  return elevation_deg > (environment.value("weather", "clear") == "clear" ? kLowSunDeg : 0.0);
}

}  // namespace

void ClothesCheck::add(const Shot& shot) {
  const Pixels& pixels = shot.pixels;
  if (pixels.rgb.empty() || pixels.parts.empty() || pixels.ids.empty()) return;
  const bool is_one_light = is_in_one_light(shot.image);
  std::map<std::uint32_t, const formats::Person*> people;
  for (const formats::Person& person : shot.image.people) people[instance_id(person)] = &person;
  for (std::size_t i = 0; i < pixels.parts.size(); ++i) {
    if (pixels.parts[i] != kTorso && pixels.parts[i] != kCarriedItem) continue;
    const auto person = people.find(pixels.ids[i]);
    if (person == people.end()) continue;
    if (pixels.parts[i] == kCarriedItem) {
      ++carried_[person->second->track_id];
      const auto attributes = person->second->track->find("attributes");
      if (attributes != person->second->track->end() &&
          attributes->value("carries", "") == "nothing") {
        without_item_.insert(person->second->track_id);
      }
      continue;
    }
    if (!is_one_light) continue;
    Shirt& shirt = runs_[{shot.image.run, white_balance_k(shot.image)}][person->second->track_id];
    if (shirt.pixels++ == 0) shirt.label = recorded_color(*person->second->track);
    Eigen::Vector3d light;
    for (int c = 0; c < 3; ++c) {
      light[c] = linear_from_srgb(pixels.rgb[3 * i + static_cast<std::size_t>(c)]);
    }
    shirt.sum += light;
    if (!is_inside_torso(pixels, i)) continue;
    shirt.inner_sum += light;
    ++shirt.inner_pixels;
  }
}

void ClothesCheck::finish(Findings& findings) const {
  for (const std::int64_t track : without_item_) {
    findings.add("attributes", formats::kCocoFile, fmt::format("track {}", track),
                 fmt::format("carries nothing, but parts/ has {} pixels of a carried item",
                             carried_.at(track)));
  }
  for (const auto& [run_and_white, shirts] : runs_) {
    const std::string& run = run_and_white.first;
    std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> pairs;  // label, image
    Eigen::Vector2d mean_label = Eigen::Vector2d::Zero();
    Eigen::Vector2d mean_image = Eigen::Vector2d::Zero();
    constexpr std::size_t kMinPixels = 60;
    constexpr std::size_t kManyPixels = 60;
    std::vector<Top> tops;
    for (const auto& [track, shirt] : shirts) {
      if (shirt.pixels < kMinPixels || !shirt.label) continue;
      pairs.emplace_back(chromaticity(*shirt.label),
                         chromaticity(shirt.sum / static_cast<double>(shirt.pixels)));
      if (shirt.inner_pixels >= kManyPixels) {
        tops.push_back({track, pairs.back().first, chromaticity(*shirt.label, kGloss),
                        chromaticity(shirt.inner_sum / static_cast<double>(shirt.inner_pixels))});
      }
      mean_label += pairs.back().first;
      mean_image += pairs.back().second;
    }
    check_single_tops(std::move(tops), run, findings);
    constexpr std::size_t kMinPeople = 15;
    if (pairs.size() < kMinPeople) continue;
    const auto count = static_cast<double>(pairs.size());
    double both = 0;
    double labels = 0;
    double images = 0;
    for (const auto& [label, image] : pairs) {
      const Eigen::Vector2d a = label - mean_label / count;
      const Eigen::Vector2d b = image - mean_image / count;
      both += a.dot(b);
      labels += a.squaredNorm();
      images += b.squaredNorm();
    }
    const double correlation = both / std::max(1e-9, std::sqrt(labels * images));
    // Gray shirts, and images without color by night, say nothing.
    constexpr double kColorful = 0.4;
    constexpr double kColorfulImage = 0.1;
    if (std::sqrt(labels / count) < kColorful || std::sqrt(images / count) < kColorfulImage ||
        correlation >= min_correlation(count)) {
      continue;
    }
    findings.add("colors-are-clothes", formats::kCocoFile, run,
                 fmt::format("top_colour of {} people and the colors of their torsos in the "
                             "images have a correlation of {:.2f}",
                             pairs.size(), correlation));
  }
}

}  // namespace throng::checks
