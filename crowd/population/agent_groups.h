// Groups of agents in a scene: start positions, profiles and initial states.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "crowd/elements/menge_sequences.h"
#include "crowd/elements/registry.h"
#include "crowd/population/profile.h"
#include "crowd/population/social_groups.h"
#include "crowd/state/crowd.h"
#include "crowd/state/process.h"

namespace throng::crowd {

/// Objects to which the elements of a group refer.
struct GroupContext {
  const std::vector<Profile>& profiles;
  const std::vector<std::string>& state_names;
  std::uint64_t seed = 1;
  MengeSequences& sequences;
  std::optional<SocialGroupsSpec> social_groups;
};

/// Selects the profile of each agent of a group.
class ProfileSelector {
 public:
  virtual ~ProfileSelector() = default;
  /// Returns an index into GroupContext::profiles. Called once per agent, in the order of ids.
  virtual std::size_t select(std::size_t agent) = 0;
};

/// Selects the initial state of each agent of a group.
class StateSelector {
 public:
  virtual ~StateSelector() = default;
  virtual std::uint8_t select(std::size_t agent) = 0;
};

using ProfileSelectorRegistry = Registry<ProfileSelector, GroupContext>;
using StateSelectorRegistry = Registry<StateSelector, GroupContext>;
/// Types: const, random, weighted.
const ProfileSelectorRegistry& profile_selector_registry();
/// Type: const.
const StateSelectorRegistry& state_selector_registry();

/// Adds the agents of an <AgentGroup> to the crowd and the process of its <Arrivals>, if any, to
/// `processes`. Throws InputError.
void load_group(const Element& group, GroupContext& context, Crowd& crowd,
                std::vector<std::unique_ptr<Process>>& processes);

}  // namespace throng::crowd
