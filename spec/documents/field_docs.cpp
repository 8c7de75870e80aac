#include "spec/documents/field_docs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <regex>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "spec/job/job_fields.h"

namespace throng::jobs {

using nlohmann::ordered_json;

namespace {

constexpr std::string_view kHead =
    "| field | values | unit | default | meaning |\n|---|---|---|---|---|\n";

/// Lists as a person writes them: ["coco", "density"].
std::string json_text(const ordered_json& value) {
  if (!value.is_array()) return value.dump();
  std::vector<std::string> parts;
  for (const ordered_json& part : value) parts.push_back(json_text(part));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string type_in(const ordered_json& rules) {
  const ordered_json& type = rules.at("type");
  return type.is_array() ? type.front() : type;
}

std::string words_text(const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  quoted.reserve(words.size());
  for (const std::string& word : words) quoted.push_back("`\"" + word + "\"`");
  return fmt::format("{}", fmt::join(quoted, ", "));
}

std::string range_in(const ordered_json& rules) {
  const bool above = rules.contains("exclusiveMinimum");
  return fmt::format("{}{} to {}", above ? "above " : "",
                     rules.at(above ? "exclusiveMinimum" : "minimum").dump(),
                     rules.at("maximum").dump());
}

/// Description of the elements of a list.
std::string items_text(const ordered_json& rules) {
  if (rules.contains("enum")) return words_text(rules["enum"]);
  if (rules.contains("title")) {
    auto title = rules["title"].get<std::string>();
    title[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(title[0])));
    return title + "s";
  }
  const std::string type = type_in(rules);
  if (type != "string") return fmt::format("{}s, {}", type, range_in(rules));
  return fmt::format("texts of {} to {} characters", rules.at("minLength").dump(),
                     rules.at("maxLength").dump());
}

/// The words of a choice, from its pattern "^(a|b)$".
std::vector<std::string> words_in(const std::string& pattern) {
  std::vector<std::string> words(1);
  for (const char c : pattern.substr(2, pattern.size() - 4)) {
    if (c == '|') {
      words.emplace_back();
    } else {
      words.back().push_back(c);
    }
  }
  return words;
}

std::string values_text(const ordered_json& rules) {
  if (rules.contains("x-distribution")) {
    const bool is_choice = rules["x-distribution"].size() == 1;
    if (is_choice) return words_text(words_in(rules.at("pattern"))) + "; or a choice";
    return rules.at("x-expected").get<std::string>() + "; or a distribution";
  }
  if (rules.contains("enum")) return words_text(rules["enum"]);
  if (rules.contains("x-expected")) return rules["x-expected"];
  const std::string type = type_in(rules);
  if (type == "boolean") return "true or false";
  if (type == "object") return "an object";
  if (type == "array") {
    const int min_items = rules.value("minItems", 0);
    const int max_items = rules.at("maxItems");
    return fmt::format("list of {}: {}",
                       min_items == max_items ? fmt::format("{}", max_items)
                                              : fmt::format("{} to {}", min_items, max_items),
                       items_text(rules.at("items")));
  }
  if (type == "string") {
    return fmt::format("text of {} to {} characters", rules.at("minLength").dump(),
                       rules.at("maxLength").dump());
  }
  return fmt::format("{}, {}", type, range_in(rules));
}

void append_rows(const ordered_json& object, const std::string& path, std::string& rows) {
  const ordered_json required = object.value("required", ordered_json::array());
  for (const auto& [name, rules] : object.at("properties").items()) {
    if (rules.value("deprecated", false)) continue;
    const std::string place = path + name;
    const bool has_fields = rules.contains("properties") && !rules["properties"].empty();
    if (has_fields) {
      append_rows(rules, place + ".", rows);
      continue;
    }
    const bool is_required = std::find(required.begin(), required.end(), name) != required.end();
    const std::string default_text = is_required ? "required"
                                     : rules.contains("default")
                                         ? "`" + json_text(rules["default"]) + "`"
                                         : "";
    static const std::regex kDocument(R"(docs/(\w+\.md))");
    const std::string help =
        std::regex_replace(rules.at("description").get<std::string>(), kDocument, "[$1]($1)");
    rows += fmt::format("| `{}` | {} | {} | {} | {} |\n", place, values_text(rules),
                        rules.value("unit", ""), default_text, help);
    if (rules.contains("items") && rules["items"].contains("properties")) {
      append_rows(rules["items"], place + "[].", rows);
    }
  }
}

}  // namespace

std::string job_fields_markdown() {
  std::string rows;
  append_rows(ordered_job_schema(), "", rows);
  return rows;
}

std::string with_job_fields(const std::string& document) {
  const std::size_t head = document.find(kHead);
  if (head == std::string::npos) {
    throw InputError({"docs/job.md", "", "no table of fields", std::string(kHead)});
  }
  const std::size_t first = head + kHead.size();
  const std::size_t end = document.find("\n\n", first) + 1;
  return document.substr(0, first) + job_fields_markdown() + document.substr(end);
}

}  // namespace throng::jobs
