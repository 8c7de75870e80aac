// The JSON Schemas of all kinds of files, for editors (`throng schema`, GET /v1/schemas).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng::jobs {

/// Names of all kinds of files: "job", "scenario", "blueprint", ...
std::vector<std::string_view> schema_names();

/// The self-contained schema of a kind of file, as JSON text; "" for an unknown name.
std::string published_schema(std::string_view name);

}  // namespace throng::jobs
