// Fields on the ground against the people that the records place there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "checks/run_checks.h"
#include "formats/dataset/run_events.h"
#include "formats/dataset/run_trajectories.h"
#include "formats/files/npy.h"
#include "world/trace.h"

namespace throng::checks {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using nlohmann::json;

namespace {

struct Grid {
  Vector2d origin_m;
  double cell_m = 0;
  double kernel_m = 0;
  int rows = 0;
  int columns = 0;

  std::size_t cells() const {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  }
};

/// Planes of fields/RUN/FRAME.npy.
struct FlowField {
  std::vector<float> values;
  std::size_t cells = 0;

  double density(std::size_t i) const { return static_cast<double>(values[i]); }
  Vector2d velocity(std::size_t i) const {
    return {static_cast<double>(values[cells + i]), static_cast<double>(values[2 * cells + i])};
  }
  double voronoi(std::size_t i) const { return static_cast<double>(values[3 * cells + i]); }
};

FlowField read_field(const fs::path& file, const Grid& grid) {
  constexpr std::size_t kPlanes = 4;
  return {formats::read_npy(file, {kPlanes, static_cast<std::size_t>(grid.rows),
                                   static_cast<std::size_t>(grid.columns)}),
          grid.cells()};
}

/// People in each cell of a level, by points of the finer grid's cells, each of which stands for an
/// equal part of its cell.
std::vector<double> people_of_level(const Grid& fine, const FlowField& field, const Grid& level) {
  constexpr int kPoints = 8;  // along a cell's side
  const double part_m2 = fine.cell_m * fine.cell_m / (kPoints * kPoints);
  std::vector<double> people(level.cells());
  const auto cell_of = [&](int index, double cell_m, int count) {
    const double place_m = (index + 0.5) / kPoints * fine.cell_m;
    return static_cast<std::size_t>(std::min(static_cast<int>(place_m / cell_m), count - 1));
  };
  for (int y = 0; y < fine.rows * kPoints; ++y) {
    for (int x = 0; x < fine.columns * kPoints; ++x) {
      const double density = field.density(static_cast<std::size_t>(y / kPoints) *
                                               static_cast<std::size_t>(fine.columns) +
                                           static_cast<std::size_t>(x / kPoints));
      people[cell_of(y, level.cell_m, level.rows) * static_cast<std::size_t>(level.columns) +
             cell_of(x, level.cell_m, level.columns)] += density * part_m2;
    }
  }
  return people;
}

/// Density and momentum of the people whom cameras see, without buildings.
struct Share {
  std::vector<double> density;
  std::vector<Vector2d> momentum;
};

template <typename People>
Share smoothed_share(const People& people, const Grid& grid) {
  Share share{std::vector<double>(grid.cells()),
              std::vector<Vector2d>(grid.cells(), Vector2d::Zero())};
  constexpr double kReach = 3;
  const int reach = static_cast<int>(std::ceil(kReach * grid.kernel_m / grid.cell_m)) + 1;
  for (const auto& entry : people) {
    const auto& person = entry.second;
    const Vector2d at = (person.position - grid.origin_m) / grid.cell_m;
    if (at.minCoeff() < 0 || at.x() >= grid.columns || at.y() >= grid.rows) continue;
    double sum = 0;
    const auto each = [&](const auto& body) {
      for (int y = static_cast<int>(at.y()) - reach; y <= static_cast<int>(at.y()) + reach; ++y) {
        for (int x = static_cast<int>(at.x()) - reach; x <= static_cast<int>(at.x()) + reach; ++x) {
          if (x < 0 || y < 0 || x >= grid.columns || y >= grid.rows) continue;
          const double r_m = grid.cell_m * (Vector2d(x + 0.5, y + 0.5) - at).norm();
          if (r_m > kReach * grid.kernel_m) continue;
          body(static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.columns) +
                   static_cast<std::size_t>(x),
               std::exp(-r_m * r_m / (grid.kernel_m * grid.kernel_m)));
        }
      }
    };
    each([&](std::size_t /*cell*/, double weight) { sum += weight; });
    each([&](std::size_t cell, double weight) {
      const double density = weight / sum / (grid.cell_m * grid.cell_m);
      share.density[cell] += density;
      share.momentum[cell] += density * person.velocity;
    });
  }
  return share;
}

class FieldFile {
 public:
  FieldFile(std::string path, const Grid& grid, const FlowField& field, Findings& findings)
      : path_(std::move(path)), grid_(grid), field_(field), findings_(findings) {}

