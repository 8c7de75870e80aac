// Skirts, of which the package has only one under CC0. They are cut from the base mesh's helper
// skirt, a cone from the waist to the ankles that morphs with the body.
#pragma once

#include "skinning/body/makehuman.h"
#include "skinning/image.h"

namespace throng::skinning {

/// The skirt down to the ankles, as a proxy attached to the helper's vertices; outfits cut it at a
/// hem. It follows the thighs and, below the knees, half of the motion of the shins. Its texture
/// coordinates run once around the body and from the waist to the ankles.
Proxy make_skirt(const MakeHuman& makehuman);

/// The texture of the skirt: light and shade of folds that widen downward, up to `depth` lighter
/// and darker.
Image skirt_cloth(int size, double depth);

}  // namespace throng::skinning
