// Attributes of shapes in files.
#pragma once

#include "crowd/elements/attributes.h"
#include "crowd/elements/shapes.h"

namespace throng::crowd {

/// Attributes min_x, min_y, max_x, max_y.
AttributeTable box_attributes();
/// Throws InputError if a max is less than its min.
Box read_box(const Element& element, const Attributes& attributes);

/// Attributes <x>, <y>, width, height, angle. The names of the pivot differ between goals and
/// conditions.
AttributeTable turned_box_attributes(std::string_view x, std::string_view y);
TurnedBox read_turned_box(const Attributes& attributes, std::string_view x, std::string_view y);

/// Attributes <x>, <y>, radius.
AttributeTable circle_attributes(std::string_view x, std::string_view y);
Circle read_circle(const Attributes& attributes, std::string_view x, std::string_view y);

}  // namespace throng::crowd
