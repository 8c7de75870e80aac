#include "sim/people/participants.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/compute/random.h"

namespace throng::sim {

using world::AgentRole;

std::vector<AgentRole> choose_roles(const std::string& scenario,
                                    std::span<const int> disaster_agents, std::size_t agents,
                                    std::optional<int> people, std::uint64_t seed,
                                    std::vector<Problem>& problems) {
  std::vector<AgentRole> roles(agents, AgentRole::person);
  for (std::size_t i = 0; i < disaster_agents.size(); ++i) {
    const auto agent = static_cast<std::size_t>(disaster_agents[i]);
    if (agent < agents) {
      roles[agent] = AgentRole::disaster;
    } else {
      problems.push_back({scenario, fmt::format("/disaster_agents/{}", i), std::to_string(agent),
                          fmt::format("an agent of the scene, which has {}", agents)});
    }
  }

  using Ticket = std::pair<std::uint32_t, std::size_t>;  // what was sampled, and for which agent
  std::vector<Ticket> tickets;
  for (std::size_t i = 0; i < agents; ++i) {
    if (roles[i] == AgentRole::person) {
      tickets.push_back({Random(seed, Stream::participants, i).bits(), i});
    }
  }
  if (!people) return roles;
  if (*people < 0 || static_cast<std::size_t>(*people) > tickets.size()) {
    problems.push_back(
        {"", "/crowd/agents", std::to_string(*people),
         fmt::format("1 to {}, all who are in the scenario at the start or come later",
                     tickets.size())});
    return roles;
  }
  std::sort(tickets.begin(), tickets.end());
  for (std::size_t i = static_cast<std::size_t>(*people); i < tickets.size(); ++i) {
    roles[tickets[i].second] = AgentRole::absent;
  }
  return roles;
}

}  // namespace throng::sim
