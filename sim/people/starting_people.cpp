#include "sim/people/starting_people.h"

#include "sim/people/participants.h"
#include "sim/run.h"

namespace throng::sim {

namespace {

// In a recording everybody is a person: the scenario's dangers are agents of its own crowd.
std::vector<world::AgentRole> roles_at_start(const world::Scenario& scenario, const RunSpec& spec,
                                             const CrowdSource& crowd,
                                             std::vector<Problem>& problems) {
  const std::size_t agents = crowd.positions().size();
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

}  // namespace

std::vector<Eigen::Vector2d> StartingPeople::places() const {
  std::vector<Eigen::Vector2d> places;
  const auto present = crowd->present();
  const auto positions = crowd->positions();
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] != world::AgentRole::person || present[i] == 0) continue;
    places.push_back(positions[i].cast<double>());
  }
  return places;
}

StartingPeople starting_people(const world::Scenario& scenario, const RunSpec& spec,
                               std::vector<Problem>& problems, bool can_step) {
  StartingPeople people;
  const auto load = can_step ? &load_crowd : &load_people;
  people.crowd = spec.recorded ? replayed(spec.recorded, spec.seed)
                               : simulated(load(scenario, spec.seed, spec.crowd));
  people.roles = roles_at_start(scenario, spec, *people.crowd, problems);
  for (std::size_t i = 0; i < people.roles.size(); ++i) {
    people.crowd->set_present(i, people.roles[i] != world::AgentRole::absent);
  }
  return people;
}

}  // namespace throng::sim
