// Sources: agents who come while the simulation runs.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "crowd/elements/registry.h"
#include "crowd/process.h"

namespace throng::crowd {

/// When a group's agents come, in order.
struct ArrivalTimes {
  std::vector<double> time_s;
};

struct ArrivalContext {
  std::uint64_t seed = 1;
  std::size_t first_agent = 0;
};
using ArrivalRegistry = Registry<ArrivalTimes, ArrivalContext>;
/// rate, table.
const ArrivalRegistry& arrival_registry();

/// The agents first, first + 1, ... of a group with an <Arrivals> element.
struct ArrivalPlan {
  std::size_t first = 0;
  std::vector<double> time_s;           ///< one per agent
  std::vector<Eigen::Vector2f> places;  ///< where they may appear, m
  std::size_t max_alive = 0;            ///< nobody comes while as many agents are present
  double closed_from_s = 0;             ///< agents that have not arrived by then never do
};

/// Reads an <Arrivals>; the places come from the group's generators. Throws InputError.
ArrivalPlan load_arrivals(const Element& element, std::vector<Eigen::Vector2f> places,
                          std::size_t first_agent, std::uint64_t seed);

/// Lets the agents in, each at its time or as soon after it as there is room: a place where it
/// touches nobody, and fewer agents present than allowed. Marks them as awaited at once.
std::unique_ptr<Process> make_arrivals(ArrivalPlan plan, Crowd& crowd);

}  // namespace throng::crowd
