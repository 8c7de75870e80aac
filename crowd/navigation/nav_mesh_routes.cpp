#include "crowd/navigation/nav_mesh_routes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"
#include "crowd/navigation/navigation.h"

namespace throng::crowd {

namespace {

/// The direction from `from` that just touches a circle, on its right (turn = -1) or left side.
Eigen::Vector2f tangent(const Eigen::Vector2f& from, const Eigen::Vector2f& center, float radius,
                        float turn) {
  const Eigen::Vector2f way = (center - from).normalized();
  const float s = turn * std::min(1.0F, radius / (center - from).norm());
  const float c = std::sqrt(1 - s * s);
  return {c * way.x() - s * way.y(), s * way.x() + c * way.y()};
}

/// The direction turned as far as need be to pass the corners of a gate at a distance. If there
/// is no room for that it stays, except in compatible runs.
Eigen::Vector2f clear_of_corners(const Eigen::Vector2f& direction, const Gate& gate,
                                 const Eigen::Vector2f& from, float radius, Compat compat) {
  const float too_near = compat == Compat::none ? radius * radius : 0;
  const bool near_left = (gate.left_corner - from).squaredNorm() <= too_near;
  const bool near_right = (gate.right_corner - from).squaredNorm() <= too_near;
  if (near_left || near_right) return direction;
  const Eigen::Vector2f leftmost = tangent(from, gate.left_corner, radius, -1);
  const Eigen::Vector2f rightmost = tangent(from, gate.right_corner, radius, 1);
  const bool narrow = geometry::cross(rightmost, leftmost) <= 0;
  if (narrow && compat == Compat::none) return direction;
  if (geometry::cross(direction, leftmost) < 0) return leftmost;
  if (geometry::cross(rightmost, direction) < 0) return rightmost;
  return direction;
}

}  // namespace

NavMeshRoutes::NavMeshRoutes(std::shared_ptr<const NavMeshFile> file, std::string file_name,
                             Lengths lengths)
    : file_(std::move(file)),
      file_name_(std::move(file_name)),
      finders_(PathFinder(file_->mesh, lengths)) {}

void NavMeshRoutes::enter(const Crowd& crowd, std::size_t agent) {
  if (agent >= routes_.size()) routes_.resize(std::max(crowd.agents.count(), agent + 1));
  routes_[agent].known = false;
  if (crowd.step > 0) return;  // later on people may be pushed over the mesh's edge
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const float distance = (file_->mesh.nearest(p).point - p).norm();
  if (distance > crowd.agents[Property::radius][agent]) {
    throw InputError(Problem{file_name_,
                             fmt::format("agent {} at ({:.2f}, {:.2f})", agent, p.x(), p.y()),
                             fmt::format("a position {:.2f} m outside of the mesh", distance),
                             "agents with this velocity component on the mesh"});
  }
}

void NavMeshRoutes::prefer(const Crowd& crowd, std::size_t agent, float heading_cos,
                           PreferredVelocity& preferred) {
  Route& route = routes_[agent];
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  // How far the goal may move, as a share of its distance, before the way is looked for again.
  constexpr float kMoved = 0.02F;
  const float moved = (goal_place(crowd, agent, route.target) - route.target).norm();
  if (!route.known || moved > kMoved * (route.target - p).norm() || !keep_up(p, route) ||
      (route.next == route.count && !route.whole)) {
    plan(crowd, agent, route);
  }
  // In m; what is nearer has no direction to speak of.
  const float at_portal = crowd.compat == Compat::none ? 0.05F : 0;
  if (is_pushed_off(p, heading_cos, at_portal, route)) straighten(p, route);
  if (route.next == route.count) {
    head_for(crowd, agent, goal_place(crowd, agent, p), preferred);
    return;
  }
  const Gate& gate = route.gates[static_cast<std::size_t>(route.next)];
  head_through(crowd, agent, gate.crossing, preferred);
  preferred.direction = clear_of_corners(preferred.direction, gate, p,
                                         crowd.agents[Property::radius][agent], crowd.compat);
}

bool NavMeshRoutes::is_pushed_off(const Eigen::Vector2f& position, float heading_cos,
                                  float at_portal, const Route& route) {
  if (route.next == route.count) return false;
  const auto next = static_cast<std::size_t>(route.next);
  const Eigen::Vector2f way = route.gates[next].crossing - position;
  const float distance = way.norm();
  return distance > at_portal && way.dot(route.headings[next]) < heading_cos * distance;
}

/// Finds out how far the agent has come; false if it has left its way.
bool NavMeshRoutes::keep_up(const Eigen::Vector2f& position, Route& route) const {
  const int polygon = file_->mesh.find(position, route.polygon);
  if (polygon < 0 || polygon == route.polygon) return true;
  for (int i = route.next; i < route.count; ++i) {
    if (route.gates[static_cast<std::size_t>(i)].polygon != polygon) continue;
    route.next = i + 1;
    route.polygon = polygon;
    return true;
  }
  return false;
}

void NavMeshRoutes::plan(const Crowd& crowd, std::size_t agent, Route& route) {
  const NavMesh& mesh = file_->mesh;
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const Eigen::Vector2f target = goal_place(crowd, agent, p);
  NavMesh::Location from{mesh.find(p, route.polygon), p};
  if (from.polygon < 0) from = mesh.nearest(p);
  NavMesh::Location to{mesh.find(target), target};
  const int island = from.polygon < 0 ? -1 : mesh[from.polygon].island;
  if (to.polygon < 0 || mesh[to.polygon].island != island) to = mesh.nearest(target, island);

  route.known = true;
  route.whole = true;
  route.polygon = from.polygon;
  route.next = 0;
  route.count = 0;
  route.target = target;
  route.end = to.point;
  PathFinder& finder = finders_.local();
  if (finder.find(from, to, crowd.agents[Property::radius][agent])) {
    take_gates(finder.gates(), p, 0, route);
  }
}

/// The shortest path through the gates that are left. If those do not lead to the goal, the last
/// one's crossing stays where it is.
void NavMeshRoutes::straighten(const Eigen::Vector2f& position, Route& route) {
  const auto next = static_cast<std::size_t>(route.next);
  const auto left = static_cast<std::size_t>(route.count) - next;
  if (left == 0) return;
  const std::span<const Gate> gates = std::span<const Gate>(route.gates).subspan(next, left);
  PathFinder& finder = finders_.local();
  finder.find_through(gates, position, route.whole ? route.end : gates.back().crossing);
  take_gates(finder.gates(), position, route.next, route);
}

void NavMeshRoutes::take_gates(std::span<const Gate> gates, const Eigen::Vector2f& position,
                               int first, Route& route) {
  route.count = first;
  Eigen::Vector2f at = position;
  for (const Gate& gate : gates) {
    if (route.count == kMaxGates) {
      route.whole = false;
      return;
    }
    const Eigen::Vector2f way = gate.crossing - at;
    const float distance = way.norm();
    const auto i = static_cast<std::size_t>(route.count++);
    route.gates[i] = gate;
    route.headings[i] = distance > 0 ? Eigen::Vector2f(way / distance) : Eigen::Vector2f::Zero();
    at = gate.crossing;
  }
}

namespace {

/// Along a mesh from a file to the agent's goal.
class AcrossMesh : public VelComponent {
 public:
  AcrossMesh(std::shared_ptr<NavMeshRoutes> routes, float heading_cos)
      : routes_(std::move(routes)), heading_cos_(heading_cos) {}
  void enter(const Crowd& crowd, std::size_t agent) override { routes_->enter(crowd, agent); }
  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) override {
    routes_->prefer(crowd, agent, heading_cos_, preferred);
  }

