// Path planning around all obstacles without a given mesh or road map.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "crowd/navigation/corner_lane.h"
#include "crowd/navigation/path_finder.h"
#include "crowd/navigation/steering.h"
#include "crowd/navigation/walkable_mesh.h"

namespace throng::crowd {

/// The paths of all agents that navigate automatically, in all states. Agents of similar radius
/// that avoid the same classes of obstacles share a mesh, which is created when the first of them
/// enters such a state (usually while the scene is loaded). The radius of a mesh is rounded up to
/// centimeters and is at most 1.25 times that of its smallest agent.
///
/// An agent walks along the bends of the shortest path. Twice per second it checks whether it can
/// go straight to the bend after the next one, whether the next one is still reachable straight,
/// and whether its goal has moved; if necessary, it plans a new path. It approaches an unreachable
/// goal as far as possible. An agent inside an obstacle walks out of it.
class AutoNavigation {
 public:
  AutoNavigation(const Crowd& crowd, const WalkableMeshOptions& options);

  void enter(const Crowd& crowd, std::size_t agent);  ///< called when the goal changes
  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred);

  std::size_t mesh_count() const { return grounds_.size(); }

 private:
  static constexpr int kMaxBends = 8;
  static constexpr std::size_t kManyWalls = 1024;  ///< initial capacity for the walls near a corner

  /// The mesh for agents that avoid the same obstacles, with radii up to that of the mesh.
  struct Ground {
    std::uint32_t obstacle_mask = 0;
    float radius = 0;
    NavMesh mesh;
    tbb::enumerable_thread_specific<PathFinder> finders;

    Ground(std::uint32_t mask, float radius_m, NavMesh made)
        : obstacle_mask(mask),
          radius(radius_m),
          mesh(std::move(made)),
          finders([this] { return PathFinder(mesh); }) {
      finders.local();  // of this thread, so that no step has to create it
    }
  };
  struct Route {
    int ground = -1;
    bool known = false;
    bool reaches = false;  ///< whether the path ends in the goal, not only near it
    bool whole = false;    ///< whether the last bend is the end of the path
    int polygon = -1;      ///< last polygon of the agent
    int next = 0;          ///< index of the next bend
    int count = 0;
    Eigen::Vector2f target = Eigen::Vector2f::Zero();  ///< target point in the goal
    int lane_of = -1;  ///< index of the bend to which `lane` belongs
    std::optional<CornerLane> lane;
    float crowding = 0;  ///< recent loss of speed because of other agents, 0 to 1
    Eigen::Vector2f aim = Eigen::Vector2f::Zero();  ///< target point at the next bend
    std::array<Eigen::Vector2f, kMaxBends> bends{};
  };

  int ground_for(const Crowd& crowd, std::size_t agent);
  static bool fits(float agent_radius, float mesh_radius);
  float mesh_radius(const Crowd& crowd, std::size_t agent) const;
  bool is_time_to_look(const Crowd& crowd, std::size_t agent) const;
  static NavMesh::Location place_on(const NavMesh& mesh, const Eigen::Vector2f& point, int hint);
  void look(const Crowd& crowd, std::size_t agent, Route& route);
  void plan(const Crowd& crowd, std::size_t agent, Route& route);
  static void notice_crowding(const Crowd& crowd, std::size_t agent, Route& route);
  void aim(const Crowd& crowd, std::size_t agent, Route& route);

  WalkableMeshOptions options_;
  Box everyone_;  // bounding box of the initial positions
  std::uint32_t all_classes_ = 0;
  std::vector<std::unique_ptr<Ground>> grounds_;
  std::vector<Route> routes_;                                            // indexed by agent
  tbb::enumerable_thread_specific<std::vector<Obstacles::Near>> walls_;  // walls near a corner
};

}  // namespace throng::crowd
