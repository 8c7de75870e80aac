// Classes of surfaces by where they are: the land around the ground, doors at exits, walls, whose
// tops are seen from above, and markings on roads.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/compute/quantile.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "checks/median.h"
#include "checks/shares.h"
#include "checks/shot.h"
#include "formats/files/json_vectors.h"
#include "world/semantic_class.h"

namespace throng::checks {

using Eigen::Vector2d;
using Eigen::Vector3d;
using nlohmann::json;
using world::SemanticClass;

namespace {

constexpr double kClearM = 0.5;  ///< distance from the ground's border that rounded depth permits

SemanticClass surface_class(const Pixels& pixels, std::size_t pixel) {
  return static_cast<SemanticClass>(pixels.semantic[pixel]);
}

/// The z of a pixel's normal.
double upness(const Pixels& pixels, std::size_t pixel) {
  return (pixels.normals[3 * pixel + 2] - 128.0) / 127.0;
}

}  // namespace

const PlaceCheck::Areas& PlaceCheck::areas_of(const formats::DatasetInfo& info,
                                              const std::string& run) {
  const auto [entry, is_new] = areas_.try_emplace(run);
  const std::filesystem::path file = info.root / "counts" / (run + ".json");
  if (!is_new || !std::filesystem::is_regular_file(file)) return entry->second;
  const json recorded = parse_own_json(read_file(file), file.string());
  Areas& areas = entry->second;
  for (const json& zone : recorded.at("zones")) {
    if (zone.at("id") != "ground") continue;
    for (const json& corner : zone.at("corners"))
      areas.ground.extend(formats::numbers_at<2>(corner));
  }
  for (const json& line : recorded.at("lines")) {
    areas.exits[line.at("id").get<std::string>()] = {formats::numbers_at<2>(line.at("start")),
                                                     formats::numbers_at<2>(line.at("end"))};
  }
  return areas;
}

/// Counts land and other classes around the ground and on it.
void PlaceCheck::look_at_land(const Shot& shot, const Areas& areas) {
  if (areas.ground.isEmpty()) return;
  const Pixels& pixels = shot.pixels;
  Land& land = land_[shot.image.run];
  for (int y = 0; y < pixels.height; y += 2) {
    for (int x = 0; x < pixels.width; x += 2) {
      const std::size_t pixel = pixels.at(x, y);
      if (pixels.ids[pixel] != formats::kGround || pixels.depth_cm[pixel] == 0) continue;
      const double z = pixels.depth_m(pixel);
      const Vector3d point = shot.point_at(x, y, z);
      if (!point.allFinite()) continue;
      // Depth is rounded to a centimeter, and rows at the horizon are meters apart.
      const Vector3d beside = shot.point_at(x, y, 1.01 * z + 0.02);
      const double off_m = kClearM + (beside - point).head<2>().norm();
      const double away_m = areas.ground.exteriorDistance(point.head<2>().eval());
      const Vector2d edge =
          (point.head<2>() - areas.ground.min()).cwiseMin(areas.ground.max() - point.head<2>());
      const bool is_on = away_m == 0 && edge.minCoeff() > off_m;
      if (!is_on && away_m < off_m) continue;
      const bool is_land = surface_class(pixels, pixel) == SemanticClass::terrain;
      ++land.looked_at.at(is_on ? 1 : 0);
      if (is_land == is_on && land.wrong.at(is_on ? 1 : 0)++ == 0) {
        land.files.at(is_on ? 1 : 0) = raster_name("semantic", shot.image);
      }
    }
  }
}

/// Some land lies around the ground, beside roads and paths that lead away, and none on it.
void PlaceCheck::report_land(Findings& findings) const {
  constexpr std::array kMaxShare = {0.8, 0.1};
  for (const auto& [run, land] : land_) {
    for (const std::size_t on : {0U, 1U}) {
      if (!is_above_share(land.wrong.at(on), land.looked_at.at(on), kMaxShare.at(on))) continue;
      findings.add(
          "semantic", land.files.at(on), run,
          fmt::format(
              "{} of {} pixels {} terrain", land.wrong.at(on), land.looked_at.at(on),
              on == 1 ? "on the scenario's ground are" : "around the scenario's ground are not"));
    }
  }
}

namespace {

/// The wall that an exit lies in, as an image shows it.
struct ExitWall {
  static constexpr std::size_t kParts = 10;
  std::string exit;
  Vector2d from = Vector2d::Zero();
  Vector2d along = Vector2d::Zero();  ///< of length 1
  double length_m = 0;
  std::array<std::size_t, kParts> parts{};  ///< pixels by their place along the exit
  WrongTally no_door;

