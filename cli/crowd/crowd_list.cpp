#include "cli/crowd/crowd_list.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "crowd/project/vocabulary.h"

namespace throng::cli {

using crowd::VocabularyAttribute;
using crowd::VocabularyEntry;
using crowd::VocabularyKind;

namespace {

std::string describe_default(const VocabularyAttribute& attribute) {
  return attribute.required ? "required" : attribute.default_text;
}

/// "number, 0 to 100"
std::string describe_values(const VocabularyAttribute& attribute) {
  return attribute.range.empty() ? attribute.type
                                 : fmt::format("{}, {}", attribute.type, attribute.range);
}

std::string as_text() {
  std::string out;
  for (const VocabularyKind& kind : crowd::vocabulary()) {
    out += fmt::format("{}: {}\n\n", kind.title, kind.element);
    for (const VocabularyEntry& entry : kind.entries) {
      out += fmt::format("  {:<22} {}\n", entry.name, entry.help);
      for (const VocabularyAttribute& attribute : entry.attributes) {
        const std::string fallback = describe_default(attribute);
        out += fmt::format("    {:<20} {}{} ({})\n", attribute.name, attribute.help,
                           fallback.empty() ? "" : fmt::format(" [{}]", fallback),
                           describe_values(attribute));
      }
    }
    out += "\n";
  }
  return out;
}

/// A text for a cell of a table.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<') out += '\\';
    out += c;
  }
  return out;
}

std::string code(const std::string& text) {
  return text.empty() ? std::string() : fmt::format("`{}`", text);
}

std::string as_markdown() {
  std::string out =
      "# Vocabulary of the crowd engine's files\n\n"
      "Printed by `throng crowd --list --markdown` from the tables that read the files. See "
      "[crowd.md](../crowd.md) for how they fit together.\n";
  for (const VocabularyKind& kind : crowd::vocabulary()) {
    out += fmt::format("\n## {}\n\n{}\n\n", kind.title, cell(kind.element));
    out += "| type | attribute | values | default | meaning |\n|---|---|---|---|---|\n";
    for (const VocabularyEntry& entry : kind.entries) {
      out += fmt::format("| **{}** |  |  |  | {} |\n", entry.name, cell(entry.help));
      for (const VocabularyAttribute& attribute : entry.attributes) {
        const std::string fallback = attribute.required ? "required" : code(attribute.default_text);
        out += fmt::format("|  | {} | {} | {} | {} |\n", code(attribute.name),
                           cell(describe_values(attribute)), fallback, cell(attribute.help));
      }
    }
  }
  return out;
}

std::string as_json() {
  nlohmann::ordered_json kinds = nlohmann::ordered_json::array();
  for (const VocabularyKind& kind : crowd::vocabulary()) {
    nlohmann::ordered_json entries = nlohmann::ordered_json::array();
    for (const VocabularyEntry& entry : kind.entries) {
      nlohmann::ordered_json attributes = nlohmann::ordered_json::array();
      for (const VocabularyAttribute& attribute : entry.attributes) {
        nlohmann::ordered_json value = {{"name", attribute.name},
                                        {"type", attribute.type},
                                        {"required", attribute.required},
                                        {"help", attribute.help}};
        if (!attribute.default_text.empty()) value["default"] = attribute.default_text;
        if (!attribute.range.empty()) value["range"] = attribute.range;
        attributes.push_back(std::move(value));
      }
      entries.push_back(
          {{"name", entry.name}, {"help", entry.help}, {"attributes", std::move(attributes)}});
    }
    kinds.push_back(
        {{"kind", kind.title}, {"element", kind.element}, {"entries", std::move(entries)}});
  }
  return kinds.dump(2) + "\n";
}

}  // namespace

std::string crowd_vocabulary(std::string_view format) {
  if (format == "json") return as_json();
  if (format == "markdown") return as_markdown();
  return as_text();
}

}  // namespace throng::cli
