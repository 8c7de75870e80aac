#include "crowd/project/project.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "crowd/description/menge_files/read.h"
#include "crowd/elements/element.h"
#include "crowd/elements/named_file.h"
#include "crowd/state/model.h"

namespace throng::crowd {

namespace fs = std::filesystem;

namespace {

constexpr double kMaxSeed = std::numeric_limits<std::uint32_t>::max();
constexpr double kMaxRunS = 1e7;

template <std::size_t N>
std::size_t word_index(std::string_view word, const std::array<std::string_view, N>& words,
                       const char* what) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) {
    throw InputError(Problem{"", what, in_quotes(word) + did_you_mean(word, words),
                             fmt::format("one of {}", fmt::join(words, ", "))});
  }
  return static_cast<std::size_t>(found - words.begin());
}

template <std::size_t N>
std::vector<std::string_view> listed(const std::array<std::string_view, N>& words) {
  return {words.begin(), words.end()};
}

/// A file that an attribute names, which has to be there; otherwise adds a problem.
fs::path find_file(const Element& element, const Attributes& attributes, const char* name,
                   std::vector<Problem>& problems) {
  if (!attributes.has(name)) return {};
  fs::path path = element.file_beside(attributes.text(name));
  if (!is_file(path)) {
    problems.push_back(
        element.attribute_problem(name, in_quotes(attributes.text(name)) + ", which is no file",
                                  describe_missing_file(path)));
  }
  return path;
}

std::uint64_t read_seed(const Element& element, const Attributes& attributes) {
  const auto given = static_cast<std::uint64_t>(attributes.integer("random"));
  if (given == 0 && element.attribute("random")) {
    element.warn_attribute("random", "0, which makes every run of Menge another one; here it is 1",
                           "a seed above 0");
  }
  return seed_or_default(given);
}

std::string read_model(const Element& element, const Attributes& attributes) {
  const std::string& name = attributes.text("model");
  try {
    return std::string(find_model(name).name);
  } catch (const InputError& error) {
    element.fail_attribute("model", error.problems().front().found,
                           error.problems().front().expected);
  }
}

std::optional<double> read_time_step(const Element& element, const Attributes& attributes) {
  constexpr double kMinStepS = 1e-4;
  const double time_step_s = attributes.number("timeStep");
  if (time_step_s <= 0) return std::nullopt;
  if (time_step_s < kMinStepS) {
    element.fail_attribute("timeStep", fmt::format("{} s", time_step_s),
                           fmt::format("at least {} s", kMinStepS));
  }
  return time_step_s;
}

void require_file(const fs::path& path, const char* what) {
  if (!is_file(path)) {
    throw InputError(Problem{
        path.string(), what, path.empty() ? "nothing" : "no file",
        path.empty() ? fmt::format("the {} file of a run", what)
                     : fmt::format("the {} file of a run: {}", what, describe_missing_file(path))});
  }
}

}  // namespace

Compat parse_compat(std::string_view word) {
  return static_cast<Compat>(word_index(word, kCompatWords, "compat"));
}

ConstantsChoice parse_constants(std::string_view word) {
  return static_cast<ConstantsChoice>(word_index(word, kConstantsWords, "constants"));
}

BodySeparation parse_separation(std::string_view separation) {
  return static_cast<BodySeparation>(word_index(separation, kSeparationWords, "separation"));
}

AttributeTable project_attributes() {
  return {
      optional(text("scene", "scene file")),
      optional(text("behavior", "behavior file")),
      optional(text("model", "pedestrian model"), "orca"),
      optional(number("duration", "longest time to simulate, in s", 0, kMaxRunS), "400"),
      optional(number("timeStep", "in s; not above 0: as the scene says", -kMaxCoordinate, 10),
               "-1"),
      optional(integer("subSteps", "steps in between that are not recorded", 0, 1000), "0"),
      optional(integer("random", "seed; 0 is taken for 1", 0, kMaxSeed), "0"),
      optional(word("compat", listed(kCompatWords), "whose results are wanted"), "none"),
      optional(word("separation", listed(kSeparationWords),
                    "hard: bodies overlap by no more than 1 cm; auto: hard with ttc, else soft"),
               "auto"),
      optional(text("output", "trajectory file to write: .scb or .h5")),
      optional(word("scbVersion", listed(kScbVersions), "of an .scb file"), "2.1"),
      optional(text("view", "camera and lights of Menge's viewer; not used")),
      optional(text("dumpPath", "folder of Menge's screenshots; not used")),
  };
}

Project load_project(const fs::path& file) {
  require_file(file, "project");
  const Description description = read_description(file, "Project");
  Reading xml(description, "Project");
  const Element element = xml.root();
  const Attributes attributes(element, project_attributes());
  for (const Element& child : element.children()) child.warn("an element", "none in a project");
  Project project;
  std::vector<Problem> missing;
  project.scene_file = find_file(element, attributes, "scene", missing);
  project.behavior_file = find_file(element, attributes, "behavior", missing);
  if (!missing.empty()) throw InputError(std::move(missing));
  project.options.model = read_model(element, attributes);
  project.options.seed = read_seed(element, attributes);
  project.options.compat = parse_compat(attributes.text("compat"));
  project.options.separation = parse_separation(attributes.text("separation"));
  project.options.sub_steps = static_cast<int>(attributes.integer("subSteps"));
  project.options.time_step_s = read_time_step(element, attributes);
  project.duration_s = attributes.number("duration");
  if (attributes.has("output")) project.output = element.file_beside(attributes.text("output"));
  project.scb_version = attributes.text("scbVersion");
  project.warnings = xml.warnings();
  return project;
}

Simulation load_simulation(const Project& project) {
  require_file(project.scene_file, "scene");
  require_file(project.behavior_file, "behavior");
  return {project.scene_file, project.behavior_file, project.options};
}

}  // namespace throng::crowd
