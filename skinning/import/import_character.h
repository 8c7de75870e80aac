// One rigged model as a character of ours.
#pragma once

#include "skinning/bake/workbench.h"
#include "skinning/import/description.h"

namespace throng::skinning {

/// Scaled to its height, its rig mapped to ours, with all standard clips (its own where it has
/// them), levels of detail, and images of this size. Throws InputError naming the error and its
/// file must change.
BakedPerson import_character(const CharacterDescription& description, int texture_size);

}  // namespace throng::skinning
