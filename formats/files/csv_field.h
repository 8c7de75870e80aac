// Conversion of JSON members to CSV fields.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace throng::formats {

/// A member of a record as a CSV field, quoted if needed; "" for null and missing members.
inline std::string csv_field(const nlohmann::json& record, const char* key) {
  const auto found = record.find(key);
  if (found == record.end() || found->is_null()) return "";
  if (!found->is_string()) return found->dump();
  const std::string text = *found;
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) {
    if (c == '"') quoted.push_back(c);
    quoted.push_back(c);
  }
  quoted.push_back('"');
  return quoted;
}

}  // namespace throng::formats
