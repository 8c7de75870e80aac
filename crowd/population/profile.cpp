#include "crowd/population/profile.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace throng::crowd {

namespace {

constexpr double kMaxMask = std::numeric_limits<std::uint32_t>::max();

/// Something that may be an attribute or a <Property> with a distribution.
struct Variable {
  std::string_view name;
  double min = 0;
  double max = 0;
  std::string_view help;
  std::string_view alias;  ///< another name for <Property>
  ProfileValue* value = nullptr;
};

AttributeTable variable_attributes(const std::vector<Variable>& variables) {
  AttributeTable table;
  for (const Variable& variable : variables) {
    table.push_back(optional(number(variable.name, variable.help, variable.min, variable.max)));
  }
  return table;
}

void load_property(const Element& element, const std::vector<Variable>& variables,
                   MengeSequences& sequences) {
  if (element.name() != "Property") element.fail_unknown("<Property>");
  element.require_no_children();
  const std::string name(element.attribute("name").value_or(""));
  const auto variable = std::find_if(variables.begin(), variables.end(), [&](const Variable& v) {
    return v.name == name || v.alias == name;
  });
  if (variable == variables.end() || name.empty()) {
    std::vector<std::string_view> names;
    names.reserve(variables.size());
    for (const Variable& v : variables) names.push_back(v.name);
    element.fail_attribute("name", name.empty() ? "nothing" : in_quotes(name),
                           fmt::format("one of {}", fmt::join(names, ", ")));
  }
  const Attributes attributes(
      element,
      {text("name", "a property"), distribution("", variable->help, variable->min, variable->max)});
  const Distribution& distribution = attributes.distribution("");
  *variable->value = {distribution, sequences.next(distribution)};
}

void load_variables(const Element& element, const Attributes& attributes,
                    const std::vector<Variable>& variables, MengeSequences& sequences) {
  for (const Variable& variable : variables) {
    if (attributes.has(variable.name)) {
      *variable.value = {Distribution::constant(attributes.number(variable.name)), nullptr};
    }
  }
  for (const Element& child : element.children()) load_property(child, variables, sequences);
}

void load_common(const Element& element, Profile& profile, MengeSequences& sequences) {
  std::vector<Variable> variables;
  for (std::size_t i = 0; i < kPropertyCount; ++i) {
    const PropertySpec& spec = kProperties[i];
    variables.push_back({spec.name, spec.min, spec.max, spec.help, "", &profile.properties[i]});
  }
  AttributeTable table = variable_attributes(variables);
  for (const AttributeSpec& spec : fixed_common_attributes()) table.push_back(spec);
  const Attributes attributes(element, table);
  if (attributes.has("obstacleSet")) {
    profile.obstacle_mask = static_cast<std::uint32_t>(attributes.integer("obstacleSet"));
  }
  if (attributes.has("class")) {
    profile.agent_class = static_cast<std::int32_t>(attributes.integer("class"));
  }
  load_variables(element, attributes, variables, sequences);
  const Distribution& neighbors =
      profile.properties[static_cast<std::size_t>(Property::max_neighbors)].distribution;
  const bool is_whole = neighbors.first == std::round(neighbors.first) &&
                        neighbors.second == std::round(neighbors.second);
  if (!is_whole && neighbors.kind <= Distribution::Kind::normal) {
    element.fail_attribute("max_neighbors", fmt::format("{}", neighbors.first), "a whole number");
  }
}

void load_model_parameters(const Element& element, const ModelEntry& model, Profile& profile,
                           MengeSequences& sequences) {
  std::vector<Variable> variables;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const ModelParameter& parameter = model.parameters[i];
    variables.push_back({parameter.name, parameter.min, parameter.max, parameter.help,
                         parameter.property_name, &profile.model_parameters[i]});
  }
  load_variables(element, Attributes(element, variable_attributes(variables)), variables,
                 sequences);
}

Profile initial_profile(const ModelEntry& model) {
  Profile profile;
  for (std::size_t i = 0; i < kPropertyCount; ++i) {
    profile.properties[i].distribution = Distribution::constant(kProperties[i].initial);
  }
  for (const ModelParameter& parameter : model.parameters) {
    profile.model_parameters.push_back({Distribution::constant(parameter.initial), nullptr});
  }
  return profile;
}

