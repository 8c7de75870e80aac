// Kinds of JSON files that a user writes, recognized by their content: for messages where one is
// given in place of another.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace throng::cli {

enum class DocumentKind : std::uint8_t { unknown, job, scenario, blueprint, study };

/// By the fields at its top; `file` is its name, as blueprints end in .blueprint.json. Unknown for
/// a text that is no JSON object, too.
DocumentKind document_kind(std::string_view text, const std::string& file);

/// Throws InputError if the text is clearly of another kind, with the command that takes such a
/// file.
void require_kind(DocumentKind expected, std::string_view text, const std::string& file);

/// The same for a scenario, which a blueprint is, too.
void require_scenario(std::string_view text, const std::string& file);

/// "a job", for messages.
std::string_view to_string(DocumentKind kind);

}  // namespace throng::cli
