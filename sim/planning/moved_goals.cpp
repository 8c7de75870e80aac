#include "sim/planning/moved_goals.h"

#include <fmt/core.h>

#include <algorithm>

namespace throng::sim {

bool has_own_goal(const DroneMission& mission, const world::Scenario& scenario) {
  return mission.moves_goal && std::none_of(scenario.drones.begin(), scenario.drones.end(),
                                            [&](const world::DroneStart& known) {
                                              return known.id == mission.id &&
                                                     known.moves_goal == mission.moves_goal;
                                            });
}

Problem unknown_goal(std::size_t drone, const world::GoalRef& goal,
                     const world::Scenario& scenario) {
  return {"", fmt::format("/drones/{}/moves_goal", drone),
          fmt::format("[{}, {}]", goal.set, goal.goal),
          scenario.built_crowd ? "none: people of a blueprint follow the drones that it names"
                               : "a goal set and goal of the scenario's behavior file"};
}

void check_moved_goals(const std::vector<DroneMission>& missions, const world::Scenario& scenario,
                       const crowd::Simulation& crowd, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < missions.size(); ++i) {
    const auto& goal = missions[i].moves_goal;
    if (goal && !crowd.has_goal(goal->set, goal->goal)) {
      problems.push_back(unknown_goal(i, *goal, scenario));
    }
  }
}

}  // namespace throng::sim