  void check_sums(double people) const {
    double density = 0;
    double voronoi = 0;
    bool is_finite = true;
    for (std::size_t i = 0; i < grid_.cells(); ++i) {
      density += field_.density(i);
      voronoi += field_.voronoi(i);
      is_finite = is_finite && std::isfinite(field_.density(i) + field_.voronoi(i)) &&
                  field_.velocity(i).allFinite() && field_.density(i) >= 0;
    }
    const double cell_m2 = grid_.cell_m * grid_.cell_m;
    density *= cell_m2;
    voronoi *= cell_m2;
    if (!is_finite || !(std::abs(density - people) <= 1e-3 * std::max(people, 1.0))) {
      fault(fmt::format("the densities sum to {} people, but there are {}", density, people));
    }
    // Cells of people in dense crowds are few cells of the grid large.
    if (std::abs(voronoi - people) > 2 + 0.35 * people) {
      fault(fmt::format("the Voronoi densities sum to {:.1f} people, but there are {}", voronoi,
                        people));
    }
  }

  /// The same people as in the field of the finer cells, where that has them.
  void check_level(const Grid& fine, const FlowField& of_fine, double count) const {
    const std::vector<double> people = people_of_level(fine, of_fine, grid_);
    double off = 0;
    for (std::size_t i = 0; i < people.size(); ++i) {
      off += std::abs(people[i] - field_.density(i) * grid_.cell_m * grid_.cell_m);
    }
    constexpr double kSlack = 0.03;
    if (off > kSlack * (1 + count)) {
      fault(fmt::format("{:.2f} people are in other cells than those of cell_m have them", off));
    }
  }

  /// The density is that of everybody: each person's own cell has their density and that of their
  /// neighbors, or more where a building beside takes a part of neither. Cells of a building's edge
  /// have none.
  template <typename People>
  void check_everybody(const People& people, double count) const {
    const Share share = smoothed_share(people, grid_);
    std::size_t on_grid = 0;
    for (const auto& [track, person] : people) {
      const Vector2d at = (person.position - grid_.origin_m) / grid_.cell_m;
      if (at.minCoeff() < 0 || at.x() >= grid_.columns || at.y() >= grid_.rows) continue;
      ++on_grid;
      const std::size_t cell = cell_at(static_cast<int>(at.x()), static_cast<int>(at.y()));
      constexpr double kRounding = 0.98;
      if (field_.density(cell) >= kRounding * share.density[cell] || is_at_building(at)) continue;
      return fault(
          fmt::format("{:.3f} people per m2 where track {} is by the trajectories, "
                      "expected {:.3f}",
                      field_.density(cell), track, share.density[cell]));
    }
    if (static_cast<double>(on_grid) == count) return;
    fault(fmt::format("{} people, but {} on the grid by the trajectories", count, on_grid));
  }

