// The messages of a live flight for ROS, as recordings of datasets have them (docs/studio.md).
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/recording/drone_topics.h"
#include "formats/recording/message_sink.h"
#include "formats/recording/run_topics.h"
#include "live/flight/flight.h"
#include "render/people/people_on_stands.h"
#include "sim/remote/remote_pilots.h"
#include "sim/sensors/sensors.h"
#include "spec/camera/camera_spec.h"
#include "spec/job/spec.h"
#include "world/trace.h"

namespace throng::live {

namespace ros = formats::ros;

/// A topic of a flight, and how its messages are sent to those who look on.
struct FlightTopic {
  std::string name;
  ros::Kind kind = ros::Kind::clock;
  std::optional<std::size_t> camera = {};  ///< index of the drone whose images it needs
  bool is_state = false;                   ///< published when it changes: the last message holds
};

/// All topics of a flight with these drones (their names in ROS).
std::vector<FlightTopic> flight_topics(const std::vector<std::string>& drones);

/// The names of the flight's drones in ROS. Throws InputError for drones that have the same one.
std::vector<std::string> ros_names(const Flight& flight);

/// Hands the messages of each moment to a sink. All but add_image() come from one thread;
/// add_image() may come from another one, and needs a sink that may be called from both.
class FlightTopics {
 public:
  /// `statures_m`: per agent, the heights of people. Throws InputError for drones that have the
  /// same name in ROS.
  FlightTopics(const jobs::JobSpec& job, const Flight& flight, std::vector<double> statures_m,
               ros::MessageSink sink);

  /// Adds a step: the commands in force in it, one per drone (none at the start), the events of it,
  /// the drones' motion and readings since the last one, and people at its end.
  void add(const Moment& moment, const std::vector<sim::RemoteCommand>& commands,
           const std::vector<nlohmann::json>& events);

  /// Adds an image of a drone's camera (OnboardCamera), a JPEG file, at a time in the moment.
  void add_image(const Moment& moment, std::size_t drone, double time_s, const std::string& jpeg);

 private:
  struct Drone {
    ros::DroneTopics topics;
    camera::CameraSpec camera;  ///< as images show it
    sim::DroneSensors sensors;
    double last_s = -1;           ///< time of the last sample
    std::string pilot_mode = {};  ///< the last message
    double last_image_s = -1;     ///< time of the last image; of the thread that adds images
  };

  void add_mode(Drone& drone, const sim::RemoteCommand& command, double time_s);
  void add_command(Drone& drone, const sim::RemoteCommand& command, double time_s);
  void add_sample(const Moment& moment, std::size_t drone, const world::DroneSample& sample);
  void add_people(const world::CrowdStep& people);

  ros::MessageSink sink_;
  ros::ClockTopic clock_;
  std::vector<Drone> drones_;
  double latitude_deg_;
  std::vector<world::AgentRole> roles_;
  std::vector<float> radii_m_;
  std::vector<double> statures_m_;
  render::StandFloors floors_;
  double people_after_s_ = -1;  ///< people are published after this time
};

}  // namespace throng::live
