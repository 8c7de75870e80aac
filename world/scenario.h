// A scenario: ground, buildings, exits, crowd and start positions of drones. A JSON file names the
// Menge scene and behavior files beside it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/geometry/rectangle.h"
#include "base/geometry/region.h"
#include "world/alarm.h"
#include "world/building.h"
#include "world/disasters.h"
#include "world/ground.h"
#include "world/imposed_capacity.h"
#include "world/props.h"
#include "world/semantic_class.h"
#include "world/stand.h"

namespace throng::crowd {
struct CrowdDescription;
}  // namespace throng::crowd

namespace throng::world {

/// A goal of the behavior file: `<GoalSet id=set><Goal id=goal>`.
struct GoalRef {
  int set = 0;
  int goal = 0;
  bool operator==(const GoalRef&) const = default;
};

/// A door: a segment on the ground that people cross to get out, without its ends that lie in
/// buildings (world/exits/exit_opening.h).
struct Exit {
  std::string id;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
  Eigen::Vector2d outward =
      Eigen::Vector2d::UnitX();  ///< unit normal that points out of the scenario
  bool open = true;              ///< false: the exit stays closed for the whole run
  std::vector<GoalRef> goals;    ///< an agent that heads for one of these goals intends this exit
  /// Time at which a disaster reaches and closes the exit (s).
  double closes_at_s = std::numeric_limits<double>::infinity();
  /// The width that buildings leave free, if it is less than the length.
  std::optional<double> free_m = std::nullopt;
  /// The length of the segment in the file, if it is more.
  std::optional<double> drawn_m = std::nullopt;
  /// A capacity that people who go out are held to.
  std::optional<ImposedCapacity> capacity = std::nullopt;

  /// Whether people can leave here at the time of a step (s).
  bool is_open(double time_s) const {
    constexpr double kRoundingS = 1e-6;
    return open && time_s < closes_at_s - kRoundingS;
  }
  double length_m() const { return (to - from).norm(); }
  /// The width that people can pass, on which all figures are based.
  double width_m() const { return free_m.value_or(length_m()); }
  Eigen::Vector2d middle() const { return 0.5 * (from + to); }
};

/// A door inside, which people pass in both directions: a segment on the ground.
struct InnerDoor {
  std::string id;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
  ImposedCapacity capacity;                        ///< of both directions together
};

/// A mesh file of the user (y up), placed in the world with its origin at `position`.
struct PlacedMesh {
  std::filesystem::path file;                          ///< absolute
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double yaw_rad = 0;
  double scale = 1;  ///< meters per unit of the file
  SemanticClass semantic_class = SemanticClass::object;
};

/// Start pose of a drone.
struct DroneStart {
  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double yaw_rad = 0;
  std::optional<GoalRef> moves_goal;  ///< the goal that this drone's (x, y) moves, if any
};

using Rectangle = geometry::Rectangle;

struct Scenario {
  std::string id;  ///< "city_square/nearest_exit": path below the scenarios folder, no suffix
  std::string name;
  std::string description;
  std::filesystem::path scene_file;  ///< Menge scene XML, absolute; may be empty: see has_crowd()
  std::filesystem::path behavior_file;  ///< Menge behavior XML, absolute
  /// A crowd built in code; null: the crowd of the two files (see world/scenario_crowd.h).
  std::shared_ptr<const crowd::CrowdDescription> built_crowd;
  std::string crowd_model;      ///< pedestrian model for which the crowd was tuned; empty: any
  Rectangle ground;             ///< what is rendered as ground
  std::string ground_material;  ///< "pavers", "asphalt", "grass", "concrete" or "dirt"
  geometry::Region inside;      ///< people who leave it have escaped
  std::vector<Exit> exits;
  std::vector<InnerDoor> doors;
  std::vector<Building> buildings;
  std::vector<DroneStart> drones;
  /// Indices of agents that are not people, including those of `disasters`; neither rendered nor
  /// counted.
  std::vector<int> disaster_agents;
  std::vector<Disaster> disasters;
  /// Whether the behavior file lets people who have not noticed a disaster follow a drone.
  bool guides_alert = false;
  std::vector<Prop> props;  ///< placed in the order of the file, then scattered, then of clutter
  std::size_t placed_props = 0;  ///< number of placed props
  std::size_t strewn_props = 0;  ///< number of clutter's, which no crowd walks around
  std::vector<Sitter> sitters;   ///< on seats of props, by prop (world/clutter/sitters.h)
  std::vector<Stand> stands;
  std::vector<PlacedMesh> meshes;
  std::vector<GroundArea> areas;  ///< later areas cover earlier ones
  std::vector<Marking> markings;
  /// The JSON of the file without its crowd; a trace stores it, so that it can be read without the
  /// file.
  std::string document;
  /// The alarm of a scenario whose crowd is not available, as in a trace; otherwise find_alarm()
  /// computes it.
  std::optional<Alarm> alarm;

  /// Whether the scenario has a crowd to simulate; without one it can only show recorded people.
  bool has_crowd() const { return built_crowd || (!scene_file.empty() && !behavior_file.empty()); }
};

/// Removes scattered props and clutter: each stays with probability `share` (0 to 1), determined by
/// the seed, and if somebody sits on it. The props that stay at a smaller share are a subset of
/// those that stay at a larger one.
void thin_out(Scenario& scenario, double share, std::uint64_t seed);

/// Returns the folder of shipped scenarios: $THRONG_SCENARIOS if set, else the installed folder,
/// else that of the source tree.
std::filesystem::path scenarios_folder();

/// File name suffix of blueprints (places/scenarios/blueprint/blueprint.h).
inline constexpr std::string_view kBlueprintEnding = ".blueprint.json";

/// File name suffix of blueprints of version 0.1, which are still read.
inline constexpr std::string_view kFormerBlueprintEnding = ".place.json";

/// Whether a file name has one of the suffixes of blueprints.
bool is_blueprint_name(std::string_view file);

/// Returns `<folder>/<id>.json` if it exists, else `<folder>/<id>.blueprint.json`. Ids consist of
/// words of [a-z0-9_] joined by '/', so an id cannot name a file outside the folder. Throws
/// InputError, with a list of ids, if the id is malformed or unknown.
std::filesystem::path scenario_file(const std::filesystem::path& folder, const std::string& id);

/// Whether a scenario or blueprint file exists for the id. Does not read the file.
bool has_scenario(const std::filesystem::path& folder, const std::string& id);

/// Returns the name of a scenario file without its suffix ".json" or ".blueprint.json".
std::string id_from_file(const std::filesystem::path& file);

/// Returns the sorted ids of all scenarios and blueprints in the folder and its subfolders. Valid
/// JSON files without any part of a scenario (jobs, studies) are left out. Throws InputError if
/// there is no such folder and EnvironmentError if it cannot be read.
std::vector<std::string> list_scenarios(const std::filesystem::path& folder);

}  // namespace throng::world
