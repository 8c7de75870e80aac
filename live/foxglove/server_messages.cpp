#include "live/foxglove/server_messages.h"

#include <nlohmann/json.hpp>

namespace throng::foxglove {

using nlohmann::json;

namespace {

constexpr char kDataCode = 1;
constexpr char kTimeCode = 2;
constexpr char kResponseCode = 3;

template <typename Number>
void append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));  // NOLINT: little-endian
}

/// Text from outside need not be UTF-8.
std::string print(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

json schema_part(const Service& service, const char* part, const std::string& schema) {
  return {{"encoding", "json"},
          {"schemaName", service.type + "_" + part},
          {"schemaEncoding", "jsonschema"},
          {"schema", schema}};
}

}  // namespace

std::string server_info(const std::string& name, const std::string& session) {
  return print(
      {{"op", "serverInfo"},
       {"name", name},
       {"capabilities", {"clientPublish", "parameters", "parametersSubscribe", "services", "time"}},
       {"supportedEncodings", {"json", "cdr"}},
       {"metadata", json::object()},
       {"sessionId", session}});
}

std::string advertise_channels(const std::vector<Channel>& channels) {
  json list = json::array();
  for (const Channel& channel : channels) {
    list.push_back({{"id", list.size()},
                    {"topic", channel.topic},
                    {"encoding", "cdr"},
                    {"schemaName", channel.schema_name},
                    {"schema", channel.schema},
                    {"schemaEncoding", "ros2msg"}});
  }
  return print({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string advertise_services(const std::vector<Service>& services) {
  json list = json::array();
  for (const Service& service : services) {
    list.push_back({{"id", list.size()},
                    {"name", service.name},
                    {"type", service.type},
                    {"request", schema_part(service, "Request", service.request_schema)},
                    {"response", schema_part(service, "Response", service.response_schema)}});
  }
  return print({{"op", "advertiseServices"}, {"services", std::move(list)}});
}

std::string status(Level level, std::string_view text) {
  return print({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", text}});
}

std::string parameter_values(const std::vector<Parameter>& parameters,
                             const std::optional<std::string>& id) {
  json list = json::array();
  for (const Parameter& parameter : parameters) {
    list.push_back({{"name", parameter.name}, {"value", parameter.value}});
    if (parameter.value.is_number_float()) list.back()["type"] = "float64";
  }
  json message = {{"op", "parameterValues"}, {"parameters", std::move(list)}};
  if (id) message["id"] = *id;
  return print(message);
}

std::string service_failure(std::uint32_t service, std::uint32_t call, std::string_view text) {
  return print(
      {{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", text}});
}

std::string data_head(std::uint32_t subscription, std::uint64_t time_ns) {
  std::string bytes(1, kDataCode);
  append(bytes, subscription);
  append(bytes, time_ns);
  return bytes;
}

std::string time_message(std::uint64_t time_ns) {
  std::string bytes(1, kTimeCode);
  append(bytes, time_ns);
  return bytes;
}

std::string service_response(std::uint32_t service, std::uint32_t call, std::string_view answer) {
  constexpr std::string_view kEncoding = "json";
  std::string bytes(1, kResponseCode);
  append(bytes, service);
  append(bytes, call);
  append(bytes, static_cast<std::uint32_t>(kEncoding.size()));
  bytes += kEncoding;
  return bytes.append(answer);
}

}  // namespace throng::foxglove
