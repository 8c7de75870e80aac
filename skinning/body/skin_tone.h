// Correction of skin colors: some of the package's images are redder than any skin under white
// light.
#pragma once

#include "skinning/image.h"

namespace throng::skinning {

/// Raises green and blue of the whole image if its median color is more than 8 % redder than human
/// skin of the same lightness, interpolated between the patches "dark skin", sRGB (115, 82, 68),
/// and "light skin", (194, 150, 130), of the color chart of McCamy, Marcus and Davidson (1976).
void tone_skin(Image& image);

}  // namespace throng::skinning
