// CPU time of images with the software renderer, estimated: how jobs are divided into shards and
// what `throng check` and dry runs say of their time.
#pragma once

#include "spec/camera/camera_spec.h"
#include "spec/render/quality.h"

namespace throng::jobs {

/// Seconds of one core for an image with so many people in view. Measured: the tables of
/// docs/rendering.md and docs/shipped_scenarios.md.
double image_cpu_s(render::Quality quality, const camera::CameraSpec& camera,
                   double people_in_view);

/// Seconds that a worker spends on a camera before its first image: the map of a lens that
/// distorts.
double camera_setup_cpu_s(const camera::CameraSpec& camera);

/// Share of the people that an image shows; unknown before the simulation.
inline constexpr double kShareInView = 0.5;

}  // namespace throng::jobs
