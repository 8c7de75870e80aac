// Skin covered by a garment.
#pragma once

#include <vector>

#include "skinning/body/makehuman.h"

namespace throng::skinning {

/// Per body vertex: whether the garment lies close over it, on the unmorphed body.
std::vector<bool> skin_under(const MakeHuman& makehuman, const Proxy& garment);

/// Without the outermost `rows` of vertices along the borders.
std::vector<bool> without_border(const MakeHuman& makehuman, std::vector<bool> vertices, int rows);

}  // namespace throng::skinning
