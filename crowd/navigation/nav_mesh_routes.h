// Paths of agents on a given navigation mesh.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "crowd/navigation/nav_mesh_file.h"
#include "crowd/navigation/path_finder.h"
#include "crowd/navigation/steering.h"

namespace throng::crowd {

/// The paths of all agents that use one mesh, in all states. An agent heads for the point at which
/// its path crosses the next portal. It plans a new path when it has left the polygons of its path
/// or its goal has moved, and straightens the rest of the path when it has been pushed off its
/// heading.
class NavMeshRoutes {
 public:
  NavMeshRoutes(std::shared_ptr<const NavMeshFile> file, std::string file_name, Lengths lengths);

  /// Called when the goal changes. Throws InputError for an agent that starts outside the mesh.
  void enter(const Crowd& crowd, std::size_t agent);
  /// `heading_cos`: cosine of the max deviation from the heading of the planned path.
  void prefer(const Crowd& crowd, std::size_t agent, float heading_cos,
              PreferredVelocity& preferred);

 private:
  static constexpr int kMaxGates = 16;

  struct Route {
    bool known = false;
    bool whole = false;  ///< whether the gates lead to the polygon of the goal
    int polygon = -1;    ///< last polygon of the agent
    int next = 0;        ///< index of the next gate
    int count = 0;
    Eigen::Vector2f target = Eigen::Vector2f::Zero();
    Eigen::Vector2f end = Eigen::Vector2f::Zero();  ///< the point of the mesh nearest to the target
    std::array<Gate, kMaxGates> gates;
    std::array<Eigen::Vector2f, kMaxGates> headings;  ///< unit vectors from gate to gate
  };

  void plan(const Crowd& crowd, std::size_t agent, Route& route);
  void straighten(const Eigen::Vector2f& position, Route& route);
  static void take_gates(std::span<const Gate> gates, const Eigen::Vector2f& position, int first,
                         Route& route);
  /// False if the agent is nearer to the portal than `at_portal`.
  static bool is_pushed_off(const Eigen::Vector2f& position, float heading_cos, float at_portal,
                            const Route& route);
  bool keep_up(const Eigen::Vector2f& position, Route& route) const;

  std::shared_ptr<const NavMeshFile> file_;
  std::string file_name_;
  std::vector<Route> routes_;  // indexed by agent
  tbb::enumerable_thread_specific<PathFinder> finders_;
};

}  // namespace throng::crowd
