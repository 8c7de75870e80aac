// Catalog of names that jobs may use: airframes, formats, policies and characters.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace throng::jobs {

/// {"airframes": [...], "formats": [...], "policies": [...]}, as the service returns them.
nlohmann::json catalog();

/// The character library: {"content_hash", "license", "people": [...]}; null if there is none.
/// Throws InputError if its index is damaged.
nlohmann::json people_catalog();

}  // namespace throng::jobs
