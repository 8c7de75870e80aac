// The JSON Schemas that editors complete and check files with: `throng schema`, GET /v1/schemas.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng::jobs {

/// Names of all kinds of files: "job", "scenario", "blueprint", ...
std::vector<std::string_view> schema_names();

/// The schema of a kind as JSON, complete in itself; empty for a name that is none.
std::string published_schema(std::string_view name);

}  // namespace throng::jobs
