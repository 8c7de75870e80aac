#include "sim/people/starting_people.h"

#include <utility>

#include "sim/people/load_people.h"
#include "sim/people/participants.h"
#include "sim/people/spectators.h"

namespace throng::sim {

// In a recording everybody is a person: the scenario's dangers are agents of its own crowd.
std::vector<world::AgentRole> starting_roles(const world::Scenario& scenario, const RunSpec& spec,
                                             std::size_t agents, std::vector<Problem>& problems) {
  const std::vector<int> none;
  std::vector<world::AgentRole> roles =
      choose_roles(scenario.id, spec.recorded ? none : scenario.disaster_agents, agents,
                   spec.people, spec.seed, problems);
  for (const world::Disaster& disaster : scenario.disasters) {
    const auto agent = static_cast<std::size_t>(disaster.agent);
    if (disaster.kind != world::DisasterKind::attacker || spec.recorded || agent >= agents)
      continue;
    roles[agent] = world::AgentRole::attacker;
  }
  return roles;
}

std::vector<Eigen::Vector2d> places_of_persons(const std::vector<world::AgentRole>& roles,
                                               std::span<const Eigen::Vector2f> positions,
                                               std::span<const std::uint8_t> present) {
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] != world::AgentRole::person || present[i] == 0) continue;
    places.push_back(positions[i].cast<double>());
  }
  return places;
}

StartingPeople starting_people(const world::Scenario& scenario, const RunSpec& spec,
                               std::vector<Problem>& problems,
                               std::optional<crowd::Simulation> people) {
  StartingPeople starting;
  if (spec.recorded) {
    starting.crowd = replayed(spec.recorded, spec.seed);
  } else {
    if (!people) people = load_people(scenario, spec.seed, spec.crowd);
    people->prepare_to_step();
    starting.crowd = simulated(*std::move(people));
  }
  starting.roles = starting_roles(scenario, spec, starting.crowd->positions().size(), problems);
  starting.crowd = with_spectators(std::move(starting.crowd), scenario, spec.seed, problems);
  for (std::size_t i = 0; i < starting.roles.size(); ++i) {
    starting.crowd->set_present(i, starting.roles[i] != world::AgentRole::absent);
  }
  starting.roles.resize(starting.crowd->positions().size(), world::AgentRole::spectator);
  return starting;
}

}  // namespace throng::sim
