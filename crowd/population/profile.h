// Agent profiles: the common properties of a kind of agent and their distributions.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "crowd/agents/agents.h"
#include "crowd/elements/attributes.h"
#include "crowd/elements/distribution.h"
#include "crowd/elements/element.h"
#include "crowd/elements/menge_sequences.h"
#include "crowd/state/model.h"

namespace throng::crowd {

/// The distribution of an agent's property or parameter.
struct ProfileValue {
  Distribution distribution;
  std::shared_ptr<MengeRandom> sequence;  ///< Menge's sequence in compatible runs, else null
};

/// An <AgentProfile>.
struct Profile {
  std::string name;
  std::array<ProfileValue, kPropertyCount> properties;  ///< in the units of the file
  std::vector<ProfileValue> model_parameters;           ///< in the order of the model's table
  std::uint32_t obstacle_mask = std::numeric_limits<std::uint32_t>::max();
  std::int32_t agent_class = 0;
  /// The profile's <VelModifier>s, which are created with the behavior.
  std::vector<Element> modifiers;
};

/// Reads an <AgentProfile>; `earlier` are the profiles from which it may inherit. Throws
/// InputError.
Profile load_profile(const Element& element, const std::vector<Profile>& earlier,
                     const ModelEntry& model, MengeSequences& sequences);

/// Sets the properties of an agent to samples of its profile, with the run's seed.
void apply_profile(const Profile& profile, std::uint64_t seed, std::size_t agent, Agents& agents);

/// Returns the attributes of <Common> that a <Property> cannot set.
AttributeTable fixed_common_attributes();

/// Whether a name is the element of some pedestrian model; a scene may contain those of unused
/// models.
bool is_model_tag(std::string_view name);

}  // namespace throng::crowd
