#include "spec/job/randomize.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json/json_integer.h"
#include "base/text/suggest.h"
#include "spec/job/schema.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr const char* kDistribution = "x-distribution";
constexpr const char* kElsewhere = "x-randomize";

bool is_index(const std::string& word) {
  return !word.empty() && word.size() < 3 &&
         std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<std::string> path_words(const std::string& path) {
  std::vector<std::string> words(1);
  for (const char c : path) {
    if (c == '.') {
      words.emplace_back();
    } else {
      words.back().push_back(c);
    }
  }
  return words;
}

/// The schema of the field, or null if there is none or it may not be sampled.
const json* rules_at(const std::vector<std::string>& words) {
  const json* node = &job_schema();
  for (const std::string& word : words) {
    if (is_index(word)) {
      if (!node->contains("items")) return nullptr;
      node = &node->at("items");
    } else {
      const auto fields = node->find("properties");
      if (fields == node->end() || !fields->contains(word)) return nullptr;
      node = &fields->at(word);
    }
  }
  return node->contains(kDistribution) || node->contains(kElsewhere) ? node : nullptr;
}

Quantity enum_quantity(const json& words) {
  return {fmt::format("one of {}", words.dump()),
          [words](const json& value) -> std::optional<double> {
            const auto found = std::find(words.begin(), words.end(), value);
            if (found == words.end()) return std::nullopt;
            return static_cast<double>(found - words.begin());
          },
          [words](double index) { return words.at(static_cast<std::size_t>(index)); },
          0,
          static_cast<double>(words.size()) - 1,
          false};
}

Quantity read_quantity(const json& rules) {
  if (rules.contains("enum")) return enum_quantity(rules["enum"]);
  Quantity quantity =
      fields::number_quantity(rules.at("minimum").get<double>(), rules.at("maximum").get<double>());
  if (rules.at("type") != "integer") return quantity;
  quantity.expected.replace(0, std::string_view("a number").size(), "an integer");
  quantity.number = [number = quantity.number](const json& value) {
    return is_integer(value) ? number(value) : std::nullopt;
  };
  quantity.json = [](double value) { return json(std::llround(value)); };
  return quantity;
}

/// Whether the list places that the path names are there: "drones.3" of three drones is not. A list
/// that is left out may be filled by the scenario, but holds no distribution of the job's own.
bool is_there(const json& job, const std::vector<std::string>& words, bool in_place) {
  const json* node = &job;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (is_index(words[i])) {
      const auto index = static_cast<std::size_t>(std::stoi(words[i]));
      if (!node->is_array() || index >= node->size()) return false;
      node = &node->at(index);
    } else if (node->contains(words[i])) {
      node = &node->at(words[i]);
    } else {
      // A field that is left out has a default.
      return !in_place ||
             std::none_of(words.begin() + static_cast<std::ptrdiff_t>(i), words.end(), is_index);
    }
  }
  return true;
}

void add_paths(const json& rules, const std::string& path, std::vector<std::string>& paths) {
  if (rules.contains(kDistribution) || rules.contains(kElsewhere)) paths.push_back(path);
  const auto step = [&](const std::string& word) {
    return path.empty() ? word : fmt::format("{}.{}", path, word);
  };
  if (rules.contains("items")) add_paths(rules["items"], step("0"), paths);
  if (!rules.contains("properties")) return;
  for (const auto& [name, field] : rules["properties"].items()) {
    add_paths(field, step(name), paths);
  }
}

/// The problem of a path that no field has, with the nearest that one has. `value` may be an object
/// of fields: paths are dotted, not nested.
Problem unknown_path(const std::string& path, const json& value) {
  const std::vector<std::string> paths = random_paths();
  std::string asked = path;
  if (value.is_object()) {
    for (const auto& field : value.items()) {
      const std::string nested = fmt::format("{}.{}", path, field.key());
      if (std::find(paths.begin(), paths.end(), nested) != paths.end()) asked = nested;
    }
  }
  Problem problem = unknown_name("", "/randomize/" + path, "path", asked,
                                 std::vector<std::string_view>(paths.begin(), paths.end()));
  problem.found = fmt::format("unknown path \"{}\"", path);
  if (!problem.expected.starts_with('"')) {
    problem.expected =
        "the dotted path of a field that may be sampled, for example "
        "\"environment.time_of_day\" or \"drones.0.camera.pitch_deg\"";
  }
  return problem;
}

}  // namespace

json RandomField::draw(std::uint64_t run_seed) const {
  return quantity.json(distribution.draw(run_seed, pointer));
}

std::vector<RandomField> take_randomize(json& job, std::vector<Problem>& problems) {
  std::vector<RandomField> fields;
  const json block = job.value("randomize", json::object());
  job.erase("randomize");
  for (const auto& [path, value] : block.items()) {
    const std::vector<std::string> words = path_words(path);
    const std::string place = fmt::format("/randomize/{}", path);
    const json* rules = rules_at(words);
    if (rules == nullptr) {
      problems.push_back(unknown_path(path, value));
      continue;
    }
    if (!is_there(job, words, rules->contains(kDistribution))) {
      problems.push_back({"", place, fmt::format("\"{}\"", path), "a place that the job fills"});
      continue;
    }
    std::string pointer;
    for (const std::string& word : words) pointer += "/" + word;
    if (rules->contains(kDistribution)) {
      job[json::json_pointer(pointer)] = value;
      continue;
    }
    RandomField field{path, pointer, read_quantity(*rules)};
    field.distribution = Distribution::read(value, field.quantity, place, problems);
    fields.push_back(std::move(field));
  }
  return fields;
}

json to_json(const std::vector<RandomField>& fields) {
  json block = json::object();
  for (const RandomField& field : fields) {
    block[field.path] = field.distribution.to_json(field.quantity);
  }
  return block;
}

std::vector<std::string> random_paths() {
  std::vector<std::string> paths;
  add_paths(job_schema(), "", paths);
  return paths;
}

std::string dotted(const std::string& pointer) {
  std::string path = pointer.substr(1);
  std::replace(path.begin(), path.end(), '/', '.');
  return path;
}

}  // namespace throng::jobs
