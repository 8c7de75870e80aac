// Writes descriptions as Menge's XML.
#pragma once

#include <string>

#include "crowd/description/description.h"

namespace throng::crowd {

/// The file's text, in UTF-8. Reading it gives an equal description. Throws InputError for names
/// that XML cannot have and for attributes that an element has twice.
std::string to_xml(const Description& description);

}  // namespace throng::crowd
