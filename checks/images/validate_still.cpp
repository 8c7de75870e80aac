// Depth and ids of what stands still, seen from two places or at two times.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "base/compute/srgb.h"
#include "checks/shares.h"
#include "checks/shot.h"

namespace throng::checks {

namespace {

constexpr int kMaxSamples = 4000;

/// Depth and ids in the 3 x 3 pixels around one.
struct Patch {
  double near_m = 1e9;
  double far_m = 0;  ///< infinite where one of them is sky
  bool has_id = false;
  bool has_class = false;
};

Patch patch_at(const Pixels& pixels, int x, int y, std::uint32_t id, std::uint16_t surface) {
  Patch patch;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const std::size_t pixel = pixels.at(x + dx, y + dy);
      const double depth = pixels.depth_cm[pixel] == 0 ? 1e9 : pixels.depth_m(pixel);
      patch.near_m = std::min(patch.near_m, depth);
      patch.far_m = std::max(patch.far_m, depth);
      patch.has_id |= pixels.ids.empty() || pixels.ids[pixel] == id;
      patch.has_class |= pixels.semantic.empty() || pixels.semantic[pixel] == surface;
    }
  }
  return patch;
}

/// How the still points of one image look in another one.
struct Tally {
  std::size_t seen = 0;          ///< points within the other image
  std::size_t seen_through = 0;  ///< where it shows something farther
  std::size_t same_place = 0;    ///< where it shows that depth
  std::size_t other_id = 0;      ///< of these, with another id
  std::size_t other_class = 0;   ///< of these, with another class
};

using Tallies = std::map<std::uint32_t, Tally>;

void tally_point(const Shot& from, const Shot& to, int x, int y, Tallies& tallies) {
  const Pixels& pixels = from.pixels;
  const std::size_t pixel = pixels.at(x, y);
  const std::uint32_t id = pixels.ids[pixel];
  if (!is_still(id) || pixels.depth_cm[pixel] == 0) return;
  const double z = pixels.depth_m(pixel);
  const std::uint16_t surface = pixels.semantic.empty() ? 0 : pixels.semantic[pixel];
  const Patch here = patch_at(pixels, x, y, id, surface);
  // At an edge, or where the surface is seen from its side, a pixel says little.
  constexpr double kSmooth = 0.03;
  if (here.far_m - here.near_m > kSmooth * z) return;
  const Eigen::Vector3d point = from.point_at(x, y, z);
  if (!point.allFinite()) return;
  const auto seen = to.camera.project(point);
  if (!seen.visible || !(seen.depth_m > 0)) return;
  const int u = static_cast<int>(std::lround(seen.pixel.x()));
  const int v = static_cast<int>(std::lround(seen.pixel.y()));
  if (!to.pixels.holds(u, v, 1)) return;
  const Patch there = patch_at(to.pixels, u, v, id, surface);
  const double slack_m = 0.03 + 0.004 * seen.depth_m + (here.far_m - here.near_m);
  Tally& tally = tallies[id];
  ++tally.seen;
  if (there.near_m > seen.depth_m + slack_m) ++tally.seen_through;
  const std::size_t pixel_there = to.pixels.at(u, v);
  const bool is_there = to.pixels.depth_cm[pixel_there] != 0 &&
                        std::abs(to.pixels.depth_m(pixel_there) - seen.depth_m) <= slack_m &&
                        there.far_m - there.near_m <= kSmooth * seen.depth_m;
  if (!is_there) return;
  ++tally.same_place;
  if (!there.has_id) ++tally.other_id;
  const bool have_classes = !pixels.semantic.empty() && !to.pixels.semantic.empty();
  if (have_classes && there.has_id && !there.has_class) ++tally.other_class;
}

Tallies tally(const Shot& from, const Shot& to) {
  Tallies tallies;
  const Pixels& pixels = from.pixels;
  const int step =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(pixels.count()) / kMaxSamples)));
  for (int y = 1; y + 1 < pixels.height; y += step) {
    for (int x = 1 + y % step; x + 1 < pixels.width; x += step) {
      tally_point(from, to, x, y, tallies);
    }
  }
  return tallies;
}

std::string name_of_still(std::uint32_t id) {
  if (id == formats::kGround) return "the ground";
  return is_building(id) ? fmt::format("building {}", id - formats::kFirstBuilding)
                         : fmt::format("prop {}", id - formats::kFirstProp);
}

