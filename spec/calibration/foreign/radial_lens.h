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

/// The field-of-view model of Devernay and Faugeras 2001 (COLMAP's FOV, Kalibr's fov).
RadialLens fov_lens(double omega_rad);
/// The double sphere of Usenko, Demmel and Cremers 2018 (Kalibr's ds).
RadialLens double_sphere_lens(double xi, double alpha);
/// The extended unified model of Khomutenko, Garcia and Martinet 2016 (Kalibr's eucm).
RadialLens extended_unified_lens(double alpha, double beta);

/// The camera with a fisheye (Lens::fisheye) instead of `lens`, whose focal lengths and center
/// `pinhole` has. The coefficients are fitted by least squares over the angles in the image.
/// Throws InputError naming `source` if the fit differs by more than 0.1 px or the parameters are
/// no lens.
CameraFile as_fisheye(const CameraFile& pinhole, const RadialLens& lens, const std::string& source);

}  // namespace throng::calibrate
