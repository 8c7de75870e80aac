#include "crowd/project/vocabulary.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "crowd/agents/agents.h"
#include "crowd/behavior/closing_door.h"
#include "crowd/behavior/events.h"
#include "crowd/behavior/panic.h"
#include "crowd/motion/facing.h"
#include "crowd/navigation/elevation.h"
#include "crowd/navigation/obstacle_sets.h"
#include "crowd/population/agent_groups.h"
#include "crowd/population/arrivals.h"
#include "crowd/population/generators.h"
#include "crowd/population/profile.h"
#include "crowd/population/social_groups.h"
#include "crowd/project/project.h"
#include "crowd/scene.h"
#include "crowd/state/behavior.h"
#include "crowd/state/goals.h"
#include "crowd/state/model.h"

namespace throng::crowd {

namespace {

std::string attribute_name(const AttributeSpec& spec) {
  if (spec.type == AttributeType::distribution) return fmt::format("{}dist ...", spec.name);
  if (spec.type == AttributeType::distribution_2) return "dist ...";
  return std::string(spec.name);
}

std::string attribute_type(const AttributeSpec& spec) {
  switch (spec.type) {
    case AttributeType::number:
      return "number";
    case AttributeType::integer:
      return "integer";
    case AttributeType::boolean:
      return "0 or 1";
    case AttributeType::text:
      return spec.words.empty() ? "text" : fmt::format("one of {}", fmt::join(spec.words, ", "));
    case AttributeType::distribution:
      return "distribution";
    case AttributeType::distribution_2:
      return "distribution of points";
  }
  return {};
}

/// Limits that only keep numbers sane are not worth saying.
std::string describe_range(double min, double max) {
  if (min <= -kMaxCoordinate && max >= kMaxCoordinate) return {};
  if (max >= kMaxCoordinate) return fmt::format("at least {:g}", min);
  if (min <= -kMaxCoordinate) return fmt::format("at most {:g}", max);
  return fmt::format("{:g} to {:g}", min, max);
}

VocabularyAttribute described(const AttributeSpec& spec) {
  const bool has_range = spec.type == AttributeType::number ||
                         spec.type == AttributeType::integer ||
                         spec.type == AttributeType::distribution;
  return {.name = attribute_name(spec),
          .type = attribute_type(spec),
          .required = spec.presence == Presence::required,
          .default_text = std::string(spec.default_text),
          .range = has_range ? describe_range(spec.min, spec.max) : std::string(),
          .help = std::string(spec.help)};
}

VocabularyAttribute described(const ModelParameter& parameter) {
  return {.name = std::string(parameter.name),
          .type = "number",
          .default_text = fmt::format("{:g}", parameter.initial),
          .range = describe_range(parameter.min, parameter.max),
          .help = std::string(parameter.help)};
}

std::vector<VocabularyAttribute> described(const AttributeTable& table) {
  std::vector<VocabularyAttribute> all;
  all.reserve(table.size());
  for (const AttributeSpec& spec : table) all.push_back(described(spec));
  return all;
}

std::vector<VocabularyAttribute> described(const std::vector<ModelParameter>& table) {
  std::vector<VocabularyAttribute> all;
  all.reserve(table.size());
  for (const ModelParameter& parameter : table) all.push_back(described(parameter));
  return all;
}

template <typename Product, typename Context>
VocabularyKind of(const Registry<Product, Context>& registry, std::string title,
                  std::string element) {
  VocabularyKind kind{std::move(title), std::move(element), {}};
  for (const auto& entry : registry.entries()) {
    // The first attribute is the type itself.
    const AttributeTable rest(entry.attributes.begin() + 1, entry.attributes.end());
    kind.entries.push_back({std::string(entry.type), std::string(entry.help), described(rest)});
  }
  return kind;
}

/// An element of which there is one type.
VocabularyKind one(const std::string& name, std::string element, std::string help,
                   const AttributeTable& attributes) {
  return {name, std::move(element), {{name, std::move(help), described(attributes)}}};
}

VocabularyKind pedestrian_models() {
  VocabularyKind kind{"Pedestrian models", "`model` of a project, or `--model`", {}};
  for (const ModelEntry& model : models()) {
    kind.entries.push_back({std::string(model.name), std::string(model.help), {}});
  }
  return kind;
}

VocabularyKind model_constants() {
  VocabularyKind kind{"Models in a scene", "an element of <Experiment>, for all agents", {}};
  for (const ModelEntry& model : models()) {
    if (model.constants.empty()) continue;
    kind.entries.push_back({std::string(model.tag), fmt::format("the model {}", model.name),
                            described(model.constants)});
  }
  return kind;
}

VocabularyKind model_parameters() {
  VocabularyKind kind{
      "Models in a profile",
      "an element of <AgentProfile>; each attribute may be a <Property name dist ...> instead",
      {}};
  for (const ModelEntry& model : models()) {
    if (model.parameters.empty()) continue;
    kind.entries.push_back({std::string(model.tag), fmt::format("the model {}", model.name),
                            described(model.parameters)});
  }
  return kind;
}

VocabularyKind distributions() {
  VocabularyKind kind{
      "Distributions",
      "the value of an attribute `dist`, whose name may have something before it, as then have the "
      "others: `displace_dist`, `displace_mean`; all but c, u and n are not Menge's",
      {}};
  for (const DistributionForm& form : distribution_forms()) {
    VocabularyEntry entry{std::string(form.word), std::string(form.help), {}};
    for (const DistributionForm::Parameter& parameter : form.parameters) {
      entry.attributes.push_back({.name = std::string(parameter.name),
                                  .type = "number",
                                  .required = true,
                                  .range = parameter.is_a_value
                                               ? std::string()
                                               : describe_range(parameter.min, parameter.max),
                                  .help = std::string(parameter.help)});
    }
    if (form.has_limits) {
      entry.attributes.push_back(
          {.name = "at_least", .type = "number", .help = "lower values are not sampled"});
      entry.attributes.push_back(
          {.name = "at_most", .type = "number", .help = "higher values are not sampled"});
    }
    entry.attributes.push_back({.name = "seed",
                                .type = "integer",
                                .help = "fixes the samples regardless of the run's seed"});
    kind.entries.push_back(std::move(entry));
  }
  return kind;
}

VocabularyKind properties() {
  VocabularyEntry common{"Common", "what all models know of an agent", {}};
  for (const PropertySpec& spec : kProperties) {
    common.attributes.push_back({.name = std::string(spec.name),
                                 .type = "number",
                                 .default_text = fmt::format("{:g}", spec.initial),
                                 .range = describe_range(spec.min, spec.max),
                                 .help = std::string(spec.help)});
  }
  for (const VocabularyAttribute& attribute : described(fixed_common_attributes())) {
    common.attributes.push_back(attribute);
  }
  return {"Agents' properties",
          "an element of <AgentProfile>; each attribute but the last two may be a <Property name "
          "dist ...> instead",
          {std::move(common)}};
}

}  // namespace

std::vector<VocabularyKind> vocabulary() {
  std::vector<VocabularyKind> all = {
      one("Project", "the root of a project file", "what is run, and for how long",
          project_attributes()),
      pedestrian_models(),
      model_constants(),
      one("SpatialQuery", "an element of <Experiment>", "who sees whom",
          spatial_query_attributes()),
      of(elevation_registry(), "Elevations", "<Elevation> in <Experiment>"),
      of(obstacle_set_registry(), "Obstacle sets", "<ObstacleSet> in <Experiment>"),
      one("SocialGroups", "an element of <Experiment>", "pairs and small groups who walk together",
          social_groups_attributes()),
      properties(),
      model_parameters(),
      of(profile_selector_registry(), "Profile selectors", "<ProfileSelector> in <AgentGroup>"),
      of(state_selector_registry(), "State selectors",
         "<StateSelector> in <AgentGroup> or <Effect>"),
      of(generator_registry(), "Generators", "<Generator> in <AgentGroup>"),
      of(facing_registry(), "Facing",
         "<Facing> in <AgentGroup>: of those who stand when they begin"),
      of(arrival_registry(), "Arrivals", "<Arrivals> in <AgentGroup>"),
      of(goal_registry(), "Goals", "<Goal> in <GoalSet>"),
      of(goal_selector_registry(), "Goal selectors", "<GoalSelector> in <State>"),
      of(vel_component_registry(), "Velocity components", "<VelComponent> in <State>"),
      of(vel_modifier_registry(), "Velocity modifiers",
         "<VelModifier> in <State>, <BFSM> or <AgentProfile>"),
      of(action_registry(), "Actions", "<Action> in <State>"),
      of(condition_registry(), "Conditions", "<Condition> in <Transition>"),
      of(target_registry(), "Targets", "<Target> in <Transition>"),
      one("ClosingDoor", "an element of <BFSM>", "a door that nobody passes from a time on",
          closing_door_attributes()),
      one("Panic", "an element of <BFSM>", "how panic spreads and what it does",
          panic_attributes()),
      of(task_registry(), "Tasks", "<Task> in <BFSM>"),
      of(event_trigger_registry(), "Triggers", "<Trigger> in <Event>"),
      of(event_target_registry(), "Targets of events", "<Target> in <EventSystem>"),
      of(event_effect_registry(), "Effects of events", "<Effect> in <EventSystem>"),
      distributions(),
  };
  std::erase_if(all, [](const VocabularyKind& kind) { return kind.entries.empty(); });
  return all;
}

}  // namespace throng::crowd
