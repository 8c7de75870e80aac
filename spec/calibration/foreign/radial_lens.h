// Lens models of other programs that bend a ray by its angle to the optical axis only, and the
// fisheye of throng that shows the same image.
#pragma once

#include <functional>
#include <string>

#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

/// Distance of a ray's image from the optical axis, in focal lengths, by the ray's angle to the
/// axis (rad). Increases up to the largest angle that the lens sees.
using RadialLens = std::function<double(double angle_rad)>;

/// Devernay and Faugeras 2001, eq. 13, with the field of view `omega_rad` (COLMAP's and Kalibr's
/// FOV).
RadialLens fov_lens(double omega_rad);
/// Usenko, Demmel and Cremers 2018, eq. 40 (Kalibr's ds).
RadialLens double_sphere_lens(double xi, double alpha);
/// Khomutenko, Garcia and Martinet 2016, eq. 9 (Kalibr's eucm).
RadialLens extended_unified_lens(double alpha, double beta);

/// The camera with a fisheye (Lens::fisheye) instead of `lens`, whose focal lengths and center
/// `pinhole` has. The coefficients are fitted by least squares over the angles in the image; those
/// of real lenses stay within 0.1 px. Throws InputError naming `source` where the fit is worse or
/// the parameters are no lens.
CameraFile as_fisheye(const CameraFile& pinhole, const RadialLens& lens, const std::string& source);

}  // namespace throng::calibrate
