// `throng airframes import`: converts robots described as SDF or URDF to airframes of jobs.
#pragma once

#include "cli/common/import_options.h"

namespace throng::cli {

/// Reads the robot and writes the airframe as JSON. Prints to stderr what the description does not
/// state and what of it was left out. Throws InputError.
void import_airframe(const AirframeImportOptions& options);

}  // namespace throng::cli
