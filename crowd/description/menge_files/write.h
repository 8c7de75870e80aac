// Writes descriptions as Menge's XML.
#pragma once

#include <string>

#include "crowd/description/description.h"

namespace throng::crowd {

/// Returns the description as XML in UTF-8; read_description() of it gives an equal description.
/// Throws InputError for names that are invalid in XML and for duplicate attributes.
std::string to_xml(const Description& description);

}  // namespace throng::crowd
