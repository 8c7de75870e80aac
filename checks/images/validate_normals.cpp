// Normals against the surface that the depth shows.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "base/geometry/angle.h"
#include "checks/median.h"
#include "checks/shares.h"
#include "checks/shot.h"

namespace throng::checks {

namespace {

enum class Kind : std::uint8_t { ground, building, prop, person };
constexpr std::array kKindNames = {"the ground", "buildings", "props", "people"};

std::optional<Kind> surface_kind(std::uint32_t id) {
  if (id == formats::kGround) return Kind::ground;
  if (is_building(id)) return Kind::building;
  if (id >= formats::kFirstProp && id < formats::kFirstDrone) return Kind::prop;
  if (formats::is_person(id)) return Kind::person;
  return std::nullopt;
}

Eigen::Vector3d normal_at(const Pixels& pixels, std::size_t pixel) {
  constexpr double kZero = 128;
  constexpr double kScale = 127;
  const std::uint16_t* n = &pixels.normals[3 * pixel];
  return Eigen::Vector3d(n[0] - kZero, n[1] - kZero, n[2] - kZero) / kScale;
}

/// The normal of the plane through the points `reach` pixels away on all four sides, facing the
/// camera; nothing where they are of something else or no plane.
std::optional<Eigen::Vector3d> normal_by_depth(const Shot& shot, int x, int y, int reach) {
  const Pixels& pixels = shot.pixels;
  if (!pixels.holds(x, y, reach)) return std::nullopt;
  const std::uint32_t id = pixels.ids[pixels.at(x, y)];
  std::array<Eigen::Vector3d, 5> points;
  const std::array<std::array<int, 2>, 5> offsets = {
      {{0, 0}, {-reach, 0}, {reach, 0}, {0, -reach}, {0, reach}}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int u = x + offsets[i][0];
    const int v = y + offsets[i][1];
    const std::size_t pixel = pixels.at(u, v);
    if (pixels.ids[pixel] != id || pixels.depth_cm[pixel] == 0) return std::nullopt;
    points[i] = shot.point_at(u, v, pixels.depth_m(pixel));
    if (!points[i].allFinite()) return std::nullopt;
  }
  const Eigen::Vector3d across = points[2] - points[1];
  const Eigen::Vector3d down = points[4] - points[3];
  const double size = std::min(across.norm(), down.norm());
  // Depth is in whole centimeters: a small patch has no direction.
  constexpr double kMinSizeM = 0.15;
  const auto bend = [&](std::size_t a, std::size_t b) {
    return (0.5 * (points[a] + points[b]) - points[0]).norm();
  };
  if (size < kMinSizeM || bend(1, 2) > 0.06 * size || bend(3, 4) > 0.06 * size) return std::nullopt;
  Eigen::Vector3d normal = across.cross(down).normalized();
  if (normal.dot(points[0] - shot.camera.pose.center()) > 0) normal = -normal;
  return normal;
}

/// Whether normals along both axes of a patch are those of its middle: between the steps of stands
/// and the leaves of trees, depth has another slope than any of them.
bool is_one_face(const Pixels& pixels, int x, int y, int reach) {
  constexpr double kAlike = 0.95;
  const Eigen::Vector3d middle = normal_at(pixels, pixels.at(x, y)).normalized();
  for (int off = -reach; off <= reach; ++off) {
    for (const std::size_t pixel : {pixels.at(x + off, y), pixels.at(x, y + off)}) {
      if (normal_at(pixels, pixel).normalized().dot(middle) < kAlike) return false;
    }
  }
  return true;
}

struct NormalTally {
  std::size_t looked_at = 0;
  std::size_t away = 0;    ///< from the camera
  std::size_t not_up = 0;  ///< of the ground
  std::size_t flat = 0;    ///< exactly upwards
  std::vector<double> angles_rad;
};

/// Looks at up to about 20 000 pixels, by the kind of surface that they show.
std::map<Kind, NormalTally> tally_normals(const Shot& shot) {
  const Pixels& pixels = shot.pixels;
  constexpr int kMaxPoints = 20000;
  const int step =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(pixels.count()) / kMaxPoints)));
  std::map<Kind, NormalTally> tallies;
  const Eigen::Vector3d center = shot.camera.pose.center();
  for (int y = 1; y < pixels.height; y += step) {
    for (int x = 1 + y % step; x < pixels.width; x += step) {
      const std::size_t pixel = pixels.at(x, y);
      const std::optional<Kind> kind = surface_kind(pixels.ids[pixel]);
      if (!kind || pixels.depth_cm[pixel] == 0) continue;
      const Eigen::Vector3d ray = shot.point_at(x, y, 1) - center;
      if (!ray.allFinite()) continue;
      const Eigen::Vector3d normal = normal_at(pixels, pixel);
      NormalTally& tally = tallies[*kind];
      ++tally.looked_at;
      // Edge on, rounding decides.
      if (normal.dot(ray.normalized()) > 0.1) ++tally.away;
      constexpr double kUp = 0.95;
      if (normal.z() < kUp) ++tally.not_up;
      const std::uint16_t* written = &pixels.normals[3 * pixel];
      if (written[0] == 128 && written[1] == 128 && written[2] == 255) ++tally.flat;
      const int reach = *kind == Kind::person ? 2 : 4;
      const auto by_depth = normal_by_depth(shot, x, y, reach);
      if (by_depth && (*kind != Kind::prop || is_one_face(pixels, x, y, reach))) {
        tally.angles_rad.push_back(
            std::acos(std::clamp(by_depth->dot(normal.normalized()), -1.0, 1.0)));
      }
    }
  }
  return tallies;
}