void judge(const Shot& from, const Shot& to, Findings& findings) {
  // Rounded pixels meet edges: a few in a hundred are off in sound images.
  constexpr double kMaxThrough = 0.25;
  constexpr double kMaxOtherId = 0.25;
  for (const auto& [id, tally] : tally(from, to)) {
    if (is_above_share(tally.seen_through, tally.seen, kMaxThrough)) {
      findings.add(
          "depth-agrees", raster_name("depth", to.image), to.record(),
          fmt::format("{} of {} points of {} that {} shows are seen through", tally.seen_through,
                      tally.seen, name_of_still(id), raster_name("depth", from.image)));
    }
    // If a surface is hidden nearly everywhere, all that remains visible is as far away as what
    // hides it.
    constexpr double kMaxHiding = 0.15;
    if (is_above_share(tally.other_id, tally.same_place, kMaxOtherId) &&
        is_above_share(tally.other_id, tally.seen, kMaxHiding)) {
      findings.add(
          "ids-agree", raster_name("instances", to.image), to.record(),
          fmt::format("{} of {} points that are {} in {} have another id", tally.other_id,
                      tally.same_place, name_of_still(id), raster_name("instances", from.image)));
    }
    if (is_above_share(tally.other_class, tally.same_place, kMaxOtherId)) {
      findings.add(
          "semantic", raster_name("semantic", to.image), to.record(),
          fmt::format("{} of {} points of {} have another class than in {}", tally.other_class,
                      tally.same_place, name_of_still(id), raster_name("semantic", from.image)));
    }
  }
}

bool has_geometry(const Shot& shot) {
  return shot.at_once && !shot.pixels.ids.empty() && !shot.pixels.depth_cm.empty();
}

/// Camera z at which a pixel's ray meets the ground.
std::optional<double> ground_depth_at(const Shot& shot, int x, int y) {
  const Eigen::Vector3d at = shot.point_at(x, y, 1);
  if (!at.allFinite()) return std::nullopt;
  const Eigen::Vector3d center = shot.camera.pose.center();
  const double down = center.z() - at.z();
  if (!(down > 1e-3)) return std::nullopt;
  return center.z() / down;
}

/// Whether the wall that a pixel shows ends at the depth of the ground below it; nullopt if the
/// pixel is not the foot of a wall. A foot is found along the image's vertical (the image of the
/// world's, which is not the columns' for steep cameras): ground is next below, and above the same
/// building at the same place on the ground, as only walls have it. The edges of roofs have ground
/// beside them, too, but far below.
std::optional<bool> wall_touches_ground(const Shot& shot, int x, int y) {
  const Pixels& pixels = shot.pixels;
  const std::size_t pixel = pixels.at(x, y);
  const double z = pixels.depth_m(pixel);
  const Eigen::Vector3d point = shot.point_at(x, y, z);
  if (!point.allFinite()) return std::nullopt;
  constexpr double kUpShare = 0.02;  // of the distance: some pixels
  const auto seen = shot.camera.project(point + Eigen::Vector3d(0, 0, kUpShare * std::max(z, 1.0)));
  const Eigen::Vector2d up = seen.pixel - Eigen::Vector2d(x, y);
  if (!seen.visible || !(up.norm() > 0.5)) return std::nullopt;  // looks straight down the wall
  const auto neighbor = [&](double steps) {
    const Eigen::Vector2d at = Eigen::Vector2d(x, y) + steps * up.normalized();
    return Eigen::Vector2i(static_cast<int>(std::lround(at.x())),
                           static_cast<int>(std::lround(at.y())));
  };
  const Eigen::Vector2i below = neighbor(-1);
  const Eigen::Vector2i above = neighbor(2);
  if (!pixels.holds(below.x(), below.y()) || !pixels.holds(above.x(), above.y())) {
    return std::nullopt;
  }
  const std::size_t higher = pixels.at(above.x(), above.y());
  if (pixels.ids[pixels.at(below.x(), below.y())] != formats::kGround ||
      pixels.ids[higher] != pixels.ids[pixel] || pixels.depth_cm[higher] == 0) {
    return std::nullopt;
  }
  const Eigen::Vector3d step = shot.point_at(above.x(), above.y(), pixels.depth_m(higher)) - point;
  constexpr double kUpright = 2;
  if (!(step.z() > kUpright * step.head<2>().norm())) return std::nullopt;
  const std::optional<double> ground = ground_depth_at(shot, x, y);
  const std::optional<double> nearer = ground_depth_at(shot, below.x(), below.y());
  if (!ground || !nearer) return std::nullopt;
  // The foot is somewhere between two pixels, of the ground and of the wall.
  const double per_pixel_m =
      std::max(std::abs(*ground - *nearer), 0.5 * std::abs(pixels.depth_m(higher) - z));
  return std::abs(z - *ground) <= 0.03 + 0.003 * z + 1.5 * per_pixel_m;
}

