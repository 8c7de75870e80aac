// Camera files of other programs as one kind of value: JSON, YAML (also with OpenCV's first line)
// and OpenCV's XML.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace throng::calibrate {

/// Reads a document of at most 1 MiB. YAML's and XML's scalars are numbers where they are written
/// as such, else strings; an element of XML is an object of its children, or its text. Throws
/// InputError with the line.
nlohmann::json read_document(std::string_view text, const std::string& source);

}  // namespace throng::calibrate