  void add(const Vector3d& point, const Vector2d& normal, bool is_door) {
    constexpr double kOffM = 0.45;
    constexpr double kMinFacing = 0.98;  // sides of a passage stand across the exit
    const Vector2d across(-along.y(), along.x());
    const Vector2d off = point.head<2>() - from;
    const double share = off.dot(along) / length_m;
    if (!(share > 0.1 && share < 0.9) || std::abs(off.dot(across)) > kOffM ||
        std::abs(normal.dot(across)) < kMinFacing) {
      return;
    }
    ++parts.at(static_cast<std::size_t>(share * kParts));
    no_door.add(!is_door);
  }
  /// Whether the wall is there along the whole width, but for the ends: beside a gap only some of
  /// the width has a wall, and no door.
  bool is_whole() const {
    return std::all_of(parts.begin() + 1, parts.end() - 1,
                       [](std::size_t count) { return count > 0; });
  }
};

}  // namespace

/// A wall that an exit lies in along its width has the exit's door there, and nothing else.
void PlaceCheck::check_doors(const Shot& shot, const Areas& areas, Findings& findings) {
  std::vector<ExitWall> walls;
  for (const auto& [id, line] : areas.exits) {
    const double length_m = (line.second - line.first).norm();
    if (!(length_m > 0)) continue;
    walls.push_back({id, line.first, (line.second - line.first) / length_m, length_m, {}, {}});
  }
  const Pixels& pixels = shot.pixels;
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      constexpr double kLowM = 0.3;
      constexpr double kHighM = 2;
      constexpr double kUpright = 0.2;
      const std::size_t pixel = pixels.at(x, y);
      if (!is_building(pixels.ids[pixel]) || pixels.depth_cm[pixel] == 0 ||
          std::abs(upness(pixels, pixel)) > kUpright) {
        continue;
      }
      const Vector3d point = shot.point_at(x, y, pixels.depth_m(pixel));
      if (!(point.z() > kLowM && point.z() < kHighM)) continue;
      const Vector2d normal(pixels.normals[3 * pixel] - 128.0,
                            pixels.normals[3 * pixel + 1] - 128.0);
      for (ExitWall& wall : walls) {
        wall.add(point, normal / 127, surface_class(pixels, pixel) == SemanticClass::door);
      }
    }
  }
  for (const ExitWall& wall : walls) {
    constexpr double kMaxShare = 0.3;
    if (!wall.is_whole() ||
        !is_above_share(wall.no_door.wrong, wall.no_door.looked_at, kMaxShare)) {
      continue;
    }
    findings.add("semantic", raster_name("semantic", shot.image), shot.record(),
                 fmt::format("{} of {} pixels of the wall that exit {} lies in are no door",
                             wall.no_door.wrong, wall.no_door.looked_at, wall.exit));
  }
}

/// Counts the pixels of each building that face up.
void PlaceCheck::look_at_tops(const Shot& shot) {
  const Pixels& pixels = shot.pixels;
  for (std::size_t pixel = 0; pixel < pixels.count(); ++pixel) {
    constexpr double kUp = 0.9;
    if (!is_building(pixels.ids[pixel]) || upness(pixels, pixel) < kUp) continue;
    Tops& tops = tops_[{shot.image.scenario() + shot.image.run, pixels.ids[pixel]}];
    ++tops.looked_at;
    if (surface_class(pixels, pixel) == SemanticClass::building && tops.facades++ == 0) {
      tops.file = raster_name("semantic", shot.image);
      tops.record = shot.record();
    }
  }
}

