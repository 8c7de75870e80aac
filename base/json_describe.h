// A JSON value in words, for messages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace throng {

/// Short enough for a message: "an array of 3", "-1", "\"red\"".
std::string describe(const nlohmann::json& value);

}  // namespace throng
