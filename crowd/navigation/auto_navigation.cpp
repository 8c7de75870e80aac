#include "crowd/navigation/auto_navigation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/geometry/rectangle.h"
#include "crowd/navigation/navigation.h"

namespace throng::crowd {

AutoNavigation::AutoNavigation(const Crowd& crowd, const WalkableMeshOptions& options)
    : options_(options), walls_([] {
        std::vector<Obstacles::Near> walls;
        walls.reserve(kManyWalls);
        return walls;
      }) {
  walls_.local();  // this thread's, so that no step has to make it
  const std::vector<Eigen::Vector2f>& positions = crowd.agents.position;
  if (!positions.empty()) everyone_ = geometry::bounding_box(positions);
  for (const Polygon& polygon : crowd.obstacles.polygons()) all_classes_ |= polygon.obstacle_class;
}

void AutoNavigation::enter(const Crowd& crowd, std::size_t agent) {
  if (agent >= routes_.size()) routes_.resize(std::max(crowd.agents.count(), agent + 1));
  Route& route = routes_[agent];
  route.known = false;
  const int ground = ground_for(crowd, agent);
  if (ground != route.ground) route.polygon = -1;
  route.ground = ground;
}

/// The ground that fits the agent; makes one for all that it may share it with if there is none.
int AutoNavigation::ground_for(const Crowd& crowd, std::size_t agent) {
  const Agents& agents = crowd.agents;
  const std::uint32_t mask = agents.obstacle_mask[agent] & all_classes_;
  const float agent_radius = agents[Property::radius][agent];
  for (std::size_t i = 0; i < grounds_.size(); ++i) {
    const Ground& ground = *grounds_[i];
    if (ground.obstacle_mask == mask && fits(agent_radius, ground.radius)) {
      return static_cast<int>(i);
    }
  }
  const float radius = mesh_radius(crowd, agent);
  NavMesh mesh = make_walkable_mesh(crowd.obstacles, mask, radius, everyone_, options_);
  grounds_.push_back(std::make_unique<Ground>(mask, radius, std::move(mesh)));
  return static_cast<int>(grounds_.size()) - 1;
}

/// Whether an agent of this radius may use a mesh made for another.
bool AutoNavigation::fits(float agent_radius, float mesh_radius) {
  constexpr float kMaxSizeRatio = 1.25F;
  return agent_radius <= mesh_radius && mesh_radius <= kMaxSizeRatio * agent_radius;
}

/// The radius of a new mesh for the agent: that of a mesh for other obstacles if one fits, else
/// that of the biggest agent that may share it, rounded up. So people of random sizes who arrive
/// one by one, or learn of closed doors one by one, do not each need a mesh of their own.
float AutoNavigation::mesh_radius(const Crowd& crowd, std::size_t agent) const {
  constexpr float kStepM = 0.01F;
  const std::vector<float>& radii = crowd.agents[Property::radius];
  float shared = 0;
  for (const auto& ground : grounds_) {
    if (fits(radii[agent], ground->radius)) shared = std::max(shared, ground->radius);
  }
  if (shared > 0) return shared;
  float biggest = radii[agent];
  for (const float radius : radii) {
    if (fits(radii[agent], radius)) biggest = std::max(biggest, radius);
  }
  constexpr float kRounding = 1e-3F;  // steps: 0.25 m stays 0.25 m
  const float rounded = std::max(biggest, kStepM * std::ceil(biggest / kStepM - kRounding));
  return fits(radii[agent], rounded) ? rounded : biggest;
}

void AutoNavigation::prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) {
  Route& route = routes_[agent];
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  if (grounds_[static_cast<std::size_t>(route.ground)]->mesh.polygons().empty()) {
    head_for(crowd, agent, goal_place(crowd, agent, p), preferred);
    return;
  }
  if (!route.known) {
    plan(crowd, agent, route);
    aim(crowd, agent, route);
  } else if (is_time_to_look(crowd, agent)) {
    look(crowd, agent, route);
    notice_crowding(crowd, agent, route);
    aim(crowd, agent, route);
  }
  const float near = crowd.agents[Property::radius][agent];
  while (route.next + 1 < route.count && (route.aim - p).squaredNorm() < near * near) {
    ++route.next;
    route.aim = route.bends[static_cast<std::size_t>(route.next)];
  }
  if (route.next + 1 < route.count || !route.whole) {
    head_through(crowd, agent, route.aim, preferred);
  } else if (route.reaches) {
    head_for(crowd, agent, goal_place(crowd, agent, route.target), preferred);
  } else {
    head_for(crowd, agent, route.bends[static_cast<std::size_t>(route.next)], preferred);
  }
}

