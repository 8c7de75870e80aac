// A JSON value in words, for messages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace throng {

/// Short enough for a message: "[4, 2, 1]", "an array of 300", "-1", "\"red\"".
std::string describe(const nlohmann::json& value);

}  // namespace throng
