// Estimate of the memory that the models of a job take in a worker that renders it.
#pragma once

#include <cstdint>

#include "world/scenario.h"

namespace throng::jobs {

/// Memory (MiB) of the character library and of the scenario's meshes and props while a worker
/// loads and draws them (SceneLoad::models_mib), on the high side. Reads the meshes. A library that
/// is missing or damaged counts as the shipped one. Throws InputError for a mesh that cannot be
/// read.
std::int64_t models_memory_mib(const world::Scenario& scenario);

}  // namespace throng::jobs
