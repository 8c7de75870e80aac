// Fields of an airframe in JSON: reading and writing.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "spec/sim/airframe.h"
#include "world/json_reader.h"

namespace throng::sim {

/// Reads an airframe; problems go to the value's list.
Airframe read_airframe_fields(const std::string& name, const world::JsonValue& value);

}  // namespace throng::sim
