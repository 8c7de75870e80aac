// People who sit on benches and at tables of a scenario for a whole run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "world/scenario.h"

namespace throng::world {

struct Sitters {
  double share = 0;  ///< of the seats, 0 to 1
  std::uint64_t seed = 0;
};

/// The seats of all props, each as somebody who sits there, by prop and then by the kind's table:
/// those whose middle and legs are clear of buildings and of other props.
std::vector<Sitter> free_seats(const Scenario& scenario);

/// Seats people (Scenario::sitters) on the share of the free seats, rounded, of a scenario whose
/// props are complete: by the seed, and rather beside each other than alone. The people of a
/// smaller share sit there at a larger one, too.
void seat_people(const Sitters& sitters, Scenario& scenario);

}  // namespace throng::world
