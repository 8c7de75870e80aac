// The fields of a job's camera.
#pragma once

#include "spec/job/camera_spec.h"
#include "spec/job/field_table.h"

namespace throng::jobs {

/// In the order of the schema. Every number but the image's size may be a distribution, kept in
/// CameraSpec::sampled under the field's path.
const FieldTable<CameraSpec>& camera_fields();

/// The word of a lens model: "fisheye".
const char* to_string(camera::LensModel model);

/// Fields that a calibration says, so that nothing else may.
std::span<const char* const> calibrated_fields();

}  // namespace throng::jobs
