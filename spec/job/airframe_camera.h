// The camera that an airframe brings along, as defaults of its drone's camera.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "spec/job/field_table.h"

namespace throng::jobs {

/// A drone's JSON with the fields of its own airframe's "camera" that its camera omits. Of a camera
/// with a preset or a calibration, whose lens that is, only direction, mount and gimbal come from
/// the airframe. `place` is the drone's position in the job; problems of the airframe's camera are
/// added there.
nlohmann::json with_airframe_camera(const nlohmann::json& drone, const FieldLocation& place);

}  // namespace throng::jobs
