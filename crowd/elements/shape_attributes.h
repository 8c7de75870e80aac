// How shapes are written in the files.
#pragma once

#include "crowd/elements/attributes.h"
#include "crowd/elements/shapes.h"

namespace throng::crowd {

/// min_x, min_y, max_x, max_y
AttributeTable box_attributes();
/// Throws InputError when a maximum is below its minimum.
Box read_box(const Element& element, const Attributes& attributes);

/// <x>, <y>, width, height, angle; the pivot's attribute names differ between goals and conditions.
AttributeTable turned_box_attributes(std::string_view x, std::string_view y);
TurnedBox read_turned_box(const Attributes& attributes, std::string_view x, std::string_view y);

/// <x>, <y>, radius
AttributeTable circle_attributes(std::string_view x, std::string_view y);
Circle read_circle(const Attributes& attributes, std::string_view x, std::string_view y);

}  // namespace throng::crowd
