#include "spec/job/camera_fields.h"
#include "spec/job/guidance_spec.h"
#include "spec/job/job_fields.h"

namespace throng::jobs {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

json airframe_json(const DroneSpec& drone) {
  const sim::DroneMission& mission = drone.mission;
  return mission.own_airframe ? sim::to_json(*mission.own_airframe) : json(mission.airframe);
}

void set_airframe(DroneSpec& drone, const json& value, const FieldLocation& place) {
  sim::DroneMission& mission = drone.mission;
  if (value.is_string()) {
    value.get_to(mission.airframe);
    return;
  }
  mission.airframe = mission.id;
  mission.own_airframe = sim::read_airframe(mission.id, value, place.pointer, place.problems);
}

json goal_json(const DroneSpec& drone) {
  const auto& goal = drone.mission.moves_goal;
  return goal ? json{goal->set, goal->goal} : json();
}

void set_goal(DroneSpec& drone, const json& value, const FieldLocation& /*place*/) {
  drone.mission.moves_goal = world::GoalRef{value.at(0).get<int>(), value.at(1).get<int>()};
}

const FieldTable<sim::AimSpec>& aim_fields() {
  static const FieldTable<sim::AimSpec> fields = [] {
    FieldTable<sim::AimSpec> table;
    table
        .add("height_m", "Height", "m", numbers(2, 500), at(&sim::AimSpec::height_m),
             "Height of the drone above the ground.")
        .randomized();
    table
        .add("max_distance_m", "Max distance", "m", numbers(0, 1000),
             at(&sim::AimSpec::max_distance_m),
             "Maximum distance on the ground between drone and person; a camera that looks less "
             "steeply has the person below its axis.")
        .randomized();
    return table;
  }();
  return fields;
}

json aim_json(const DroneSpec& drone) {
  const auto& aim = drone.mission.aim;
  return aim ? aim_fields().print(*aim) : json();
}

void set_aim(DroneSpec& drone, const json& value, const FieldLocation& place) {
  aim_fields().read(value, drone.mission.aim.emplace(), place);
}

FieldTable<DroneSpec> make_drone_fields() {
  FieldTable<DroneSpec> table;
  table
      .add(
          "id", "Id", "", identifiers(), at(&DroneSpec::mission, &sim::DroneMission::id),
          "Unique name: letters, digits, '_' and '-'; also the name of folders, so that ids differ "
          "in more than their case, and none is a device of Windows (con, nul, com1). The "
          "scenario's drone of this id gives the defaults of start and moves_goal.")
      .required();
  table.add("airframe", "Airframe", "",
            raw({{"type", {"string", "object"}}, {"pattern", identifiers().rules["pattern"]}},
                "the name of an airframe, or an object that describes one"),
            airframe_json, set_airframe,
            "The quadcopter: a name that throng airframes lists, or an object with the fields "
            "that it prints for one.");
  table.group("battery", "Battery", "Limited flight time.");
  table.add("battery/charge", "Charge", "", numbers(0.01, 1),
            at(&DroneSpec::mission, &sim::DroneMission::battery_charge),
            "Share of a full battery at the run's start; the drone lands where it is when 15 % are "
            "left. Without it, the battery is not limited.");
  table.add("start", "Start", "m", coordinates(3, true),
            at(&DroneSpec::mission, &sim::DroneMission::start),
            "Position where the drone hovers when the run begins; default: the scenario's start "
            "for this id.");
  table.add("aim", "Aim", "", object_with(aim_fields().schema()), aim_json, set_aim,
            "Instead of a start: in every run the drone begins where its camera's optical axis "
            "meets one of the people, from a direction with free sight, both sampled by the seed. "
            "For jobs of several scenarios, and for any scenario of which nobody knows the "
            "coordinates.");
  table.add("moves_goal", "Moved goal", "", lists(2, 2, integers(0, 1'000'000'000).rules),
            goal_json, set_goal,
            "The goal of the behavior file, [goal set, goal], that follows the drone over the "
            "ground; default: the scenario's for this id.");
  table.group("guidance", "Guidance", "The policy that flies the drone.");
  table.add_all(
      "guidance", guidance_fields(), [](auto& drone) -> auto& { return drone; });
  table
      .add(
          "camera", "Camera", "", object_with(camera_fields().schema()),
          [](const DroneSpec& drone) { return to_json(drone.camera); },
          [](DroneSpec& drone, const json& value, const FieldLocation& place) {
            drone.camera = read_camera(value, place.pointer, place.problems);
          },
          "A camera on a gimbal that cancels the drone's roll and pitch, or fixed to it. Every "
          "number except the "
          "image's size may be a distribution, sampled again for every run.")
      .with_default(ordered_json::object());
  return table;
}

}  // namespace

const FieldTable<DroneSpec>& drone_fields() {
  static const FieldTable<DroneSpec> table = make_drone_fields();
  return table;
}

}  // namespace throng::jobs
