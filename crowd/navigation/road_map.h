// Road maps: graphs of way points from a file, and paths of agents along them.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <memory>
#include <vector>

#include "crowd/elements/text_file.h"
#include "crowd/navigation/steering.h"

namespace throng::crowd {

/// Way points and edges, which are walked in both directions.
struct RoadMap {
  struct Road {
    int to = 0;
    float length_m = 0;
  };

  std::vector<Eigen::Vector2f> vertices;  ///< positions of the way points, at least one
  std::vector<std::vector<Road>> roads;   ///< edges, indexed by way point
};

/// Reads Menge's format: way points with the number of their edges, then edges. Throws InputError
/// (file, line, found, expected), EnvironmentError if the file cannot be read.
RoadMap load_road_map(const TextFile& source);

/// Finds shortest paths between way points with A* (Hart, Nilsson and Raphael 1968). One object per
/// thread; it reuses its memory.
class RoadFinder {
 public:
  explicit RoadFinder(const RoadMap& map);
  /// Finds a path; returns false if there is none. `map` must be that of the constructor.
  bool find(const RoadMap& map, int from, int to);
  /// Way points of the path found last, from start to end.
  const std::vector<int>& vertices() const { return vertices_; }

 private:
  struct Node {
    unsigned search = 0;  // number of the last search that reached it
    bool done = false;
    int before = -1;
    float cost = 0;
  };
  struct Open {
    float estimate = 0;
    int vertex = 0;
  };

  std::vector<Node> nodes_;
  std::vector<Open> open_;  // heap
  std::vector<int> vertices_;
  unsigned search_ = 0;
};

/// The paths of all agents that use one map, in all states. An agent starts at the nearest visible
/// way point, proceeds to the next one as soon as it sees it, and plans a new path if it does not
/// see its way point or its goal has moved. Walls hide points that are not reachable straight. In
/// compatible runs, an agent that no longer sees a way point returns to the position from which it
/// saw it last, and plans a new path only if it does not see that position either; moves of a goal
/// are noticed one step later and at the edge of the goal.
class RoadMapRoutes {
 public:
  explicit RoadMapRoutes(RoadMap map);

  void enter(const Crowd& crowd, std::size_t agent);  ///< called when the goal changes
  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred);

 private:
  static constexpr std::size_t kMaxVertices = 32;

  struct Route {
    bool known = false;
    bool whole = false;  ///< whether the goal follows the last way point
    std::size_t next = 0;
    std::size_t count = 0;
    int end = -1;  ///< way point nearest to the goal
    Eigen::Vector2f target = Eigen::Vector2f::Zero();
    /// Position from which the next way point was last seen.
    Eigen::Vector2f seen_from = Eigen::Vector2f::Zero();
    int noticed_end = -1;  ///< compatible runs: the `end` of the last step
    Eigen::Vector2f edge = Eigen::Vector2f::Zero();  ///< nearest point of the goal in that step
    std::array<int, kMaxVertices> vertices{};
  };

  void prefer_as_menge(const Crowd& crowd, std::size_t agent, Route& route,
                       PreferredVelocity& preferred);
  void head_on(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& target,
               const Route& route, PreferredVelocity& preferred) const;
  static bool sees(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& vertex);
  void plan(const Crowd& crowd, std::size_t agent, Route& route);
  bool is_elsewhere(const Crowd& crowd, std::size_t agent, Route& route) const;
  bool advance(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& target,
               Route& route) const;
  int nearest_visible(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& point) const;

  RoadMap map_;
  std::vector<Route> routes_;  // indexed by agent
  tbb::enumerable_thread_specific<RoadFinder> finders_;
};

}  // namespace throng::crowd
