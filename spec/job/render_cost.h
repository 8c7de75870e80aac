// Estimates of the CPU time of images with the software renderer, used to divide jobs into shards
// and to report the expected time in `throng check` and dry runs.
#pragma once

#include "spec/camera/camera_spec.h"
#include "spec/render/quality.h"

namespace throng::jobs {

/// CPU time (s) of an image with this number of people in view, from the measurements in
/// docs/rendering.md and docs/shipped_scenarios.md.
double image_cpu_s(render::Quality quality, const camera::CameraSpec& camera,
                   double people_in_view);

/// CPU time (s) that a worker spends on a camera before its first image, on the map of a lens with
/// distortion.
double camera_setup_cpu_s(const camera::CameraSpec& camera);

/// Assumed share of the people that an image shows, which is unknown before the simulation.
inline constexpr double kShareInView = 0.5;

}  // namespace throng::jobs
