// Trees of several species: trunk, limbs, and lobes of cards with leaves.
#pragma once

#include "render/props/prop_builder.h"

namespace throng::render {

/// Adds a tree, whose species and size the prop's look determines.
void grow_tree(PropBuilder& builder);

}  // namespace throng::render
