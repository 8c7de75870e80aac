#include "live/flight/flight_topics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "annotate/people/coco.h"
#include "base/geometry/angle.h"
#include "formats/recording/ros_names.h"
#include "jobs/pipeline/frames/flight_record.h"
#include "live/flight/onboard_camera.h"
#include "live/flight/people_in_motion.h"
#include "spec/job/environment.h"
#include "spec/job/plan.h"
#include "world/fields/trace_scenario.h"

namespace throng::live {

using nlohmann::json;

namespace {

/// Boxes of larger crowds would be most of a recording.
constexpr std::size_t kManyAgents = 1000;
constexpr double kManyPeopleEveryS = 1;

ros::Pose body_pose(const world::DroneSample& sample) {
  return {sample.position, sample.orientation};
}

ros::Motion body_motion(const world::DroneSample& sample) {
  return {body_pose(sample), sample.orientation.conjugate() * sample.velocity, sample.body_rates};
}

formats::SensorRow sensor_row(const sim::SensorReading& reading) {
  return {reading.time_s,      reading.gyro,       reading.accelerometer, reading.magnetometer,
          reading.pressure_pa, reading.gps.time_s, reading.gps.position,  reading.gps.velocity};
}

Eigen::Vector3d position_sd_m(const sim::SensorNoise& noise) {
  return {noise.gps_wander_m.x(), noise.gps_wander_m.x(), noise.gps_wander_m.y()};
}

/// As wide as the circle that the simulation has for a person; ahead of the feet of those who have
/// fallen.
ros::Box3 person_box(const Eigen::Vector3f& position, float yaw_rad, double radius_m,
                     double stature_m, bool has_fallen) {
  ros::Box3 box;
  box.label = "person";
  box.pose.rotation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
  box.pose.position = position.cast<double>();
  const double width_m = 2 * radius_m;
  if (has_fallen) {
    box.size_m = {stature_m, width_m, width_m};
    box.pose.position += box.pose.rotation * Eigen::Vector3d(0.5 * stature_m, 0, radius_m);
  } else {
    box.size_m = {width_m, width_m, stature_m};
    box.pose.position.z() += 0.5 * stature_m;
  }
  return box;
}

render::StandFloors known_floors(const world::TraceHeader& header) {
  const auto scenario = world::scenario_in_trace(header, "", world::TraceMeshes::left_out);
  return scenario ? render::StandFloors(scenario->stands, scenario->sitters)
                  : render::StandFloors({});
}

}  // namespace

std::vector<std::string> ros_names(const Flight& flight) {
  ros::RosNames names("the job");
  std::vector<std::string> list;
  for (const sim::PlannedDrone& drone : flight.drones()) {
    list.push_back(names.name_of(drone.mission.id));
  }
  return list;
}

std::vector<FlightTopic> flight_topics(const std::vector<std::string>& drones) {
  using ros::Kind;
  std::vector<FlightTopic> topics = {{"/clock", Kind::clock},
                                     {"/tf", Kind::transforms},
                                     {"/ground_truth/boxes", Kind::markers},
                                     {"/ground_truth/detections_3d", Kind::detections_3d},
                                     {"/events", Kind::text}};
  for (std::size_t i = 0; i < drones.size(); ++i) {
    const std::string root = "/" + drones[i];
    topics.push_back({root + "/odometry", Kind::odometry});
    topics.push_back({root + "/imu", Kind::imu});
    topics.push_back({root + "/magnetic_field", Kind::magnetic_field});
    topics.push_back({root + "/pressure", Kind::pressure});
    topics.push_back({root + "/fix", Kind::fix});
    topics.push_back({root + "/fix_velocity", Kind::velocity});
    topics.push_back({root + "/command", Kind::velocity});
    topics.push_back({.name = root + "/mode", .kind = Kind::text, .is_state = true});
    topics.push_back({root + "/camera/camera_info", Kind::camera_info, i});
    topics.push_back({root + "/camera/image_color/compressed", Kind::compressed_image, i});
  }
  return topics;
}

FlightTopics::FlightTopics(const jobs::JobSpec& job, const Flight& flight,
                           std::vector<double> statures_m, ros::MessageSink sink)
    : sink_(std::move(sink)),
      clock_(sink_),
      roles_(flight.header().role),
      radii_m_(flight.header().radius_m),
      statures_m_(std::move(statures_m)),
      floors_(known_floors(flight.header())) {
  const jobs::JobSpec run_job = jobs::job_of_run(job, 0);
  const std::uint64_t seed = jobs::run_seed(job, 0);
  latitude_deg_ = jobs::environment_of_run(run_job.environment, seed).latitude_deg;
  const std::vector<std::string> names = ros_names(flight);
  for (std::size_t i = 0; i < names.size(); ++i) {
    drones_.push_back({ros::DroneTopics(names[i], sink_),
                       shown_camera(flight.drones()[i].mission.camera),
                       jobs::make_sensors(run_job, seed, i)});
  }
}

void FlightTopics::add(const Moment& moment, const std::vector<sim::RemoteCommand>& commands,
                       const std::vector<json>& events) {
  for (std::size_t i = 0; i < commands.size(); ++i) {
    add_command(drones_.at(i), commands[i], moment.time_s - moment.dt_s);
  }
  if (commands.empty()) {
    for (Drone& drone : drones_) add_mode(drone, {}, moment.time_s);
  }
  struct New {
    const world::DroneSample* sample;
    std::size_t drone;
  };
  std::vector<New> samples;
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    for (const world::DroneSample& sample : moment.flown.drones.at(i)) {
      if (sample.time_s > drones_[i].last_s) samples.push_back({&sample, i});
    }
  }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const New& a, const New& b) { return a.sample->time_s < b.sample->time_s; });
  for (const New& each : samples) add_sample(moment, each.drone, *each.sample);
  for (const json& event : events) {
    const double time_s = event.at("time_s");
    sink_({"/events", ros::Kind::text, time_s, ros::text(event.dump())});
  }
  clock_.advance(moment.time_s);
  add_people(*moment.now);
}

