// Descriptions of JSON values for messages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace throng {

/// Returns a short text: "[4, 2, 1]", "an array of 300", "-1", "\"red\"".
std::string describe(const nlohmann::json& value);

}  // namespace throng
