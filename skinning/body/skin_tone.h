// Keeps the colors of skins to those that people have: some of the package's images are painted
// redder than any skin is under white light.
#pragma once

#include "skinning/image.h"

namespace throng::skinning {

/// Raises green and blue all over the image where its median color is more than 8 % redder than
/// human skin of that lightness: between the patches "dark skin", sRGB (115, 82, 68), and "light
/// skin", (194, 150, 130), of the color chart of McCamy, Marcus and Davidson (1976).
void tone_skin(Image& image);

}  // namespace throng::skinning
