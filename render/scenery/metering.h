// Automatic exposure: the gain by which a camera corrects the lightness of an image, and the ISO
// speed that it chooses.
#pragma once

#include <cstdint>
#include <span>

#include "camera/camera.h"

namespace throng::render {

/// The share of white, encoded as sRGB, that the film shows of a radiance; as film() of
/// shaders/light.glsl. `black` is Daylight::film_black.
double film(double radiance, double black);

/// A pinhole camera with few pixels and the view of `camera`, limited to 100 degrees.
camera::Camera metering_camera(const camera::Camera& camera);

/// The mean CIELAB lightness at which a camera's exposure aims: 65 by day, 28 at night, in between
/// linear in the logarithm of the illuminance.
double metered_lightness(double illuminance_lux);

/// The gain of light by which an image with these sRGB bytes approaches a mean lightness. As in
/// real cameras, it corrects most of the difference, within limits, so that scenarios still differ
/// in brightness. `film_black` is Daylight::film_black.
double metering_gain(std::span<const std::uint8_t> rgb, double lightness, double film_black);

/// The ISO speed of a camera at f/2.8 and 1/60 s in this light (the incident-light equation of ISO
/// 2720 with C = 250), times the gain. Returns 0 (no noise) below 400, where noise is invisible,
/// and at most 1600, since cameras remove more noise than that.
double metered_iso(double illuminance_lux, double gain);

}  // namespace throng::render