/// A profile's own sequences of random numbers, beside those of the one that it was copied from.
void copy_sequences(Profile& profile) {
  const auto renew = [](ProfileValue& value) {
    value.sequence = MengeSequences::copy(value.sequence);
  };
  std::for_each(profile.properties.begin(), profile.properties.end(), renew);
  std::for_each(profile.model_parameters.begin(), profile.model_parameters.end(), renew);
}

Profile inherited_profile(const Element& element, const Attributes& attributes,
                          const std::vector<Profile>& earlier, const ModelEntry& model) {
  if (!attributes.has("inherits")) return initial_profile(model);
  const std::string& parent = attributes.text("inherits");
  for (const Profile& profile : earlier) {
    if (profile.name != parent) continue;
    Profile heir = profile;
    copy_sequences(heir);
    return heir;
  }
  element.fail_attribute("inherits", in_quotes(parent), "the name of a profile further up");
}

/// The random numbers of an agent's variable, where runs are not compatible.
Random keyed(std::uint64_t seed, std::size_t agent, std::size_t variable,
             const Distribution& distribution) {
  constexpr int kVariableBits = 16;
  return Random(distribution.seed.value_or(seed), Stream::crowd_profile,
                (static_cast<std::uint64_t>(agent) << kVariableBits) | variable);
}

double sample(const ProfileValue& value, Random random) {
  return value.sequence ? value.distribution.sample(*value.sequence)
                        : value.distribution.sample(random);
}

int sample_integer(const ProfileValue& value, Random random) {
  return value.sequence ? value.distribution.sample_integer(*value.sequence)
                        : value.distribution.sample_integer(random);
}

}  // namespace

AttributeTable fixed_common_attributes() {
  return {
      optional(integer("obstacleSet", "bits of the obstacle classes that the agent avoids; all", 0,
                       kMaxMask)),
      optional(integer("class", "a number for reports and clear_AABB; 0", 0, kMaxId)),
  };
}

bool is_model_tag(std::string_view name) {
  static constexpr std::array<std::string_view, 10> kTags = {
      "ORCA",       "Weidmann", "PedVO", "Helbing", "Johansson",
      "Karamouzas", "Zanlungo", "GCF",   "Dummy",   "OpenSteer"};
  return std::find(kTags.begin(), kTags.end(), name) != kTags.end();
}

Profile load_profile(const Element& element, const std::vector<Profile>& earlier,
                     const ModelEntry& model, MengeSequences& sequences) {
  const Attributes attributes(element,
                              {text("name", "a name that no other profile has"),
                               optional(text("inherits", "the name of a profile further up"))});
  Profile profile = inherited_profile(element, attributes, earlier, model);
  profile.name = attributes.text("name");
  for (const Profile& other : earlier) {
    if (other.name == profile.name) {
      element.fail_attribute("name", in_quotes(profile.name) + " again", "a name of its own");
    }
  }
  for (const Element& child : element.children()) {
    if (child.name() == "Common") {
      load_common(child, profile, sequences);
    } else if (child.name() == model.tag) {
      load_model_parameters(child, model, profile, sequences);
    } else if (child.name() == "VelModifier") {
      child.require_no_children();
      profile.modifiers.push_back(child);
    } else if (!is_model_tag(child.name())) {
      child.fail_unknown("<Common>, <VelModifier> or a model's element");
    }
  }
  return profile;
}

void apply_profile(const Profile& profile, std::uint64_t seed, std::size_t agent, Agents& agents) {
  for (std::size_t i = 0; i < kPropertyCount; ++i) {
    const PropertySpec& spec = kProperties[i];
    const ProfileValue& property = profile.properties[i];
    const Random random = keyed(seed, agent, i, property.distribution);
    const double value = static_cast<Property>(i) == Property::max_neighbors
                             ? sample_integer(property, random)
                             : sample(property, random);
    agents.properties[i][agent] =
        std::clamp(static_cast<float>(value), spec.min, spec.max) * spec.file_unit;
  }
  for (std::size_t i = 0; i < profile.model_parameters.size(); ++i) {
    const ProfileValue& parameter = profile.model_parameters[i];
    const Random random = keyed(seed, agent, kPropertyCount + i, parameter.distribution);
    agents.model_parameters[i][agent] = static_cast<float>(sample(parameter, random));
  }
  agents.obstacle_mask[agent] = profile.obstacle_mask;
  agents.agent_class[agent] = profile.agent_class;
}

}  // namespace throng::crowd