/// Equal exposure, and no vignette that makes it a matter of the place. Metered exposures of what
/// stays the same are nearly equal.
bool have_one_exposure(const formats::Image& a, const formats::Image& b) {
  const nlohmann::json one = a.record.value("sensor", nlohmann::json::object());
  const nlohmann::json two = b.record.value("sensor", nlohmann::json::object());
  constexpr double kMaxGainRatio = 1.1;
  const double gain_ratio = one.value("exposure_gain", 1.0) / two.value("exposure_gain", 1.0);
  return one.value("ev", 0.0) == two.value("ev", 0.0) && one.value("vignette", 0.0) == 0 &&
         gain_ratio < kMaxGainRatio && gain_ratio > 1 / kMaxGainRatio;
}

/// Variance of red minus blue of a pixel by the sensor's noise, as render/lens/sensor.cpp makes it.
double warm_variance(const nlohmann::json& sensor, const std::uint8_t* rgb) {
  const double iso = sensor.value("iso", 0.0);
  if (!(iso > 0)) return 0;
  constexpr double kBaseIso = 100;
  const double electrons = sensor.value("full_well_e", 0.0) * kBaseIso / iso;
  const double read_e = sensor.value("read_noise_e", 0.0);
  double variance = 0;
  for (const std::size_t c : {std::size_t{0}, std::size_t{2}}) {
    const double light = linear_from_srgb(rgb[c]);
    const double sigma = std::sqrt(light * electrons + read_e * read_e) / std::max(electrons, 1.0);
    // The curve of sRGB is steep where it is dark: the slope over one standard deviation.
    const double brighter = srgb_from_linear(static_cast<float>(light + sigma));
    variance += (brighter - rgb[c]) * (brighter - rgb[c]);
  }
  return variance;
}

/// A still point in two consecutive images of one camera.
struct StillPoint {
  double ratio = 1;      ///< of its luminance now and then
  double warm_then = 0;  ///< red minus blue
  double warm_now = 0;
  double noise_then = 0;  ///< variances of these
  double noise_now = 0;
};

std::vector<StillPoint> still_points(const Shot& before, const Shot& after) {
  const Pixels& pixels = before.pixels;
  const nlohmann::json sensor = before.image.record.value("sensor", nlohmann::json::object());
  const int step =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(pixels.count()) / kMaxSamples)));
  std::vector<StillPoint> points;
  for (int y = 1; y + 1 < pixels.height; y += step) {
    for (int x = 1 + y % step; x + 1 < pixels.width; x += step) {
      const std::size_t pixel = pixels.at(x, y);
      if (!is_still(pixels.ids[pixel]) || pixels.depth_cm[pixel] == 0) continue;
      const auto seen = after.camera.project(before.point_at(x, y, pixels.depth_m(pixel)));
      if (!seen.visible || !(seen.depth_m > 0)) continue;
      const int u = static_cast<int>(std::lround(seen.pixel.x()));
      const int v = static_cast<int>(std::lround(seen.pixel.y()));
      if (!after.pixels.holds(u, v) ||
          after.pixels.ids[after.pixels.at(u, v)] != pixels.ids[pixel]) {
        continue;
      }
      const std::uint8_t* a = &pixels.rgb[3 * pixel];
      const std::uint8_t* b = &after.pixels.rgb[3 * after.pixels.at(u, v)];
      constexpr double kDark = 1e-4;
      points.push_back({(after.pixels.luminance(after.pixels.at(u, v)) + kDark) /
                            (pixels.luminance(pixel) + kDark),
                        static_cast<double>(a[0]) - a[2], static_cast<double>(b[0]) - b[2],
                        warm_variance(sensor, a), warm_variance(sensor, b)});
    }
  }
  return points;
}

