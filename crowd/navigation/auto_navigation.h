// Path planning around all obstacles without a given mesh or road map.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "crowd/navigation/congestion.h"
#include "crowd/navigation/corner_lane.h"
#include "crowd/navigation/path_finder.h"
#include "crowd/navigation/steering.h"
#include "crowd/navigation/travel_field.h"
#include "crowd/navigation/walkable_mesh.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// The paths of all agents that navigate automatically, in all states. Agents of similar radius
/// that avoid the same classes of obstacles share a mesh, which is created when the first of them
/// enters such a state (usually when the scene has been loaded). The radius of a mesh is rounded up
/// to centimeters and is at most 1.25 times that of its smallest agent.
///
/// An agent walks along the bends of the shortest path; in a crowd it keeps its distance from the
/// wall of a corner until it has passed half of the turn. Twice per second it checks whether it can
/// go straight to the bend after the next one, whether the next one is still reachable straight,
/// and whether its goal has moved; if necessary, it plans a new path. It approaches an unreachable
/// goal as far as possible. An agent inside an obstacle walks out of it.
///
/// Agents that walk to the same place of a goal share a TravelField, in which they find their paths
/// without a search of their own. Every two seconds the fields in use are renewed if people queue,
/// and agents for whom queues lie ahead take another path if it is quicker by a fifth. In
/// compatible runs, and with goals of their own, agents search the shortest path.
class AutoNavigation {
 public:
  AutoNavigation(const Crowd& crowd, const WalkableMeshOptions& options);

  void enter(const Crowd& crowd, std::size_t agent);  ///< called when the goal changes
  /// Creates the meshes for all who have entered so far; called once, before prefer().
  void begin(const Crowd& crowd);
  /// Looks where everybody is, for those who keep lanes in a crowd; called once per step.
  void observe(const Crowd& crowd);
  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred);

  std::size_t mesh_count() const { return grounds_.size(); }

 private:
  static constexpr int kMaxBends = 8;
  static constexpr std::size_t kMaxFields = 32;  ///< per ground; each up to 0.5 MB in a large place
  static constexpr std::size_t kManyWalls = 1024;  ///< initial capacity for the walls near a corner

  struct SharedField {
    TravelField field;
    bool in_use = false;  ///< at the last renewal
  };
  /// The mesh for agents that avoid the same obstacles, with radii up to that of the mesh.
  struct Ground {
    std::uint32_t obstacle_mask = 0;
    float radius = 0;
    NavMesh mesh;
    struct Search {
      PathFinder path;
      TravelField::Buffers buffers;
    };
    PortalTable portals;
    tbb::enumerable_thread_specific<Search> searches;
    std::vector<int> wanted;    ///< by polygon: number of times that somebody set out to it
    std::vector<int> field_of;  ///< by polygon: index of its field; -1: none
    std::vector<SharedField> fields;
    std::size_t field_count = 0;  ///< number of fields that are made

    Ground(std::uint32_t mask, float radius_m, NavMesh made)
        : obstacle_mask(mask),
          radius(radius_m),
          mesh(std::move(made)),
          portals(mesh),
          searches([this] {
            return Search{PathFinder(mesh), TravelField::Buffers(portals)};
          }),
          wanted(mesh.polygons().size()),
          field_of(mesh.polygons().size(), -1),
          fields(kMaxFields, SharedField{TravelField(portals)}) {
      searches.local();  // of this thread, so that no step has to create it
    }
  };
  struct Route {
    int ground = -1;
    bool known = false;
    bool reaches = false;  ///< whether the path ends in the goal, not only near it
    bool whole = false;    ///< whether the last bend is the end of the path
    int polygon = -1;      ///< last polygon of the agent
    int field = -1;        ///< index of the field that it uses; -1: none
    int next = 0;          ///< index of the next bend
    int count = 0;
    Eigen::Vector2f target = Eigen::Vector2f::Zero();  ///< target point in the goal
    int lane_end = 0;  ///< index of the first bend behind the corner of `lane`; 0: not looked for
    std::optional<CornerLane> lane;  ///< how a crowd passes the next bend, until it has been passed
    float keeping = 0;  ///< how much the agent keeps its distance from the wall of a corner, 0 to 1
    Eigen::Vector2f aim = Eigen::Vector2f::Zero();  ///< target point at the next bend
    std::array<Eigen::Vector2f, kMaxBends> bends{};
  };

  void set_out(const Crowd& crowd, std::size_t agent);
  int ground_for(const Crowd& crowd, std::size_t agent);
  static bool fits(float agent_radius, float mesh_radius);
  float mesh_radius(const Crowd& crowd, std::size_t agent) const;
  bool is_time_to_look(const Crowd& crowd, std::size_t agent) const;
  static NavMesh::Location place_on(const NavMesh& mesh, const Eigen::Vector2f& point, int hint);
  void look(const Crowd& crowd, std::size_t agent, Route& route);
  void plan(const Crowd& crowd, std::size_t agent, Route& route);
  static NavMesh::Location destination(const NavMesh& mesh, const Eigen::Vector2f& target,
                                       int island);
  bool has_fields() const;
  void want_field(const Crowd& crowd, std::size_t agent, const Route& route);
  void renew_fields(const Crowd& crowd);
  void reconsider(const Crowd& crowd, std::size_t agent, Route& route);
  float keeping(const Crowd& crowd, std::size_t agent) const;
  void pass_bends(const Crowd& crowd, std::size_t agent, Route& route) const;
  static bool holds_lane(const Route& route, const Eigen::Vector2f& p);
  void find_lane(const Crowd& crowd, std::size_t agent, Route& route);
  void aim(const Crowd& crowd, std::size_t agent, Route& route);

  WalkableMeshOptions options_;
  Box everyone_;  // bounding box of the initial positions
  std::uint32_t all_classes_ = 0;
  std::vector<std::unique_ptr<Ground>> grounds_;
  std::vector<Route> routes_;  // indexed by agent
  bool has_begun_ = false;
  std::vector<std::size_t> waiting_;  // agents who have entered before begin()
  Congestion congestion_;
  std::vector<std::pair<Ground*, SharedField*>> stale_;  // buffer
  Grid everywhere_;                                      // everybody's place, not older than a look
  tbb::enumerable_thread_specific<CornerWalls> walls_;
};

}  // namespace throng::crowd
