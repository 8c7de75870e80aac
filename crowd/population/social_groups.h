// Social groups: people who walk together.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "crowd/state/behavior.h"

namespace throng::crowd {

/// Attributes of <SocialGroups> in a scene.
struct SocialGroupsSpec {
  double share = 0.6;               ///< share of people who walk in groups
  std::array<double, 3> weights{};  ///< relative frequencies of groups of two, three and four
  float gaze = 4;                   ///< beta_1 of Moussaid et al. 2010, 1/s per radian
  float cohesion = 3;               ///< beta_2, m/s^2
  float spacing = 1;                ///< beta_3, m/s^2
};

AttributeTable social_groups_attributes();

/// Throws InputError.
SocialGroupsSpec load_social_groups(const Element& element);

/// Forms groups of near neighbors with the same initial state from a share of the agents first,
/// ..., first + count - 1. Each group walks at the speed of its slowest member. Samples depend only
/// on the seed and the ids.
void form_social_groups(const SocialGroupsSpec& spec, std::size_t first, std::size_t count,
                        std::uint64_t seed, Crowd& crowd);

/// Forms groups among the agents first, first + 1, ... with these times of arrival: successive
/// agents form a group and arrive together.
void form_arriving_groups(const SocialGroupsSpec& spec, std::size_t first,
                          std::vector<double>& arrival_s, std::uint64_t seed, Crowd& crowd);

/// Creates the modifier that keeps members of a group together and abreast: forces of Moussaïd,
/// Perozo, Garnier, Helbing, Theraulaz (2010, PLoS ONE 5(4), e10047, equations 3 to 5) change the
/// preferred velocities, so it works with all pedestrian models.
std::unique_ptr<VelModifier> make_social_group_modifier(const SocialGroupsSpec& spec);

}  // namespace throng::crowd