/// Not everybody at the same time.
bool AutoNavigation::is_time_to_look(const Crowd& crowd, std::size_t agent) const {
  constexpr double kEveryS = 0.5;
  const auto every =
      std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(kEveryS / crowd.dt_s)));
  return (crowd.step + agent) % every == 0;
}

NavMesh::Location AutoNavigation::place_on(const NavMesh& mesh, const Eigen::Vector2f& point,
                                           int hint) {
  const int polygon = mesh.find(point, hint);
  return polygon >= 0 ? NavMesh::Location{polygon, point} : mesh.nearest(point);
}

/// Checks the path, goes on to the next bend if that is in sight, and plans again if necessary.
void AutoNavigation::look(const Crowd& crowd, std::size_t agent, Route& route) {
  const NavMesh& mesh = grounds_[static_cast<std::size_t>(route.ground)]->mesh;
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  // How far the goal may move, as a share of its distance, before the way is looked for again.
  constexpr float kMoved = 0.05F;
  const float moved = (goal_place(crowd, agent, route.target) - route.target).norm();
  const NavMesh::Location here = place_on(mesh, p, route.polygon);
  route.polygon = here.polygon;
  const auto sees = [&](int bend) {
    return mesh.is_clear(here, route.bends[static_cast<std::size_t>(bend)]);
  };
  if (moved > kMoved * (route.target - p).norm() || !sees(route.next)) {
    plan(crowd, agent, route);
    return;
  }
  while (route.next + 1 < route.count && sees(route.next + 1)) ++route.next;
  const bool at_end = route.next + 1 == route.count;
  if (at_end && !route.whole) plan(crowd, agent, route);
  if (!at_end || !route.whole || !route.reaches) return;
  // Now that the goal is in sight, another place in it may be nearer.
  const Eigen::Vector2f nearest = goal_place(crowd, agent, p);
  if (mesh.is_clear(here, nearest)) {
    route.target = nearest;
    route.bends[static_cast<std::size_t>(route.next)] = nearest;
  }
}

void AutoNavigation::plan(const Crowd& crowd, std::size_t agent, Route& route) {
  Ground& ground = *grounds_[static_cast<std::size_t>(route.ground)];
  const NavMesh& mesh = ground.mesh;
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const NavMesh::Location from = place_on(mesh, p, route.polygon);
  const int island = mesh[from.polygon].island;
  route.target = goal_place(crowd, agent, p);
  NavMesh::Location to{mesh.find(route.target), route.target};
  if (to.polygon < 0 || mesh[to.polygon].island != island) to = mesh.nearest(route.target, island);

  // Places beside a wall are off the mesh by a radius; so may be whom others push against one.
  constexpr float kBeside = 2;  // radii
  const float beside = kBeside * ground.radius;
  route.known = true;
  route.whole = true;
  route.polygon = from.polygon;
  route.next = 0;
  route.lane_of = -1;
  route.count = 0;
  const bool is_far_out = !mesh.bounds().contains(route.target);
  route.reaches = is_far_out || (to.point - route.target).norm() <= beside;
  if ((from.point - p).norm() > beside) route.bends[route.count++] = from.point;
  PathFinder& finder = ground.finders.local();
  finder.find(from, to, 0);
  for (const Eigen::Vector2f& bend : finder.bends()) {
    route.whole = route.count < kMaxBends;
    if (!route.whole) break;
    route.bends[static_cast<std::size_t>(route.count++)] = bend;
  }
}

