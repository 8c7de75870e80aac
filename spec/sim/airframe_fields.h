// Fields of an airframe in JSON.
#pragma once

#include "base/json/field_table.h"
#include "spec/sim/airframe.h"

namespace throng::sim {

/// The fields, whose values and limits are those of one airframe of airframes.json.
const fields::FieldTable<Airframe>& airframe_fields();

}  // namespace throng::sim