void judge_normals(const Shot& shot, Kind kind, NormalTally& tally, Findings& findings) {
  const char* name = kKindNames.at(static_cast<std::size_t>(kind));
  const std::string file = raster_name("normals", shot.image);
  const double max_away = kind == Kind::person ? 0.25 : 0.05;
  if (is_above_share(tally.away, tally.looked_at, max_away)) {
    findings.add("normals-face-camera", file, shot.record(),
                 fmt::format("{} of {} pixels of {} face away from the camera", tally.away,
                             tally.looked_at, name));
  }
  // At the edge of something nearer, a pixel of the ground may have another normal.
  if (kind == Kind::ground && is_above_share(tally.not_up, tally.looked_at, 0.04)) {
    findings.add("normals-are-surface", file, shot.record(),
                 fmt::format("normals of {} of {} pixels of the ground do not point up",
                             tally.not_up, tally.looked_at));
  }
  // Bodies are round: what is exactly flat is the ground of another image.
  if (kind == Kind::person && is_above_share(tally.flat, tally.looked_at, 0.15)) {
    findings.add("normals-are-surface", file, shot.record(),
                 fmt::format("normals of {} of {} pixels of people are those of flat ground",
                             tally.flat, tally.looked_at));
  }
  constexpr std::size_t kMinCount = 40;  // fewer may be of one body
  if (tally.angles_rad.size() < kMinCount) return;
  const double angle_rad = median(tally.angles_rad);
  // People are round, and props have small faces.
  const double max_rad = kind == Kind::prop ? 0.9 : kind == Kind::person ? 0.6 : 0.09;
  if (angle_rad > max_rad + median_error(tally.angles_rad)) {
    findings.add("normals-are-surface", file, shot.record(),
                 fmt::format("normals of {} are {:.1f} degrees off the surface that the depth "
                             "shows (median of {})",
                             name, angle_rad / kDegree, tally.angles_rad.size()));
  }
}

}  // namespace

void check_normals(const Shot& shot, Findings& findings) {
  const Pixels& pixels = shot.pixels;
  if (!shot.at_once || pixels.normals.empty() || pixels.ids.empty() || pixels.depth_cm.empty()) {
    return;
  }
  std::map<Kind, NormalTally> tallies = tally_normals(shot);
  for (auto& [kind, tally] : tallies) judge_normals(shot, kind, tally, findings);
}

}  // namespace throng::checks
