// The scenarios of a folder, by their ids.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/resources.h"
#include "base/json/json_text.h"
#include "base/text/suggest.h"
#include "base/text/words.h"
#include "world/scenario.h"
#include "world/scenario_id.h"

namespace throng::world {

namespace fs = std::filesystem;

namespace {

constexpr std::array kScenarioParts = {"ground", "inside", "exits", "crowd", "extends"};

bool is_scenario_id(std::string_view id) {
  const auto in_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  char previous = '/';
  for (const char c : id) {
    if (!in_word(c) && (c != '/' || previous == '/')) return false;
    previous = c;
  }
  return previous != '/';
}

enum class Content { scenario, unknown, something_else };

/// Says whether a file holds parts of a scenario, what its reader reports, or sound JSON
/// of another kind, such as a job, which may have a "crowd", or a study.
Content classify(const fs::path& file) {
  nlohmann::json value;
  try {
    value = parse_json_or_discard(read_file(file));
  } catch (const EnvironmentError&) {
    return Content::unknown;
  }
  if (value.is_discarded() || value.empty()) return Content::unknown;
  if (!value.is_object() || value.contains("scenario")) return Content::something_else;
  return std::any_of(kScenarioParts.begin(), kScenarioParts.end(),
                     [&](const char* part) { return value.contains(part); })
             ? Content::scenario
             : Content::something_else;
}

struct NamedFile {
  fs::path name;   ///< relative to the folder of scenarios
  std::string id;  ///< which may be none: see is_scenario_id()
};

std::vector<NamedFile> json_files(const fs::path& folder) {
  std::vector<NamedFile> files;
  std::error_code error;
  // A server's folder holds links to shipped scenarios and to uploads.
  fs::recursive_directory_iterator entries(folder, fs::directory_options::follow_directory_symlink,
                                           error);
  if (error == std::errc::no_such_file_or_directory) {
    throw InputError({folder.string(), "", "no such folder",
                      "the folder of scenarios (environment variable THRONG_SCENARIOS)"});
  }
  if (error == std::errc::not_a_directory) {
    throw InputError({folder.string(), "", "a file",
                      "the folder of scenarios (environment variable THRONG_SCENARIOS)"});
  }
  if (error) {
    throw EnvironmentError(
        fmt::format("cannot read the scenarios in {}: {}", folder.string(), error.message()));
  }
  constexpr int kDeepest = 8;  // links may lead in circles
  for (; entries != fs::recursive_directory_iterator(); entries.increment(error)) {
    const fs::directory_entry& entry = *entries;
    if (entries.depth() >= kDeepest) entries.disable_recursion_pending();
    if (entry.path().extension() != ".json" || !entry.is_regular_file(error)) continue;
    fs::path name = entry.path().lexically_relative(folder);
    // Jobs and the like ("demo.job.json") have a dot left here, which no id has.
    std::string id = (name.parent_path() / id_from_file(name)).generic_string();
    files.push_back({std::move(name), std::move(id)});
  }
  std::sort(files.begin(), files.end(),
            [](const NamedFile& a, const NamedFile& b) { return a.name < b.name; });
  return files;
}

/// A name of a file, which may hold anything, for a message.
std::string name_found(const std::string& name) {
  constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
  return "the name " + nlohmann::json(name).dump(-1, ' ', false, kReplace);
}

/// The id that is most like a name.
std::string similar_id(std::string_view name) {
  std::string id;
  for (const char c : lower_case(name)) {
    const bool continues_a_character = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
    if (!continues_a_character) id += c == '/' || is_scenario_id({&c, 1}) ? c : '_';
  }
  return id;
}

std::string_view last_part(std::string_view id) { return id.substr(id.rfind('/') + 1); }

/// Ids that a name means beside misspelled ones: the end of a path is an id
/// ("scenarios/campus/everyday.json"), the name is a folder of ids or the last part of some.
std::vector<std::string_view> meant_by(std::string_view name,
                                       std::span<const std::string_view> known) {
  for (const std::string_view ending : {kBlueprintEnding, kFormerBlueprintEnding,
                                        std::string_view(".json"), std::string_view("/")}) {
    if (name.ends_with(ending)) name.remove_suffix(ending.size());
  }
  std::vector<std::string_view> meant;
  for (const std::string_view id : known) {
    if (name == id || name.ends_with("/" + std::string(id))) return {id};
    if (id.starts_with(std::string(name) + "/") || last_part(id) == name) meant.push_back(id);
  }
  return meant;
}

std::optional<fs::path> file_of_id(const fs::path& folder, const std::string& id) {
  if (!is_scenario_id(id)) return std::nullopt;
  for (const std::string_view ending :
       {std::string_view(".json"), kBlueprintEnding, kFormerBlueprintEnding}) {
    fs::path file = folder / (id + std::string(ending));
    std::error_code error;
    if (fs::is_regular_file(file, error)) return file;
  }
  return std::nullopt;
}

std::string listed(std::span<const std::string_view> ids) {
  constexpr std::size_t kMaxNamed = 50;
  return fmt::format("one of: {}{}", fmt::join(ids.first(std::min(ids.size(), kMaxNamed)), ", "),
                     ids.size() > kMaxNamed ? " and others" : "");
}

}  // namespace

fs::path scenarios_folder() {
  return resource_folder("THRONG_SCENARIOS", "scenarios", "scenarios");
}

std::vector<std::string> list_scenarios(const fs::path& folder) {
  std::vector<std::string> ids;
  for (NamedFile& file : json_files(folder)) {
    if (!is_scenario_id(file.id)) continue;
    if (classify(folder / file.name) != Content::something_else) {
      ids.push_back(std::move(file.id));
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());  // made from a blueprint beside it
  return ids;
}

std::optional<Problem> find_name_problem(const fs::path& name) {
  const std::string id = (name.parent_path() / id_from_file(name)).generic_string();
  if (is_scenario_id(id)) return std::nullopt;
  return Problem{name.generic_string(), "", name_found(id),
                 fmt::format("small letters, digits and '_', such as \"{}\": no job can name it",
                             similar_id(id))};
}

std::vector<Problem> list_unnamed_scenarios(const fs::path& folder) {
  std::vector<Problem> problems;
  for (const NamedFile& file : json_files(folder)) {
    std::optional<Problem> problem = find_name_problem(file.name);
    if (problem && classify(folder / file.name) == Content::scenario) {
      problems.push_back(*std::move(problem));
    }
  }
  return problems;
}

bool is_blueprint_name(std::string_view file) {
  return file.ends_with(kBlueprintEnding) || file.ends_with(kFormerBlueprintEnding);
}

std::string id_from_file(const fs::path& file) {
  const fs::path stem = file.stem();  // without ".json"
  return is_blueprint_name(file.filename().string()) ? stem.stem().string() : stem.string();
}

bool has_scenario(const fs::path& folder, const std::string& id) {
  return file_of_id(folder, id).has_value();
}

fs::path scenario_file(const fs::path& folder, const std::string& id) {
  if (auto file = file_of_id(folder, id)) return *std::move(file);
  const std::vector<std::string> ids = list_scenarios(folder);
  const std::vector<std::string_view> known(ids.begin(), ids.end());
  Problem problem = unknown_name("", "", "scenario", id, known);
  const std::vector<std::string_view> meant = meant_by(id, known);
  const std::vector<Problem> unnamed = list_unnamed_scenarios(folder);
  const auto named = std::find_if(unnamed.begin(), unnamed.end(), [&](const Problem& one) {
    return one.source == id || one.found == name_found(id);
  });
  if (named != unnamed.end()) {
    problem.found = fmt::format("the file {}", named->source);
    problem.expected = fmt::format("a name of {}", named->expected);
  } else if (meant.size() == 1) {
    problem.expected = fmt::format("\"{}\"", meant.front());
  } else if (!meant.empty()) {
    problem.expected = listed(meant);
  } else if (!closest(id, known)) {
    problem.expected = fmt::format(
        "{} (folder {}; the environment variable THRONG_SCENARIOS sets it)",
        known.empty() ? "a folder with files of scenarios" : listed(known), folder.string());
    if (!unnamed.empty()) {
      problem.expected += fmt::format("; {} is left out, whose name is not of {}",
                                      unnamed.front().source, unnamed.front().expected);
    }
  }
  throw InputError(std::move(problem));
}

std::optional<std::string> scenario_id_in(const fs::path& folder, const std::string& path) {
  const std::vector<std::string> ids = list_scenarios(folder);
  const std::vector<std::string_view> known(ids.begin(), ids.end());
  const std::vector<std::string_view> meant = meant_by(path, known);
  return meant.size() == 1 ? std::optional<std::string>(meant.front()) : std::nullopt;
}

}  // namespace throng::world
