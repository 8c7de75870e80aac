// Paths around all obstacles, without a hand-made mesh or map.
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

/// The paths of all agents that navigate automatically, in any state. Agents that avoid the
/// same obstacles and are of about the same size share a mesh, which is made when the first of them
/// enters such a state (when the scene is loaded, unless obstacles or sizes change). Its radius is
/// rounded up to whole centimeters, at most 1.25 times that of the smallest who use it.
///
/// An agent walks from bend to bend of the shortest path. Twice a second it looks whether it can go
/// straight to the bend after the next, whether it still can go straight to the next, and whether
/// its goal has moved; if need be it looks for a new path. A goal that cannot be reached is
/// approached as far as possible; who stands inside of an obstacle walks out.
class AutoNavigation {
 public:
  AutoNavigation(const Crowd& crowd, const WalkableMeshOptions& options);

  void enter(const Crowd& crowd, std::size_t agent);  ///< the agent has another goal
  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred);

  std::size_t mesh_count() const { return grounds_.size(); }

 private:
  static constexpr int kMaxBends = 8;
  static constexpr std::size_t kManyWalls = 1024;  ///< around one corner: room for so many at first

  /// For agents that mind the same obstacles, of radii up to the mesh's.
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
      finders.local();  // this thread's, so that no step has to make it
    }
  };
  struct Route {
    int ground = -1;
    bool known = false;
    bool reaches = false;  ///< the path leads to the goal, not just as near as one gets
    bool whole = false;    ///< the last bend is the path's end
    int polygon = -1;      ///< where the agent was last
    int next = 0;          ///< bend
    int count = 0;
    Eigen::Vector2f target = Eigen::Vector2f::Zero();  ///< the place in the goal
    int lane_of = -1;                                  ///< bend that `lane` belongs to
    std::optional<CornerLane> lane;
    float crowding = 0;                             ///< how much speed others cost lately, 0 to 1
    Eigen::Vector2f aim = Eigen::Vector2f::Zero();  ///< where to pass the next bend
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
  Box everyone_;  // where agents are at first
  std::uint32_t all_classes_ = 0;
  std::vector<std::unique_ptr<Ground>> grounds_;
  std::vector<Route> routes_;                                            // by agent
  tbb::enumerable_thread_specific<std::vector<Obstacles::Near>> walls_;  // near a corner: scratch
};

}  // namespace throng::crowd
