// The neighbors and walls that each agent perceives: the input of pedestrian models.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "base/compute/parallel.h"
#include "crowd/spatial/grid.h"
#include "crowd/spatial/menge_tree.h"
#include "crowd/state/crowd.h"

namespace throng::crowd {

/// The surroundings of one agent.
struct AgentView {
  std::size_t agent = 0;                      ///< id of the agent
  std::size_t slot = 0;                       ///< slot in the grid
  std::span<const Grid::Neighbor> neighbors;  ///< nearest first, at most max_neighbors
  std::span<const Obstacles::Near> walls;     ///< nearest first
};

/// Finds the surroundings of agents; allocates memory only in the first steps.
class Neighborhood {
 public:
  explicit Neighborhood(const Crowd& crowd);

  /// Calls act(view) once for each agent in the grid, on all threads. `wall_range_m(slot)` is the
  /// max distance of walls that matter.
  template <typename Range, typename Act>
  void for_each(const Crowd& crowd, const Grid& grid, const Range& wall_range_m, const Act& act) {
    prepare(crowd, grid);
    parallel_ranges(grid.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Found& found = found_.local();
      for (std::size_t slot = begin; slot < end; ++slot) {
        act(look(crowd, grid, slot, wall_range_m(slot), found));
      }
    });
  }

  /// Must be called before calls of look() in a loop, by the thread that starts the loop.
  void prepare(const Crowd& crowd, const Grid& grid) {
    found_.prepare();
    if (crowd.compat != Compat::none) tree_.build(grid, crowd.agents.count());
    if (reach_.size() < crowd.agents.count()) reach_.resize(crowd.agents.count(), kFirstReach);
  }
  /// Returns the view of one agent with the walls that are nearer than `wall_range_m` and than the
  /// agent's own range. Valid until this thread calls look() again.
  AgentView look(const Crowd& crowd, const Grid& grid, std::size_t slot,
                 float wall_range_m = std::numeric_limits<float>::infinity()) {
    return look(crowd, grid, slot, wall_range_m, found_.local());
  }

 private:
  static constexpr std::size_t kGrain = 64;  // agents per task
  static constexpr float kFirstReach = 2;    // m

  /// Buffers of one thread.
  struct Found {
    Grid::Candidates candidates;
    MengeTree::Search search;
    std::vector<Obstacles::Near> walls;
    std::vector<Grid::Neighbor> visible;
  };

  static Found make_found(const Crowd& crowd);
  AgentView look(const Crowd& crowd, const Grid& grid, std::size_t slot, float wall_range_m,
                 Found& found);
  std::span<const Grid::Neighbor> nearest(const Crowd& crowd, const Grid& grid, std::size_t slot,
                                          std::size_t max_neighbors, Found& found);
  std::span<const Grid::Neighbor> nearest_visible(const Crowd& crowd, const Grid& grid,
                                                  std::size_t slot, std::size_t max_neighbors,
                                                  Found& found);

  MengeTree tree_;            // for compatible runs
  std::vector<float> reach_;  // per agent, for Grid::nearest()
  PerThread<Found> found_;
};

}  // namespace throng::crowd