  template <typename People>
  void check_people(const People& people) const {
    if (people.empty()) return;
    const Share share = smoothed_share(people, grid_);
    double expected = 0;
    double missing = 0;
    double dot = 0;
    double squares = 0;
    double off = 0;
    std::size_t explained = 0;
    for (std::size_t i = 0; i < grid_.cells(); ++i) {
      if (share.density[i] <= 0) continue;
      expected += share.density[i];
      const double found = field_.density(i);
      // The share that falls on buildings is elsewhere.
      if (found > 0) missing += std::max(0.0, share.density[i] - found);
      if (found <= 0 || found > 1.05 * share.density[i] || share.density[i] < 0.02) continue;
      const Vector2d mean = share.momentum[i] / share.density[i];
      ++explained;
      dot += mean.dot(field_.velocity(i));
      squares += mean.squaredNorm();
      off += (mean - field_.velocity(i)).norm();
    }
    const double cell_m2 = grid_.cell_m * grid_.cell_m;
    double on_nothing = 0;
    for (std::size_t i = 0; i < grid_.cells(); ++i) {
      if (field_.density(i) <= 0) on_nothing += share.density[i] * cell_m2;
    }
    expected *= cell_m2;
    missing *= cell_m2;
    if (missing > 1.5 + 0.1 * expected || on_nothing > 1.5 + 0.3 * expected) {
      fault(
          fmt::format("of {:.0f} people whom cameras see, the density lacks {:.1f} where they "
                      "are, and {:.1f} are where it is 0",
                      expected, missing, on_nothing));
      return;
    }
    constexpr std::size_t kMinCount = 120;  // that of a person and more
    if (explained < kMinCount) return;
    const double mean_off = off / static_cast<double>(explained);
    const double mean_speed = std::sqrt(squares / static_cast<double>(explained));
    if (mean_off > 0.05 + 0.12 * mean_speed ||
        (mean_speed > 0.3 && std::abs(dot / squares - 1) > 0.1)) {
      fault(
          fmt::format("velocities are {:.2f} m/s off those of the people there, {:.3f} times as "
                      "large ({} cells)",
                      mean_off, dot / squares, explained));
    }
  }

 private:
  void fault(const std::string& what) const { findings_.add("fields", path_, "", what); }
  std::size_t cell_at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.columns) +
           static_cast<std::size_t>(x);
  }
  /// Whether the place's cell has nobody, as of a building, but one within half a meter has.
  bool is_at_building(const Vector2d& at) const {
    const int x = static_cast<int>(at.x());
    const int y = static_cast<int>(at.y());
    if (field_.density(cell_at(x, y)) > 0) return false;
    const int reach = std::max(1, static_cast<int>(std::ceil(0.5 / grid_.cell_m)));
    for (int v = std::max(0, y - reach); v <= std::min(grid_.rows - 1, y + reach); ++v) {
      for (int u = std::max(0, x - reach); u <= std::min(grid_.columns - 1, x + reach); ++u) {
        if (field_.density(cell_at(u, v)) > 0) return true;
      }
    }
    return false;
  }

  std::string path_;
  const Grid& grid_;
  const FlowField& field_;
  Findings& findings_;
};

struct Level {
  Grid grid;
  std::string folder;
};

/// Somebody on the ground.
struct Standing {
  Vector2d position;
  Vector2d velocity;  ///< not known from trajectories
};

/// Tracks of the people in a run's figures, in which attackers are not, as in fields; empty without
/// figures.
std::set<std::int64_t> tracks_of_figures(const formats::DatasetInfo& info, const std::string& run) {
  std::set<std::int64_t> tracks;
  const json people = formats::run_figures(info.root, run).value("by_person", json::object());
  for (const json& agent : people.value("agent", json::array())) {
    tracks.insert(formats::first_track(info, run) + agent.get<std::int64_t>());
  }
  return tracks;
}

/// Those of them who are on the ground at a frame, seen or not.
std::map<std::int64_t, Standing> people_at(const formats::RunTrajectories& recorded,
                                           std::size_t frame,
                                           const std::set<std::int64_t>& tracks) {
  std::map<std::int64_t, Standing> people;
  const std::optional<std::size_t> on_stand = world::find_stand_states(recorded.states);
  for (std::size_t person = 0; frame < recorded.times_s.size() && person < recorded.tracks.size();
       ++person) {
    const std::int64_t track = recorded.tracks[person];
    if (!recorded.present(frame, person) || !tracks.contains(track)) continue;
    if (on_stand && recorded.at(frame, person)[3] >= static_cast<float>(*on_stand)) continue;
    people[track] = {recorded.place(frame, person), Vector2d::Zero()};
  }
  return people;
}

