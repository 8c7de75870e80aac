// States in which people lie on the ground, from the behavior's description to the trace.
#include <gtest/gtest.h>

#include "crowd/description/builder.h"
#include "crowd/simulation.h"
#include "sim/people/crowd_trace.h"

namespace throng::sim {
namespace {

using crowd::Node;
namespace describe = crowd::describe;

/// One person who stands in a state of this name and with these further attributes.
crowd::Simulation person_in(const std::string& name, std::vector<crowd::Attribute> more) {
  crowd::SceneBuilder scene;
  scene.add_profile({.name = "adult", .common = {{"r", 0.2}, {"max_speed", 2}}});
  scene.add_group({.profile = "adult", .state = name, .generator = describe::agents_at({{0, 0}})});
  std::vector<crowd::Attribute> attributes = {{"name", name}, {"final", true}};
  attributes.insert(attributes.end(), more.begin(), more.end());
  crowd::BehaviorBuilder behavior;
  behavior.add(Node("State", std::move(attributes)));
  return crowd::Simulation(scene.build(), behavior.build(), {.seed = 1});
}

bool lies(const crowd::Simulation& crowd) {
  const bool by_state = crowd_header(crowd, 1).lying_states().at(0);
  EXPECT_EQ(by_state, (crowd_step(crowd).flags.at(0) & world::kFallen) != 0);
  return by_state;
}

TEST(LyingStates, AreThoseThatSaySo) {
  EXPECT_TRUE(lies(person_in("Nap", {{"lying", true}})));
  EXPECT_FALSE(lies(person_in("Nap", {{"lying", false}})));
  EXPECT_FALSE(lies(person_in("Dead_end", {{"lying", false}}))) << "in spite of its name";
}

TEST(LyingStates, FollowFromTheNameWhereNothingIsSaid) {
  EXPECT_TRUE(lies(person_in("Casualty", {})));
  EXPECT_FALSE(lies(person_in("Nap", {})));
}

}  // namespace
}  // namespace throng::sim
