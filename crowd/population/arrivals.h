// Arrivals: agents that enter during the simulation.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "crowd/elements/registry.h"
#include "crowd/state/process.h"

namespace throng::crowd {

/// Times at which the agents of a group arrive, ascending.
struct ArrivalTimes {
  std::vector<double> time_s;
};

/// Inputs of the factories of ArrivalTimes.
struct ArrivalContext {
  std::uint64_t seed = 1;
  std::size_t first_agent = 0;
};
using ArrivalRegistry = Registry<ArrivalTimes, ArrivalContext>;
/// Types: rate, table.
const ArrivalRegistry& arrival_registry();

/// The arrivals of the agents first, first + 1, ... of a group with an <Arrivals> element.
struct ArrivalPlan {
  std::size_t first = 0;
  std::vector<double> time_s;           ///< one per agent
  std::vector<Eigen::Vector2f> places;  ///< possible positions, m
  std::size_t max_alive = 0;            ///< nobody arrives while this number of agents is present
  double closed_from_s = 0;             ///< agents that have not arrived by then never do
  bool come_in_groups = true;           ///< whether social groups arrive together
};

/// Reads an <Arrivals> element; `places` are the positions of the group's generators. Throws
/// InputError.
ArrivalPlan load_arrivals(const Element& element, std::vector<Eigen::Vector2f> places,
                          std::size_t first_agent, std::uint64_t seed);

/// Creates the process that lets agents arrive, each at its time or as soon afterwards as there is
/// a position where it touches nobody and fewer agents than allowed are present. Marks them as
/// awaited immediately.
std::unique_ptr<Process> make_arrivals(ArrivalPlan plan, Crowd& crowd);

}  // namespace throng::crowd
