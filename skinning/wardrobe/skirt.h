// Skirts, which the package's CC0 part lacks but for one: cut from the base mesh's helper skirt, a
// cone from the waist to the ankles that morphs with the body.
#pragma once

#include "skinning/body/makehuman.h"
#include "skinning/image.h"

namespace throng::skinning {

/// The skirt down to the ankles, as a garment that hangs on the helper's own vertices; those who
/// wear it cut it at a hem. It follows the thighs and, below the knees, half the shins. Its
/// texture coordinates go once around and from the waist to the ankles.
Proxy make_skirt(const MakeHuman& makehuman);

/// Its cloth: folds that widen downwards, as light and shade.
Image skirt_cloth(int size);

}  // namespace throng::skinning