 private:
  std::shared_ptr<NavMeshRoutes> routes_;
  float heading_cos_;
};

std::unique_ptr<VelComponent> make_across_mesh(const Element& element, const Attributes& attributes,
                                               BehaviorContext& context) {
  SharedParts& parts = *context.crowd.parts;
  const TextFile file = element.text_file(attributes.text("file_name"));
  const Lengths lengths =
      context.crowd.compat == Compat::none ? Lengths::shortest : Lengths::centers;
  auto routes = parts.get<NavMeshRoutes>(file.key(), [&] {
    return std::make_shared<NavMeshRoutes>(shared_nav_mesh(file, parts),
                                           file.path.filename().string(), lengths);
  });
  return std::make_unique<AcrossMesh>(
      std::move(routes), std::cos(attributes.real("heading_threshold") * kRadiansPerDegree));
}

}  // namespace

VelComponentRegistry::Entry nav_mesh_component() {
  return {
      "nav_mesh",
      "the shortest path across a navigation mesh",
      {text("file_name", "of the mesh (.nav)"),
       optional(
           number("heading_threshold",
                  "how far others may push an agent off the path's heading before a new path is "
                  "looked for, in degrees",
                  0, 180),
           "180")},
      make_across_mesh};
}

}  // namespace throng::crowd
