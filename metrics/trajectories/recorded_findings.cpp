#include "metrics/trajectories/recorded_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <string>

#include "base/geometry/polygon.h"
#include "base/text/words.h"
#include "metrics/trajectories/recorded.h"
#include "metrics/trajectories/text_encoding.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kMaxHumanMps = 12;  // sprinters reach 12.4 for a moment
constexpr double kInsideM = 0.2;     // less is a matter of calibration

/// The buildings near a place, by cells of a grid over all of them.
class BuildingGrid {
 public:
  /// Expects at least one building.
  explicit BuildingGrid(const std::vector<world::Building>& buildings) : buildings_(buildings) {
    all_ = geometry::bounding_box(buildings.front().footprint);
    for (const world::Building& building : buildings) {
      all_.extend(geometry::bounding_box(building.footprint));
    }
    for (std::size_t i = 0; i < buildings.size(); ++i) {
      const world::Rectangle box = geometry::bounding_box(buildings[i].footprint);
      for (std::size_t y = cell(box.min, 1); y <= cell(box.max, 1); ++y) {
        for (std::size_t x = cell(box.min, 0); x <= cell(box.max, 0); ++x) {
          cells_[y * kSide + x].push_back(i);
        }
      }
    }
  }

  /// The index of the building that a place is well inside of, or -1.
  int building_around(const Vector2d& place) const {
    if (!all_.contains(place)) return -1;
    for (const std::size_t i : cells_[cell(place, 1) * kSide + cell(place, 0)]) {
      if (geometry::signed_distance_to(buildings_[i].footprint, place) < -kInsideM) {
        return static_cast<int>(i);
      }
    }
    return -1;
  }

 private:
  static constexpr std::size_t kSide = 64;

  std::size_t cell(const Vector2d& place, int axis) const {
    const double share = (place[axis] - all_.min[axis]) / (all_.max[axis] - all_.min[axis]);
    return static_cast<std::size_t>(std::clamp(share * kSide, 0.0, static_cast<double>(kSide - 1)));
  }

  const std::vector<world::Building>& buildings_;
  world::Rectangle all_;
  std::array<std::vector<std::size_t>, kSide * kSide> cells_;
};

}  // namespace

void note_jumps(const Recorded& recorded, double unit_m, std::vector<Problem>& notes) {
  std::size_t jumps = 0;
  std::set<std::int64_t> people;
  double fastest_mps = 0;
  std::string where;
  for (const auto& [id, places] : recorded.places) {
    for (auto now = places.begin(); now != places.end(); ++now) {
      const auto next = std::next(now);
      if (next == places.end()) break;
      const auto frames = static_cast<double>(next->first - now->first);
      const double speed_mps =
          unit_m * (next->second - now->second).norm() * recorded.frames_per_s / frames;
      if (!(speed_mps > kMaxHumanMps)) continue;
      ++jumps;
      people.insert(id);
      if (speed_mps <= fastest_mps) continue;
      fastest_mps = speed_mps;
      const auto name = recorded.names.find(id);
      where =
          fmt::format("person {} from frame {} to {}",
                      name == recorded.names.end() ? fmt::format("{}", id) : shown(name->second),
                      now->first, next->first);
    }
  }
  if (jumps == 0) return;
  notes.push_back(
      {"", "",
       fmt::format("{} of {} faster than {:g} m/s, the fastest with {:.4g} m/s: {}",
                   counted(static_cast<std::int64_t>(jumps), "step"),
                   counted(static_cast<std::int64_t>(people.size()), "person", "people"),
                   kMaxHumanMps, fastest_mps, where),
       "an id for each person, used once, and the file's frame rate and unit"});
}

std::vector<Problem> find_people_in_buildings(const world::Trace& recording,
                                              const world::Scenario& scenario) {
  if (scenario.buildings.empty()) return {};
  const BuildingGrid grid(scenario.buildings);
  std::set<std::size_t> people;
  std::vector<std::set<std::size_t>> of_building(scenario.buildings.size());
  std::size_t frames = 0;
  for (std::size_t step = 0; step < recording.steps(); ++step) {
    bool is_any_inside = false;
    for (std::size_t agent = 0; agent < recording.agents(); ++agent) {
      if (!recording.present(step, agent)) continue;
      const int building =
          grid.building_around(recording.position[recording.at(step, agent)].cast<double>());
      if (building < 0) continue;
      is_any_inside = true;
      people.insert(agent);
      of_building[static_cast<std::size_t>(building)].insert(agent);
    }
    frames += is_any_inside ? 1 : 0;
  }
  if (people.empty()) return {};
  constexpr std::size_t kMaxNamed = 3;
  std::string names;
  std::size_t entered = 0;
  for (std::size_t i = 0; i < of_building.size(); ++i) {
    if (of_building[i].empty() || ++entered > kMaxNamed) continue;
    names += fmt::format("{}\"{}\" ({})", names.empty() ? "" : ", ", scenario.buildings[i].id,
                         of_building[i].size());
  }
  if (entered > kMaxNamed) names += fmt::format(" and {} others", entered - kMaxNamed);
  return {{"", "",
           fmt::format("{} of {} recorded people inside of buildings, in {} of {} frames: {}",
                       people.size(), recording.agents(), frames, recording.steps(), names),
           fmt::format("people outside of them: does the file have the coordinates of {}?",
                       scenario.id)}};
}

}  // namespace throng::metrics
