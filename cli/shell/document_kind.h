// Kinds of JSON files that users write, recognized by their content, for messages about a wrong
// kind.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace throng::cli {

enum class DocumentKind : std::uint8_t { unknown, job, scenario, blueprint, study };

/// The kind of a document, from its top-level members and the ending of its name `file`
/// (.blueprint.json). `unknown` also for text that is no JSON object.
DocumentKind document_kind(std::string_view text, const std::string& file);

/// Throws InputError if the text is clearly of another kind; the message names the command for that
/// kind.
void require_kind(DocumentKind expected, std::string_view text, const std::string& file);

/// The text of a job file that a user named. Throws InputError if it is missing or of another kind;
/// the message tells how a job names a scenario if that is what was named.
std::string read_job_document(const std::string& file);

/// As require_kind() for scenarios; accepts blueprints, too.
void require_scenario(std::string_view text, const std::string& file);

/// The name of a kind for messages: "a job".
std::string_view to_string(DocumentKind kind);

}  // namespace throng::cli
