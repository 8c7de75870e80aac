// People made of boxes, for tests and benchmarks that must not depend on baked assets.
#pragma once

#include <cstdint>

#include "render/renderer.h"
#include "skinning/population.h"

namespace throng::render {

/// Stature of every synthetic person (m).
inline constexpr float kSyntheticStatureM = 1.8F;

/// `characters` equal bodies of 21 bones with two levels of detail (each face of level 0 is cut in
/// four), an alpha-tested head of hair, and clips idle (1 palette), walk and run (8 each).
skinning::Population synthetic_people(std::size_t characters = 2);

/// The same people, each under a square umbrella of this half width, 1.9 m above the ground.
skinning::Population under_umbrellas(float half_m, std::size_t characters = 2);

/// The same people, each behind a box on the ground, 0.6 to 1.2 m ahead, as behind a pram.
skinning::Population behind_prams(std::size_t characters = 2);

/// Somebody of `population` who stands still.
PersonInstance standing(const skinning::Population& population, std::uint32_t agent, double x,
                        double y, double yaw_rad = 0);

}  // namespace throng::render