std::vector<Level> read_levels(const json& record, const Grid& grid) {
  std::vector<Level> levels;
  for (const json& level : record.value("levels", json::array())) {
    levels.push_back({{grid.origin_m, level.at("cell_m").get<double>(), grid.kernel_m,
                       level.at("rows").get<int>(), level.at("columns").get<int>()},
                      level.at("folder").get<std::string>()});
  }
  return levels;
}

}  // namespace

void FieldsCheck::add(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                      Findings& /*findings*/) {
  if (!is_shot_at_once(image)) return;
  auto& people = runs_[image.run][image.frame];
  constexpr double kOnStandM = 0.05;  // people higher than this are not on the ground
  for (const formats::Person& person : image.people) {
    // Nor do those count who sit on props.
    if (person.position.z() > kOnStandM || person.state == "sitting") continue;
    people.insert_or_assign(person.track_id, Walker{person.position.head<2>(), person.velocity});
  }
}

void FieldsCheck::finish(const formats::DatasetInfo& info, Findings& findings) {
  for (const std::string& run : info.runs) {
    const std::string description = "fields/" + run + ".json";
    try {
      const json record = parse_own_json(read_file(info.root / description), description);
      const Grid grid{
          {record.at("origin_m").at(0).get<double>(), record.at("origin_m").at(1).get<double>()},
          record.at("cell_m").get<double>(),
          record.at("kernel_m").get<double>(),
          record.at("rows").get<int>(),
          record.at("columns").get<int>()};
      const json& people = record.at("people");
      const std::vector<Level> levels = read_levels(record, grid);
      if (!std::equal(
              levels.begin(), levels.end(), info.field_cells_m.begin(), info.field_cells_m.end(),
              [](const Level& level, double cell_m) { return level.grid.cell_m == cell_m; })) {
        findings.add("fields", description, "", "levels that are not those of the job");
      }
      if (static_cast<std::int64_t>(people.size()) != info.frames_per_camera) {
        findings.add("fields", description, "", "people of another number of frames");
      }
      std::optional<formats::RunTrajectories> everybody;
      const std::set<std::int64_t> tracks = tracks_of_figures(info, run);
      if (info.has(annotate::GroundTruth::trajectories) && !tracks.empty()) {
        everybody = formats::read_run_trajectories(info.root, run);
      }
      for (std::size_t frame = 0; frame < people.size(); ++frame) {
        const std::string path = ground_truth_file(annotate::GroundTruth::fields, run, "",
                                                   static_cast<std::int64_t>(frame));
        const FlowField field = read_field(info.root / path, grid);
        const FieldFile file(path, grid, field, findings);
        file.check_sums(people.at(frame).get<double>());
        for (const Level& level : levels) {
          const std::string place = fmt::format("fields/{}/{}/{:06}.npy", run, level.folder, frame);
          const FlowField coarse = read_field(info.root / place, level.grid);
          const FieldFile level_file(place, level.grid, coarse, findings);
          level_file.check_sums(people.at(frame).get<double>());
          level_file.check_level(grid, field, people.at(frame).get<double>());
        }
        if (everybody) {
          file.check_everybody(people_at(*everybody, frame, tracks),
                               people.at(frame).get<double>());
        }
        const auto seen = runs_.find(run);
        if (seen == runs_.end()) continue;
        const auto here = seen->second.find(static_cast<std::int64_t>(frame));
        if (here != seen->second.end()) file.check_people(here->second);
      }
    } catch (const InputError& error) {
      const Problem& problem = error.problems().front();
      findings.add("fields", fs::path(problem.source).lexically_relative(info.root).string(), "",
                   problem.found);
    } catch (const std::runtime_error& error) {
      findings.add("fields", description, "", error.what());
    }
  }
}

}  // namespace throng::checks