void FlightTopics::add_command(Drone& drone, const sim::RemoteCommand& command, double time_s) {
  const std::string& root = drone.topics.root();
  sink_({root + "/command", ros::Kind::velocity, time_s,
         ros::velocity({drone.topics.body_frame(), time_s}, command.velocity_mps,
                       {0, 0, command.yaw_rate_deg_s * kDegree})});
  add_mode(drone, command, time_s);
}

void FlightTopics::add_mode(Drone& drone, const sim::RemoteCommand& command, double time_s) {
  const json mode = {{"beacon", command.beacon},
                     {"return_home", command.goes_home},
                     {"route", command.route != nullptr}};
  if (std::string text = mode.dump(); text != drone.pilot_mode) {
    drone.pilot_mode = std::move(text);
    sink_({drone.topics.root() + "/mode", ros::Kind::text, time_s, ros::text(drone.pilot_mode)});
  }
}

void FlightTopics::add_sample(const Moment& moment, std::size_t index,
                              const world::DroneSample& given) {
  Drone& drone = drones_[index];
  // The flight's trace and its readings have the same numbers.
  const world::DroneSample sample = world::as_recorded(given);
  drone.last_s = sample.time_s;
  clock_.advance(sample.time_s);
  const camera::Camera camera = flown_camera(moment, index, drone.camera, sample);
  drone.topics.publish_transforms(sample.time_s, body_pose(sample), ros::camera_pose(camera.pose));
  drone.topics.publish_odometry(sample.time_s, body_motion(sample));
  drone.topics.publish_readings(sensor_row(drone.sensors.read(sample)),
                                {latitude_deg_, position_sd_m(drone.sensors.noise())});
}

void FlightTopics::add_people(const world::CrowdStep& people) {
  if (people.time_s <= people_after_s_) return;
  people_after_s_ = roles_.size() > kManyAgents
                        ? people.time_s + kManyPeopleEveryS - world::kTimeSlackS
                        : people.time_s;
  std::vector<ros::Box3> boxes;
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    const std::uint8_t flags = people.flags[i];
    if ((flags & world::kPresent) == 0 || !world::is_visible_person(roles_[i])) continue;
    const Eigen::Vector2f& at = people.position[i];
    boxes.push_back(person_box({at.x(), at.y(), floors_.height_m(at)}, people.yaw_rad[i],
                               radii_m_[i], statures_m_[i], (flags & world::kFallen) != 0));
    boxes.back().id = annotate::track_id(0, static_cast<std::uint32_t>(i));
  }
  ros::publish_boxes(sink_, "", people.time_s, boxes);
}

void FlightTopics::add_image(const Moment& moment, std::size_t drone, double time_s,
                             const std::string& jpeg) {
  Drone& from = drones_.at(drone);
  const world::DroneSample sample = moment.flown.drone_at(drone, time_s);
  const camera::Camera camera = flown_camera(moment, drone, from.camera, sample);
  // Transforms with the stamp of others are errors to those who listen to /tf.
  const std::vector<world::DroneSample>& known = moment.flown.drones.at(drone);
  const bool is_known = time_s == std::exchange(from.last_image_s, time_s) ||
                        std::any_of(known.begin(), known.end(), [&](const auto& other) {
                          return ros::time_ns(other.time_s) == ros::time_ns(time_s);
                        });
  if (!is_known) {
    from.topics.publish_transforms(time_s, body_pose(sample), ros::camera_pose(camera.pose));
  }
  from.topics.publish_image(time_s, camera.intrinsics, "jpeg", jpeg);
}

}  // namespace throng::live
