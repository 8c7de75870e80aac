// A flight for clients of Foxglove's WebSocket protocol: its topics, parameters and services, and
// their commands (docs/robotics.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "formats/recording/message_sink.h"
#include "live/flight/flight_topics.h"
#include "live/flight/outside/command_topics.h"
#include "live/foxglove/server.h"
#include "live/loop/control.h"

namespace throng::live {

/// Safe to use from many threads.
class FoxgloveBridge {
 public:
  /// Ids of the drones and their names in ROS. `control` must outlive this object. Throws as
  /// foxglove::Server.
  FoxgloveBridge(const foxglove::ServerOptions& options, const std::vector<FlownDrone>& drones,
                 const std::vector<std::string>& names, bool has_camera, Control& control);

  std::uint16_t port() const { return server_->port(); }
  /// Whether somebody wants images of the drone's camera.
  bool wants_images(std::size_t drone) const;

  void publish(const ros::TopicMessage& message);
  /// Replaces the parameters that nobody can set.
  void set_facts(std::vector<foxglove::Parameter> facts);
  /// Tells all clients, and those who watch parameters their values.
  void tell(foxglove::Level level, const std::string& text);

 private:
  std::vector<foxglove::Parameter> parameters() const;
  void set_parameters(const std::vector<foxglove::Parameter>& given);
  void call(std::size_t service, const nlohmann::json& request,
            const foxglove::ServiceAnswer& answer);

  std::vector<std::string> ids_;
  CommandTopics commands_;
  Control& control_;
  std::map<std::string, std::size_t> channels_;             ///< indices by topic
  std::map<std::size_t, std::vector<std::size_t>> images_;  ///< per drone: channels of its camera
  mutable std::mutex mutex_;
  std::vector<foxglove::Parameter> facts_;  ///< guarded by mutex_
  std::unique_ptr<foxglove::Server> server_;
};

}  // namespace throng::live
