// A scenario: ground, buildings, exits, crowd and the drones' starts. The JSON file beside the
// Menge scene and behavior files that it names.
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
#include "world/alarm.h"
#include "world/disasters.h"
#include "world/ground.h"
#include "world/props.h"
#include "world/semantic_class.h"

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

/// A door: a segment on the ground that people cross to get out.
struct Exit {
  std::string id;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
  Eigen::Vector2d outward =
      Eigen::Vector2d::UnitX();  ///< unit normal, pointing out of the scenario
  bool open = true;              ///< otherwise nobody can ever get out here
  std::vector<GoalRef> goals;    ///< an agent heading for one of these intends this exit
  /// From when on nobody can: a disaster has reached it (s).
  double closes_at_s = std::numeric_limits<double>::infinity();

  /// Whether people can get out here at a time of the run (s), which is that of a step.
  bool is_open(double time_s) const {
    constexpr double kRoundingS = 1e-6;
    return open && time_s < closes_at_s - kRoundingS;
  }
  double width_m() const { return (to - from).norm(); }
  Eigen::Vector2d middle() const { return 0.5 * (from + to); }
};

/// Appearance of a building's walls. by_id: plaster or brick, by the building's number. The numbers
/// are those of shaders/wall.frag.glsl, which has others for what render/ adds (render::WallLook).
enum class Facade : std::uint8_t { by_id = 0, plaster = 1, brick = 2, glass = 3, hedge = 8 };

/// An extruded polygon. Corners counter-clockwise seen from above, not repeated at the end.
struct Building {
  std::string id;
  std::vector<Eigen::Vector2d> footprint;  ///< m
  double height_m = 10;
  Facade facade = Facade::by_id;
};

/// A user's mesh file, y up, placed in the world: its origin at `position`.
struct PlacedMesh {
  std::filesystem::path file;                          ///< absolute
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double yaw_rad = 0;
  double scale = 1;  ///< meters per unit of the file
  SemanticClass semantic_class = SemanticClass::object;
};

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
  std::filesystem::path scene_file;  ///< Menge scene XML, absolute; empty: none, or `built_crowd`
  std::filesystem::path behavior_file;  ///< Menge behavior XML, absolute
  /// A crowd that is in no files; null: that of the two files (world/scenario_crowd.h).
  std::shared_ptr<const crowd::CrowdDescription> built_crowd;
  std::string crowd_model;      ///< pedestrian model that it was made for; empty: any
  Rectangle ground;             ///< what is rendered as ground
  std::string ground_material;  ///< "pavers", "asphalt", "grass", "concrete"
  Rectangle inside;             ///< who leaves this rectangle has escaped
  std::vector<Exit> exits;
  std::vector<Building> buildings;
  std::vector<DroneStart> drones;
  /// Agents that are not people (the paper's disaster is an agent); neither rendered nor counted.
  /// Those of `disasters` are among them.
  std::vector<int> disaster_agents;
  std::vector<Disaster> disasters;
  /// Whether the behavior file lets people who have noticed nothing follow a drone.
  bool guides_alert = false;
  std::vector<Prop> props;       ///< placed ones in the file's order, then scattered ones
  std::size_t placed_props = 0;  ///< how many of them are placed
  std::vector<PlacedMesh> meshes;
  std::vector<GroundArea> areas;  ///< later ones lie on top of earlier ones
  std::vector<Marking> markings;
  /// The file's JSON without its crowd, for those who have the run's trace but not the file.
  std::string document;
  /// The alarm of a scenario whose crowd is not at hand, as in a trace; otherwise find_alarm()
  /// finds it.
  std::optional<Alarm> alarm;

  /// Whether it has a crowd to simulate; otherwise only recorded people can be in it.
  bool has_crowd() const { return built_crowd || (!scene_file.empty() && !behavior_file.empty()); }
};

/// Reads and checks a scenario file. `id` becomes Scenario::id. One that `extends` another file of
/// its folder contains only the differences: fields of objects replace those of the same name,
/// anything else replaces the whole (RFC 7396). Throws InputError (file, JSON pointer, found,
/// expected) for bad content and EnvironmentError when the file cannot be read.
Scenario load_scenario(const std::filesystem::path& file, std::string id);

/// The same for a document in memory that extends nothing. `file` is where it would be: for
/// messages, and for the names of files in it.
Scenario parse_scenario(const nlohmann::json& document, const std::filesystem::path& file,
                        std::string id);

/// Leaves this share (0 to 1) of the scattered props where they are, chosen by the seed, and takes
/// the others away. A smaller share leaves some of those that a larger one leaves.
void thin_out(Scenario& scenario, double share, std::uint64_t seed);

/// The folder of shipped scenarios: $THRONG_SCENARIOS if set, else the installed one, else the
/// source tree's.
std::filesystem::path scenarios_folder();

/// Ending of the files of blueprints (world/scenarios/blueprint/blueprint.h).
inline constexpr std::string_view kBlueprintEnding = ".blueprint.json";

/// Ending of blueprints in files of version 0.1; they are still read.
inline constexpr std::string_view kFormerBlueprintEnding = ".place.json";

/// Whether a file's name ends as blueprints' do, now or formerly.
bool is_blueprint_name(std::string_view file);

/// `<folder>/<id>.json`, else the blueprint `<folder>/<id>.blueprint.json`. Ids are words of
/// [a-z0-9_] joined by '/': nothing outside the folder can be named. Throws InputError when the id
/// is malformed or unknown (listing what there is).
std::filesystem::path scenario_file(const std::filesystem::path& folder, const std::string& id);

/// Whether there is a file for the id, without reading it.
bool has_scenario(const std::filesystem::path& folder, const std::string& id);

/// The name of a scenario file without its ending, which is ".json" or ".blueprint.json".
std::string id_from_file(const std::filesystem::path& file);

/// Every scenario id in the folder, sorted, whether its file is a scenario or a blueprint. Sound
/// JSON files without any part of a scenario (jobs, studies) are none.
std::vector<std::string> list_scenarios(const std::filesystem::path& folder);

}  // namespace throng::world
