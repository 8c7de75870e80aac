// Automatic exposure: how a camera meters an image, and the noise of a sensor in that light.
#pragma once

#include <cstdint>
#include <span>

#include "camera/camera.h"

namespace throng::render {

/// A pinhole camera of few pixels with the view of this one, at most 100 degrees wide.
camera::Camera metering_camera(const camera::Camera& camera);

/// CIELAB's mean lightness that a camera's exposure aims at: 65 by day, 28 at night, between them
/// linear in the illuminance's logarithm.
double metered_lightness(double illuminance_lux);

/// The gain of light by which an image of these sRGB bytes, as the film shows them, comes near a
/// mean lightness: cameras correct most of a difference, so that places differ in brightness, and
/// no more than their range allows.
double metering_gain(std::span<const std::uint8_t> rgb, double lightness);

/// The ISO speed of a camera at f/2.8 and 1/60 s in this light (the incident-light equation of ISO
/// 2720 with C = 250), times the gain. 0, no noise, below 400, where it cannot be seen; above 1600
/// cameras remove what there is more.
double metered_iso(double illuminance_lux, double gain);

}  // namespace throng::render