/// Colors of the same still points in consecutive images of one camera.
void compare_colors(const Shot& before, const Shot& after, Findings& findings) {
  if (before.pixels.rgb.empty() || after.pixels.rgb.empty()) return;
  std::vector<StillPoint> points = still_points(before, after);
  constexpr std::size_t kMinCount = 200;
  if (points.size() < kMinCount) return;
  // The shadow of somebody near may come over most of an image: a fifth of the points, those that
  // change least, tell. Light and exposure are a run's; a gentle vignette passes.
  constexpr double kMaxRatio = 1.35;
  const auto fifth = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 5);
  std::nth_element(points.begin(), fifth, points.end(),
                   [](const StillPoint& one, const StillPoint& other) {
                     return std::abs(std::log(one.ratio)) < std::abs(std::log(other.ratio));
                   });
  const double ratio = fifth->ratio;
  if (have_one_exposure(before.image, after.image) &&
      (ratio > kMaxRatio || ratio < 1 / kMaxRatio)) {
    findings.add(
        "image-brightness", after.image.file, after.record(),
        fmt::format("still points are {:.2f} times as bright as in the image before", ratio));
  }
  double both = 0;
  double then = 0;
  double now = 0;
  double noise = 0;
  double number = 0;
  for (const StillPoint& point : points) {
    // Sun and shadow have different colors.
    if (std::abs(std::log(point.ratio / ratio)) > std::log(kMaxRatio)) continue;
    both += point.warm_then * point.warm_now;
    then += point.warm_then * point.warm_then;
    now += point.warm_now * point.warm_now;
    noise += std::max(point.noise_then, point.noise_now);
    ++number;
  }
  if (number < kMinCount) return;
  const double strength = std::sqrt(std::max(then, now) / number);
  const double weakness = std::sqrt(std::min(then, now) / number);
  const double likeness = both / std::max(1e-9, std::sqrt(then * now));
  // Gray places say nothing, nor does noise, which is not the same in both images.
  constexpr double kColorful = 7;
  const double color = std::sqrt(std::max(0.0, strength * strength - noise / number));
  if (color < kColorful || color * color < noise / number ||
      (likeness > 0.3 && weakness > 0.3 * strength))
    return;
  findings.add("image-colors", after.image.file, after.record(),
               fmt::format("red minus blue of still points was {:.1f} (rms) in the image before "
                           "and is {:.1f}, with a correlation of {:.2f}",
                           std::sqrt(then / number), std::sqrt(now / number), likeness));
}

}  // namespace

void check_still_surfaces(const Shot& a, const Shot& b, Findings& findings) {
  if (!has_geometry(a) || !has_geometry(b)) return;
  judge(a, b, findings);
  judge(b, a, findings);
  if (a.image.camera == b.image.camera) compare_colors(a, b, findings);
}

void check_buildings(const Shot& shot, Findings& findings) {
  if (!has_geometry(shot)) return;
  const Pixels& pixels = shot.pixels;
  struct Foot {
    std::size_t looked_at = 0;
    std::size_t touching = 0;
    std::size_t points = 0;
    std::size_t below = 0;
  };
  std::map<std::uint32_t, Foot> feet;
  constexpr int kStep = 3;
  for (int y = 1; y + 1 < pixels.height; ++y) {
    for (int x = 1; x + 1 < pixels.width; ++x) {
      const std::size_t pixel = pixels.at(x, y);
      const std::uint32_t id = pixels.ids[pixel];
      if (!is_building(id) || pixels.depth_cm[pixel] == 0) continue;
      if (x % kStep == 0 && y % kStep == 0) {
        const double z = pixels.depth_m(pixel);
        const Eigen::Vector3d point = shot.point_at(x, y, z);
        Foot& foot = feet[id];
        ++foot.points;
        if (point.z() < -0.05 - 0.004 * z) ++foot.below;
      }
      if (const std::optional<bool> touches = wall_touches_ground(shot, x, y)) {
        ++feet[id].looked_at;
        if (*touches) ++feet[id].touching;
      }
    }
  }
  Foot all;
  for (const auto& [id, foot] : feet) {
    all.looked_at += foot.looked_at;
    all.touching += foot.touching;
    constexpr double kMaxBelow = 0.02;
    if (is_above_share(foot.below, foot.points, kMaxBelow)) {
      findings.add("depth-of-buildings", raster_name("depth", shot.image), shot.record(),
                   fmt::format("{} of {} pixels of {} are below the ground", foot.below,
                               foot.points, name_of_still(id)));
    }
  }
  // Doorways and steps have other feet; most of an image's walls do not.
  constexpr std::size_t kMinCount = 40;
  if (all.looked_at >= kMinCount &&
      static_cast<double>(all.touching) < 0.25 * static_cast<double>(all.looked_at)) {
    findings.add("depth-of-buildings", raster_name("depth", shot.image), shot.record(),
                 fmt::format("buildings stand on the ground at {} of {} pixels of their feet only",
                             all.touching, all.looked_at));
  }
}

}  // namespace throng::checks
