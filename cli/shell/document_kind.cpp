#include "cli/shell/document_kind.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json/json_text.h"
#include "cli/shell/input_file.h"
#include "world/scenario.h"
#include "world/scenario_id.h"

namespace throng::cli {

namespace {

struct KindWords {
  std::string_view name;
  std::string_view command;  ///< that takes such a file
};
constexpr std::array kWords = {
    KindWords{"a file of an unknown kind", ""},
    KindWords{"a job", "`throng run`"},
    KindWords{"a scenario", "`throng scenario check`, and a job names it"},
    KindWords{"a blueprint", "`throng scenario check`, and a job names it"},
    KindWords{"a study", "`throng study`"},
};

const KindWords& kind_words(DocumentKind kind) { return kWords.at(static_cast<std::size_t>(kind)); }

}  // namespace

std::string_view to_string(DocumentKind kind) { return kind_words(kind).name; }

DocumentKind document_kind(std::string_view text, const std::string& file) {
  const nlohmann::json value = parse_json_or_discard(text);
  if (!value.is_object()) return DocumentKind::unknown;
  const auto has_any = [&](std::initializer_list<const char*> keys) {
    return std::any_of(keys.begin(), keys.end(),
                       [&](const char* key) { return value.contains(key); });
  };
  if (has_any({"scenario", "generate"})) return DocumentKind::job;
  if (has_any({"policies", "cases"})) return DocumentKind::study;
  if (world::is_blueprint_name(file) || has_any({"people", "rows"})) return DocumentKind::blueprint;
  if (has_any({"inside", "disaster_agents"})) return DocumentKind::scenario;
  if (has_any({"ground", "buildings", "exits"})) {
    return value.contains("crowd") ? DocumentKind::scenario : DocumentKind::blueprint;
  }
  return has_any({"capture", "drones", "runs", "outputs"}) ? DocumentKind::job
                                                           : DocumentKind::unknown;
}

std::string read_job_document(const std::string& file) {
  std::string expected = "a job file";
  if (!std::filesystem::exists(file)) {
    const auto id = world::scenario_id_in(world::scenarios_folder(), file);
    if (id) expected += fmt::format(R"(, which may be {{"scenario": "{}"}})", *id);
  }
  std::string text = read_input_file(file, expected);
  require_kind(DocumentKind::job, text, file);
  return text;
}

void require_scenario(std::string_view text, const std::string& file) {
  if (document_kind(text, file) != DocumentKind::blueprint) {
    require_kind(DocumentKind::scenario, text, file);
  }
}

void require_kind(DocumentKind expected, std::string_view text, const std::string& file) {
  const DocumentKind kind = document_kind(text, file);
  if (kind == expected || kind == DocumentKind::unknown) return;
  throw InputError({file, "", std::string(kind_words(kind).name),
                    fmt::format("{}; {} is for {}", kind_words(expected).name,
                                kind_words(kind).name, kind_words(kind).command)});
}

}  // namespace throng::cli
