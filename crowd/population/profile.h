// Agent profiles: what the agents of a kind have in common, and how they vary.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "crowd/agents.h"
#include "crowd/elements/attributes.h"
#include "crowd/elements/distribution.h"
#include "crowd/elements/element.h"
#include "crowd/elements/menge_random.h"
#include "crowd/model.h"

namespace throng::crowd {

/// The distribution of an agent's property or parameter.
struct ProfileValue {
  Distribution distribution;
  std::shared_ptr<MengeRandom> sequence;  ///< where compatible runs draw from it
};

struct Profile {
  std::string name;
  std::array<ProfileValue, kPropertyCount> properties;  ///< in the files' units
  std::vector<ProfileValue> model_parameters;           ///< in the order of the model's table
  std::uint32_t obstacle_mask = std::numeric_limits<std::uint32_t>::max();
  std::int32_t agent_class = 0;
  std::vector<Element> modifiers;  ///< its <VelModifier>s, which need the behavior to be made
};

/// Reads an <AgentProfile>; `earlier` are those that it may inherit from. Throws InputError.
Profile load_profile(const Element& element, const std::vector<Profile>& earlier,
                     const ModelEntry& model, MengeSequences& sequences);

/// Sets the properties of agent `agent` from its profile, sampled with the run's seed.
void apply_profile(const Profile& profile, std::uint64_t seed, std::size_t agent, Agents& agents);

/// Those of <Common> that a <Property> cannot give.
AttributeTable fixed_common_attributes();

/// The elements that carry other models' parameters, which a scene may always hold.
bool is_model_tag(std::string_view name);

}  // namespace throng::crowd
