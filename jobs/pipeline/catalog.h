// What jobs may name: airframes, formats, policies, and the people who are rendered.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace throng::jobs {

/// {"airframes": [...], "formats": [...], "policies": [...]}, as the service lists them.
nlohmann::json catalog();

/// The baked people, {"content_hash", "license", "people": [...]}; null when none have been baked.
/// Throws InputError when their index is damaged.
nlohmann::json people_catalog();

}  // namespace throng::jobs