/// Updates how much of the agent's speed others have cost lately.
void AutoNavigation::notice_crowding(const Crowd& crowd, std::size_t agent, Route& route) {
  constexpr float kFollow = 0.25F;  // of a change, each time
  const Agents& agents = crowd.agents;
  const float wanted = agents.preferred_speed[agent];
  if (wanted <= 0) return;
  const float lost = std::clamp(1 - agents.velocity[agent].norm() / wanted, 0.0F, 1.0F);
  route.crowding += kFollow * (lost - route.crowding);
}

/// A person alone takes the shortest path around a corner; in a crowd, people keep their distance
/// from the wall as they turn, so that the whole width is used.
void AutoNavigation::aim(const Crowd& crowd, std::size_t agent, Route& route) {
  constexpr float kMaxAside = 5;     // m from the corner
  constexpr float kCrowded = 0.25F;  // of the speed lost, from which on people keep their distance
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const Eigen::Vector2f bend = route.bends[static_cast<std::size_t>(route.next)];
  route.aim = bend;
  if (route.next + 1 >= route.count) return;
  const Ground& ground = *grounds_[static_cast<std::size_t>(route.ground)];
  if (route.lane_of != route.next) {
    route.lane = corner_lane(crowd.obstacles, ground.obstacle_mask, p, bend, 3 * ground.radius,
                             walls_.local());
    route.lane_of = route.next;
  }
  if (!route.lane) return;
  const NavMesh::Location here = place_on(ground.mesh, p, route.polygon);
  Eigen::Vector2f aside = route.lane->pass(p) - route.lane->corner;
  aside *= std::min(1.0F, kMaxAside / std::max(aside.norm(), 1e-3F)) *
           std::min(1.0F, route.crowding / kCrowded);
  for (int halvings = 0; halvings < 4; ++halvings, aside /= 2) {
    // Not nearer to the corner than the shortest path.
    if ((aside - (bend - route.lane->corner)).dot(route.lane->across) <= 0) return;
    const Eigen::Vector2f place = route.lane->corner + aside;
    if (ground.mesh.find(place, here.polygon) >= 0 && ground.mesh.is_clear(here, place)) {
      route.aim = place;
      return;
    }
  }
}

namespace {

class AroundObstacles : public VelComponent {
 public:
  explicit AroundObstacles(std::shared_ptr<AutoNavigation> navigation)
      : navigation_(std::move(navigation)) {}
  void enter(const Crowd& crowd, std::size_t agent) override { navigation_->enter(crowd, agent); }
  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) override {
    navigation_->prefer(crowd, agent, preferred);
  }

 private:
  std::shared_ptr<AutoNavigation> navigation_;
};

std::unique_ptr<VelComponent> make_around_obstacles(const Element&, const Attributes& attributes,
                                                    BehaviorContext& context) {
  WalkableMeshOptions options;
  options.margin_m = attributes.real("margin");
  if (attributes.has("cell_size")) options.cell_m = attributes.real("cell_size");
  const std::string key = fmt::format("{} {}", options.cell_m.value_or(0), options.margin_m);
  return std::make_unique<AroundObstacles>(context.crowd.parts->get<AutoNavigation>(
      key, [&] { return std::make_shared<AutoNavigation>(context.crowd, options); }));
}

}  // namespace

VelComponentRegistry::Entry auto_component() {
  return {"auto",
          "the shortest path around all obstacles that the agent minds; needs no file",
          {optional(number("cell_size",
                           "how finely obstacles are drawn, in m; without it a third of the "
                           "agents' radius",
                           0.01, 10)),
           optional(number("margin", "drawn around the obstacles, in m", 0, 1000), "1")},
          make_around_obstacles};
}

}  // namespace throng::crowd
