// Conversion of a rigged model to a character of the library.
#pragma once

#include "skinning/bake/workbench.h"
#include "spec/skinning/character_description.h"

namespace throng::skinning {

/// Converts a model: scales it to its height, maps its rig, and makes all standard clips (from its
/// own animations if it has them), levels of detail, and textures of this size. Throws InputError
/// naming the file and the error.
BakedPerson import_character(const CharacterDescription& description, int texture_size);

}  // namespace throng::skinning
