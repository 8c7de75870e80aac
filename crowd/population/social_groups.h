// Pairs and small groups who walk together.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "crowd/behavior.h"

namespace throng::crowd {

/// Attributes of <SocialGroups> in a scene.
struct SocialGroupsSpec {
  double share = 0.6;               ///< of the people who walk in groups
  std::array<double, 3> weights{};  ///< of groups of two, three and four
  float gaze = 4;                   ///< beta_1 of Moussaid et al. 2010, 1/s per radian
  float cohesion = 3;               ///< beta_2, m/s^2
  float spacing = 1;                ///< beta_3, m/s^2
};

AttributeTable social_groups_attributes();

/// Throws InputError.
SocialGroupsSpec load_social_groups(const Element& element);

/// Puts `share` of the agents first, ..., first + count - 1 into groups of near neighbors with
/// one start state, and has each group walk as fast as its slowest member would. The samples
/// depend on the seed and the ids only.
void form_social_groups(const SocialGroupsSpec& spec, std::size_t first, std::size_t count,
                        std::uint64_t seed, Crowd& crowd);

/// The same for agents first, first + 1, ... who arrive at these times: those who come one after
/// the other form groups, and come together.
void form_arriving_groups(const SocialGroupsSpec& spec, std::size_t first,
                          std::vector<double>& arrival_s, std::uint64_t seed, Crowd& crowd);

/// Makes members of a group stay together and walk abreast: the group's forces (Moussaid, Perozo,
/// Garnier, Helbing, Theraulaz 2010, PLoS ONE 5(4), e10047, equations 3 to 5) act on where each
/// would go by itself, so they go with any pedestrian model.
std::unique_ptr<VelModifier> make_social_group_modifier(const SocialGroupsSpec& spec);

}  // namespace throng::crowd
