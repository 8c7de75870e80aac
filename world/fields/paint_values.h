// Colors in scenario files: "#a05030", in sRGB.
#pragma once

#include <string>

#include "base/json/field_table.h"
#include "world/building.h"

namespace throng::world {

/// Texts such as "#a05030".
fields::Values paints();

/// The color of such a text, and its text.
Paint paint_from_hex(const std::string& text);
std::string hex_from_paint(const Paint& paint);

}  // namespace throng::world
