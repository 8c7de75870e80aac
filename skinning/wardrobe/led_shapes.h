// Shapes of what people lean on and of what they lead over the ground on wheels.
#pragma once

#include "skinning/wardrobe/item_parts.h"

namespace throng::skinning::items {

void add_walking_stick(Shape& shape, const Site& site);
void add_suitcase(Shape& shape, const Site& site);
void add_pram(Shape& shape, const Site& site);
void add_bicycle(Shape& shape, const Site& site);

}  // namespace throng::skinning::items