/// The ground two pixels beside paint: nearer ones may be of both.
void PlaceCheck::look_at_paint(const Shot& shot) {
  const Pixels& pixels = shot.pixels;
  constexpr int kBesidePx = 2;
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      const std::size_t pixel = pixels.at(x, y);
      if (surface_class(pixels, pixel) != SemanticClass::marking) continue;
      for (const auto& [dx, dy] : {std::pair(kBesidePx, 0), std::pair(-kBesidePx, 0),
                                   std::pair(0, kBesidePx), std::pair(0, -kBesidePx)}) {
        if (!pixels.holds(x + dx, y + dy)) continue;
        const std::size_t other = pixels.at(x + dx, y + dy);
        const SemanticClass beside = surface_class(pixels, other);
        const bool is_pavement = beside == SemanticClass::pavement;
        if (!is_pavement && beside != SemanticClass::road) continue;
        Paint& paint = paint_[shot.image.run];
        ++paint.looked_at;
        if (!is_pavement) continue;
        if (paint.on_pavement++ == 0) {
          paint.file = raster_name("semantic", shot.image);
          paint.record = shot.record();
        }
        constexpr double kDark = 1e-3;
        paint.contrasts.push_back((pixels.luminance(pixel) + kDark) /
                                  (pixels.luminance(other) + kDark));
      }
    }
  }
}

/// Paint may be on any ground, as the lines of platforms are, but it is 3.6 times as bright as the
/// asphalt of roads, half of which is left in small images, and less than 1.7 times as bright as
/// what is pavement; both are in one light.
void PlaceCheck::report_paint(Findings& findings) const {
  constexpr double kMaxPaved = 0.4;
  constexpr double kMinOfAsphalt = 1.8;
  for (const auto& [run, paint] : paint_) {
    const double error = median_error(paint.contrasts);
    if (!std::isfinite(error) || median(paint.contrasts) - error < kMinOfAsphalt ||
        !is_above_share(paint.on_pavement, paint.looked_at, kMaxPaved)) {
      continue;
    }
    findings.add("semantic", paint.file, paint.record,
                 fmt::format("{} of {} pixels beside markings are pavement in {}, but as dark as "
                             "roads: markings are {:.1f} times as bright",
                             paint.on_pavement, paint.looked_at, run, median(paint.contrasts)));
  }
}

void PlaceCheck::add(const formats::DatasetInfo& info, const Shot& shot, Findings& findings) {
  const Pixels& pixels = shot.pixels;
  if (pixels.semantic.empty() || pixels.ids.empty() || !shot.at_once) return;
  if (!pixels.normals.empty()) look_at_tops(shot);
  if (!pixels.rgb.empty()) look_at_paint(shot);
  if (pixels.depth_cm.empty() || !info.has(annotate::GroundTruth::counts)) return;
  const Areas& areas = areas_of(info, shot.image.run);
  look_at_land(shot, areas);
  if (!pixels.normals.empty()) check_doors(shot, areas, findings);
}

void PlaceCheck::finish(Findings& findings) const {
  report_paint(findings);
  report_land(findings);
  for (const auto& [building, tops] : tops_) {
    constexpr double kMaxShare = 0.3;
    if (!is_above_share(tops.facades, tops.looked_at, kMaxShare)) continue;
    findings.add(
        "semantic", tops.file, tops.record,
        fmt::format("{} of {} pixels of building {} that face up are a facade, expected "
                    "roof, wall or hedge",
                    tops.facades, tops.looked_at, building.second - formats::kFirstBuilding));
  }
}

}  // namespace throng::checks
