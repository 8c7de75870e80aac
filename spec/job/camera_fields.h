// The fields of a job's camera.
#pragma once

#include "spec/job/camera_spec.h"
#include "spec/job/field_table.h"

namespace throng::jobs {

/// The fields in the order of the schema. Every number except the image size may be a distribution,
/// which is kept in CameraSpec::sampled under the field's path.
const FieldTable<CameraSpec>& camera_fields();

/// The word of a lens model in jobs, for example "fisheye".
const char* to_string(camera::LensModel model);

/// Fields whose values a calibration provides; a camera with a calibration must not set them.
std::span<const char* const> calibrated_fields();

}  // namespace throng::jobs
