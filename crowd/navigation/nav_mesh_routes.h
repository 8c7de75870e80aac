// Agents' paths across a hand-made navigation mesh.
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

/// The paths of all agents that use one mesh, in any state. An agent heads for the point where
/// its path passes the next portal. It plans a new path when it has left the polygons of the old
/// one or its goal has moved, and straightens what is left of it when pushed off its heading.
class NavMeshRoutes {
 public:
  NavMeshRoutes(std::shared_ptr<const NavMeshFile> file, std::string file_name, Lengths lengths);

  /// The agent has another goal. Throws InputError for one that starts outside of the mesh.
  void enter(const Crowd& crowd, std::size_t agent);
  /// `heading_cos`: the cosine of how far an agent may turn from the heading of the path it found.
  void prefer(const Crowd& crowd, std::size_t agent, float heading_cos,
              PreferredVelocity& preferred);

 private:
  static constexpr int kMaxGates = 16;

  struct Route {
    bool known = false;
    bool whole = false;  ///< the gates lead to the goal's polygon
    int polygon = -1;    ///< where the agent was last
    int next = 0;        ///< gate
    int count = 0;
    Eigen::Vector2f target = Eigen::Vector2f::Zero();
    Eigen::Vector2f end = Eigen::Vector2f::Zero();  ///< the place on the mesh nearest to the target
    std::array<Gate, kMaxGates> gates;
    std::array<Eigen::Vector2f, kMaxGates> headings;  ///< unit; from gate to gate
  };

  void plan(const Crowd& crowd, std::size_t agent, Route& route);
  void straighten(const Eigen::Vector2f& position, Route& route);
  static void take_gates(std::span<const Gate> gates, const Eigen::Vector2f& position, int first,
                         Route& route);
  /// Unless it is nearer to the portal than `at_portal`.
  static bool is_pushed_off(const Eigen::Vector2f& position, float heading_cos, float at_portal,
                            const Route& route);
  bool keep_up(const Eigen::Vector2f& position, Route& route) const;

  std::shared_ptr<const NavMeshFile> file_;
  std::string file_name_;
  std::vector<Route> routes_;  // by agent
  tbb::enumerable_thread_specific<PathFinder> finders_;
};

}  // namespace throng::crowd
