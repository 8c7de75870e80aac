// Faults of XML in the words of a message, instead of those of the parsers' libraries.
#pragma once

#include <string>

namespace throng::imports {

/// The fault for which TinyXML-2 refused a text (tinyxml2::XMLError), such as "an end tag that does
/// not match its start tag".
std::string tinyxml_fault(int error);

/// The fault for which Expat refused a text (XML_Error).
std::string expat_fault(int error);

}  // namespace throng::imports
