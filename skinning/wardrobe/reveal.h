// The skin that garments cover.
#pragma once

#include <vector>

#include "skinning/body/makehuman.h"

namespace throng::skinning {

/// Per body vertex: whether the garment covers it closely, on the unmorphed body.
std::vector<bool> skin_under(const MakeHuman& makehuman, const Proxy& garment);

/// Removes the outermost `rows` of vertices along the borders of the set.
std::vector<bool> without_border(const MakeHuman& makehuman, std::vector<bool> vertices, int rows);

}  // namespace throng::skinning
