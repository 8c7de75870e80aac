#include "live/flight/outside/foxglove_bridge.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/text/suggest.h"
#include "live/flight/outside/services.h"

namespace throng::live {

using foxglove::Parameter;
using nlohmann::json;

namespace {

constexpr double kMinOutsideFactor = 0.01;
constexpr double kMaxOutsideFactor = 1000;
constexpr const char* kClock = "/clock";

[[noreturn]] void refuse(const Parameter& parameter, const std::string& expected) {
  constexpr std::size_t kShown = 60;
  throw InputError(
      {"parameter " + parameter.name, "", parameter.value.dump().substr(0, kShown), expected});
}

double read_factor(const Parameter& parameter) {
  if (parameter.value.is_number()) {
    const auto factor = parameter.value.get<double>();
    if (factor == 0 || (factor >= kMinOutsideFactor && factor <= kMaxOutsideFactor)) return factor;
  }
  refuse(parameter, "a number from 0.01 to 1000, or 0: as fast as it can");
}

std::string read_view(const Parameter& parameter, const std::vector<std::string>& drones) {
  if (!parameter.value.is_string()) refuse(parameter, "a drone's id");
  const auto id = parameter.value.get<std::string>();
  if (std::find(drones.begin(), drones.end(), id) != drones.end()) return id;
  const std::vector<std::string_view> known(drones.begin(), drones.end());
  throw InputError(unknown_name("parameter " + parameter.name, "", "drone", id, known));
}

PublishedCommand published(const foxglove::ClientChannel& channel, std::string_view bytes) {
  return {channel.topic, channel.encoding, channel.schema_name, bytes};
}

}  // namespace

FoxgloveBridge::FoxgloveBridge(const foxglove::ServerOptions& options,
                               const std::vector<FlownDrone>& drones,
                               const std::vector<std::string>& names, bool has_camera,
                               Control& control)
    : commands_(drones, names), control_(control) {
  for (const FlownDrone& drone : drones) ids_.push_back(drone.id);
  std::vector<foxglove::Channel> channels;
  for (const FlightTopic& topic : flight_topics(names)) {
    if (topic.camera && !has_camera) continue;
    if (topic.camera) images_[*topic.camera].push_back(channels.size());
    channels_[topic.name] = channels.size();
    const auto schema = ros::make_schema(topic.kind);
    channels.push_back({topic.name, schema.name, schema.text,
                        topic.kind == ros::Kind::compressed_image, topic.is_state});
  }
  foxglove::Hooks hooks;
  hooks.check_channel = [this](const foxglove::ClientChannel& channel) {
    commands_.check(published(channel, {}));
  };
  hooks.take_message = [this](const foxglove::ClientChannel& channel, std::string_view bytes) {
    control_.command(commands_.read(published(channel, bytes)));
  };
  hooks.parameters = [this] { return parameters(); };
  hooks.set_parameters = [this](const std::vector<Parameter>& given) { set_parameters(given); };
  hooks.call = [this](std::size_t service, const json& request,
                      const foxglove::ServiceAnswer& answer) { call(service, request, answer); };
  server_ = std::make_unique<foxglove::Server>(options, std::move(channels), flight_services(),
                                               std::move(hooks));
  server_->start();
}

bool FoxgloveBridge::wants_images(std::size_t drone) const {
  const auto channels = images_.find(drone);
  return channels != images_.end() &&
         std::any_of(channels->second.begin(), channels->second.end(),
                     [this](std::size_t channel) { return server_->is_subscribed(channel); });
}

void FoxgloveBridge::publish(const ros::TopicMessage& message) {
  const std::uint64_t time_ns = ros::time_ns(message.time_s);
  if (message.topic == kClock) server_->tell_time(time_ns);
  server_->publish(channels_.at(message.topic), time_ns, message.bytes);
}

void FoxgloveBridge::set_facts(std::vector<Parameter> facts) {
  {
    const std::lock_guard lock(mutex_);
    facts_ = std::move(facts);
  }
  server_->refresh_parameters();
}

void FoxgloveBridge::tell(foxglove::Level level, const std::string& text) {
  server_->tell(level, text);
}

std::vector<Parameter> FoxgloveBridge::parameters() const {
  const PilotInput input = control_.input();
  std::vector<Parameter> all = {
      {"factor", input.factor}, {"paused", input.paused}, {"view", ids_.at(input.view)}};
  const std::lock_guard lock(mutex_);
  all.insert(all.end(), facts_.begin(), facts_.end());
  return all;
}

// All of them or none.
void FoxgloveBridge::set_parameters(const std::vector<Parameter>& given) {
  Commands commands;
  for (const Parameter& parameter : given) {
    if (parameter.name == "factor") {
      commands.factor = read_factor(parameter);
    } else if (parameter.name == "paused") {
      if (!parameter.value.is_boolean()) refuse(parameter, "true or false");
      commands.paused = parameter.value.get<bool>();
    } else if (parameter.name == "view") {
      commands.view = read_view(parameter, ids_);
    } else {
      throw InputError({"parameter " + parameter.name, "", "a value for it",
                        "one for factor, paused or view: others cannot be set"});
    }
  }
  control_.command(commands);
  server_->refresh_parameters();
}

void FoxgloveBridge::call(std::size_t service, const json& request,
                          const foxglove::ServiceAnswer& answer) {
  call_service(service, request, control_, answer);
  server_->refresh_parameters();
}

}  // namespace throng::live
