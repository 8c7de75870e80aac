// A graph of way points from a file, and agents' paths along it.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <memory>
#include <vector>

#include "crowd/elements/text_file.h"
#include "crowd/navigation/steering.h"

namespace throng::crowd {

/// Way points and the edges between them, which are walked in both directions.
struct RoadMap {
  struct Road {
    int to = 0;
    float length_m = 0;
  };

  std::vector<Eigen::Vector2f> vertices;  ///< at least one
  std::vector<std::vector<Road>> roads;   ///< by vertex
};

/// Reads Menge's format: vertices with the number of their roads, then roads. Throws InputError
/// (file, line, found, expected), EnvironmentError when the file cannot be read.
RoadMap load_road_map(const TextFile& source);

/// The shortest path between two way points, by A* (Hart, Nilsson and Raphael 1968). One for each
/// thread: it keeps its memory.
class RoadFinder {
 public:
  explicit RoadFinder(const RoadMap& map);
  /// Finds a path; false if there is none. The map is the one given to the constructor.
  bool find(const RoadMap& map, int from, int to);
  /// The way points of the path found last, from its beginning to its end.
  const std::vector<int>& vertices() const { return vertices_; }

 private:
  struct Node {
    unsigned search = 0;  // the last that reached it
    bool done = false;
    int before = -1;
    float cost = 0;
  };
  struct Open {
    float estimate = 0;
    int vertex = 0;
  };

  std::vector<Node> nodes_;
  std::vector<Open> open_;  // a heap
  std::vector<int> vertices_;
  unsigned search_ = 0;
};

/// The paths of all agents that use one map, in any state. An agent begins at the nearest way point
/// that it sees, goes on to the next as soon as it sees that, and plans a new path when it does
/// not see the way point it heads for or its goal has moved. Walls hide points that an agent cannot
/// reach straight. In compatible runs an agent that has lost sight of a way point goes back to
/// where it last saw it from, and looks for a new path only when it does not see that either; and a
/// goal's moves are noticed a step later, at the goal's very edge.
class RoadMapRoutes {
 public:
  explicit RoadMapRoutes(RoadMap map);

  void enter(const Crowd& crowd, std::size_t agent);  ///< the agent has another goal
  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred);

 private:
  static constexpr std::size_t kMaxVertices = 32;

  struct Route {
    bool known = false;
    bool whole = false;  ///< after the last vertex comes the goal
    std::size_t next = 0;
    std::size_t count = 0;
    int end = -1;  ///< the vertex nearest to the goal
    Eigen::Vector2f target = Eigen::Vector2f::Zero();
    Eigen::Vector2f seen_from = Eigen::Vector2f::Zero();  ///< where the next vertex was last seen
    int noticed_end = -1;  ///< compatible runs: the `end` that the last step would have chosen
    Eigen::Vector2f edge = Eigen::Vector2f::Zero();  ///< the goal's nearest point then
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
  std::vector<Route> routes_;  // by agent
  tbb::enumerable_thread_specific<RoadFinder> finders_;
};

}  // namespace throng::crowd
