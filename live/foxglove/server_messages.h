// Messages of the server in the WebSocket protocol foxglove.websocket.v1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "live/foxglove/channels.h"
#include "live/foxglove/client_messages.h"

namespace throng::foxglove {

/// The first message to a client. `session` is another text for each server.
std::string server_info(const std::string& name, const std::string& session);

/// The channels; a channel's id is its index.
std::string advertise_channels(const std::vector<Channel>& channels);

/// The services; a service's id is its index.
std::string advertise_services(const std::vector<Service>& services);

std::string status(Level level, std::string_view text);

/// `id` is that of the request.
std::string parameter_values(const std::vector<Parameter>& parameters,
                             const std::optional<std::string>& id);

std::string service_failure(std::uint32_t service, std::uint32_t call, std::string_view text);

/// Bytes in front of a message's own.
std::string data_head(std::uint32_t subscription, std::uint64_t time_ns);

std::string time_message(std::uint64_t time_ns);

/// An answer in JSON.
std::string service_response(std::uint32_t service, std::uint32_t call, std::string_view answer);

}  // namespace throng::foxglove
