// Rules of an airframe that span several fields.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/json/field_table.h"
#include "spec/sim/airframe.h"

namespace throng::sim {

/// Checks that motors are described, that rotors fit their arms and can steer, and that they lift
/// the vehicle; adds problems to the list of `place`. `value` is the object that `frame` was read
/// from. A rule on a field that has a problem already is left out.
void check_airframe(const Airframe& frame, const nlohmann::json& value,
                    const fields::FieldLocation& place);

}  // namespace throng::sim
