// Catalog of names that jobs may use: airframes, formats, policies, and the people rendered.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace throng::jobs {

/// {"airframes": [...], "formats": [...], "policies": [...]}, as the service lists them.
nlohmann::json catalog();

/// The character library, {"content_hash", "license", "people": [...]}; null when there is none.
/// Throws InputError when their index is damaged.
nlohmann::json people_catalog();

}  // namespace throng::jobs
