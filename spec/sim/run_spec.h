// Specification of a run: crowd, drones, wind. Values only; sim/run.h simulates them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/geometry/angle.h"
#include "crowd/description/options.h"
#include "spec/camera/camera_spec.h"
#include "spec/sim/airframe.h"
#include "spec/sim/wind_spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

/// Set-point, at a time, of a drone with the policy "pilot_log".
struct PilotSample {
  double time_s = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double yaw_rad = 0;
  bool beacon = true;  ///< whether people can follow it
  /// Direction of the camera, instead of the mission's camera.pitch_deg and yaw_deg.
  std::optional<camera::GimbalAngles> gimbal = {};
};

/// The source of a policy's knowledge of people: their true positions, or estimates from a camera
/// (sim/sensors/perception.h).
enum class PerceptionKind { truth, camera };
struct PerceptionSpec {
  PerceptionKind kind = PerceptionKind::truth;
  double fov_rad = 90 * kDegree;  ///< field of view of this camera, which looks straight down
  double delay_s = 1;             ///< from the image to the estimate
  double count_noise = 0.1;       ///< share of people missed, and share of people counted twice
};

/// Parameters of policies; the table in policy_table.cpp lists those of each policy.
struct GuidanceSpec {
  std::optional<Eigen::Vector2d> center;     ///< orbit: center of the circle, m
  std::optional<double> radius_m;            ///< orbit
  std::optional<world::Rectangle> area;      ///< survey
  std::optional<double> overlap;             ///< survey: overlap of neighboring lanes, as a share
  std::optional<double> lead_speed_mps;      ///< speed of a drone that people follow
  std::optional<int> batch;                  ///< max number of people who are led at once
  std::vector<std::string> exits;            ///< ids of exits to lead to; empty: all open exits
  std::vector<PilotSample> setpoints;        ///< pilot_log: in order of time
  std::optional<PerceptionSpec> perception;  ///< default: the truth
  /// Policies that do not guide: whether people may follow the drone at all times. Default: no.
  std::optional<bool> beacon;
};

/// Conditions for a sampled start from which a drone's camera looks at one of the people
/// (sim/planning/aimed_start.h).
struct AimSpec {
  double height_m = 20;         ///< height of the drone
  double max_distance_m = 100;  ///< horizontal distance from the person
};

/// The mission of one drone.
struct DroneMission {
  std::string id;                          ///< as in the job; unique
  std::string airframe = "f450";           ///< a name in spec/sim/airframes.json
  std::optional<Airframe> own_airframe;    ///< used instead of `airframe`
  std::string policy = "hover";            ///< a name in the table of policy_table.cpp
  std::optional<Eigen::Vector3d> start;    ///< m; default: the scenario's start for this id
  std::optional<AimSpec> aim;              ///< used instead of `start`
  std::optional<double> start_yaw_rad;     ///< heading at the start; default: the scenario's, or 0
  std::vector<Eigen::Vector3d> waypoints;  ///< m, in order; the drone hovers at the last one
  double speed_mps = 3;                    ///< along the path
  std::optional<world::GoalRef> moves_goal;  ///< goal that follows this drone's (x, y)
  std::optional<double> battery_charge;      ///< share of a full battery; default: unlimited
  GuidanceSpec guidance;
  camera::CameraSpec camera;
};

/// The mission's airframe: its own, or the shipped one that it names; nothing if there is none.
std::optional<Airframe> find_airframe(const DroneMission& mission);

/// Settings of the crowd engine.
struct CrowdSpec {
  std::string model;  ///< a name in crowd::models(); empty: model_for()
  crowd::Compat compat = crowd::Compat::none;
  crowd::BodySeparation separation = crowd::BodySeparation::automatic;
  crowd::ConstantsChoice constants = crowd::ConstantsChoice::best;
  double compliance = 1;  ///< probability that a person near a guide follows it
  crowd::Physical physical;
  double leading = 0;  ///< share of people who lead something on wheels (skinning::is_leading)
};

/// Everything that determines a run, except the scenario.
struct RunSpec {
  std::uint64_t seed = 1;
  double duration_s = 120;              ///< simulated time; the run may not end earlier
  std::optional<double> images_from_s;  ///< time of the first image, if any; for warnings only
  std::optional<int> people;  ///< number of the scenario's people who take part; default: all
  CrowdSpec crowd;
  std::shared_ptr<const world::Trace> recorded;  ///< people to replay instead of the scenario's
  std::vector<DroneMission> drones;
  WindSpec wind;
  double physics_dt_s = 1.0 / 480;  ///< at most 1/240 s
};

}  // namespace throng::sim
