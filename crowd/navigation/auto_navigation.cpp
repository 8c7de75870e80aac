#include "crowd/navigation/auto_navigation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/compute/parallel.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "crowd/navigation/navigation.h"

namespace throng::crowd {

namespace {

constexpr std::uint64_t kLooksPerChoice = 4;   // between paths
constexpr std::uint64_t kLooksPerRenewal = 8;  // of fields: queues change within 5 s

std::uint64_t steps_between_looks(const Crowd& crowd) {
  constexpr double kEveryS = 0.5;
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(kEveryS / crowd.dt_s)));
}

}  // namespace

AutoNavigation::AutoNavigation(const Crowd& crowd, const WalkableMeshOptions& options)
    : options_(options), walls_([] {
        CornerWalls walls;
        walls.before.reserve(kManyWalls);
        walls.behind.reserve(kManyWalls);
        return walls;
      }) {
  walls_.local();  // this thread's, so that no step has to make it
  everywhere_.build(crowd.agents);
  stale_.reserve(kMaxFields);
  const std::vector<Eigen::Vector2f>& positions = crowd.agents.position;
  if (!positions.empty()) everyone_ = geometry::bounding_box(positions);
  Box area = everyone_;
  for (const Polygon& polygon : crowd.obstacles.polygons()) {
    all_classes_ |= polygon.obstacle_class;
    area.extend(polygon.bounds.min);
    area.extend(polygon.bounds.max);
  }
  congestion_ = Congestion(area);
}

void AutoNavigation::enter(const Crowd& crowd, std::size_t agent) {
  if (has_begun_) {
    set_out(crowd, agent);
  } else {
    waiting_.push_back(agent);
  }
}

void AutoNavigation::begin(const Crowd& crowd) {
  has_begun_ = true;
  for (const std::size_t agent : std::exchange(waiting_, {})) set_out(crowd, agent);
}

void AutoNavigation::set_out(const Crowd& crowd, std::size_t agent) {
  if (agent >= routes_.size()) routes_.resize(std::max(crowd.agents.count(), agent + 1));
  Route& route = routes_[agent];
  route.known = false;
  const int ground = ground_for(crowd, agent);
  // An agent may leave the state again before it has planned on the new ground.
  if (ground != route.ground) route.polygon = route.field = -1;
  route.ground = ground;
  want_field(crowd, agent, route);
}

bool AutoNavigation::has_fields() const {
  return std::any_of(grounds_.begin(), grounds_.end(),
                     [](const auto& ground) { return ground->field_count > 0; });
}

/// Makes the field of the agent's goal if enough others walk there.
void AutoNavigation::want_field(const Crowd& crowd, std::size_t agent, const Route& route) {
  constexpr int kEnough = 8;  // paths whose search costs as much as a field
  if (crowd.compat != Compat::none || crowd.agents.goal[agent] < 0) return;
  Ground& ground = *grounds_[static_cast<std::size_t>(route.ground)];
  if (ground.mesh.polygons().empty()) return;
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const NavMesh::Location from = place_on(ground.mesh, p, route.polygon);
  const NavMesh::Location to =
      destination(ground.mesh, goal_place(crowd, agent, p), ground.mesh[from.polygon].island);
  if (to.polygon < 0 || ++ground.wanted[static_cast<std::size_t>(to.polygon)] != kEnough) return;
  if (ground.field_count == kMaxFields) return;
  ground.field_of[static_cast<std::size_t>(to.polygon)] = static_cast<int>(ground.field_count);
  ground.fields[ground.field_count++].field.lead_to(to, congestion_,
                                                    ground.searches.local().buffers);
}

/// Returns the place on an island of the mesh at which a path to the target ends.
NavMesh::Location AutoNavigation::destination(const NavMesh& mesh, const Eigen::Vector2f& target,
                                              int island) {
  const NavMesh::Location to{mesh.find(target), target};
  return to.polygon < 0 || mesh[to.polygon].island != island ? mesh.nearest(target, island) : to;
}

/// The ground that fits the agent; makes one for all that it may share it with if there is none.
int AutoNavigation::ground_for(const Crowd& crowd, std::size_t agent) {
  const Agents& agents = crowd.agents;
  const std::uint32_t mask = agents.known_mask(agent) & all_classes_;
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
    aim(crowd, agent, route);
  }
  pass_bends(crowd, agent, route);
  if (route.next + 1 < route.count || !route.whole) {
    head_through(crowd, agent, route.aim, preferred);
  } else if (route.reaches) {
    head_for(crowd, agent, goal_place(crowd, agent, route.target), preferred);
  } else {
    head_for(crowd, agent, route.bends[static_cast<std::size_t>(route.next)], preferred);
  }
}

void AutoNavigation::observe(const Crowd& crowd) {
  if (crowd.step % steps_between_looks(crowd) != 0) return;
  everywhere_.build(crowd.agents);
  if (!has_fields()) return;
  congestion_.observe(crowd.agents);
  if (crowd.step / steps_between_looks(crowd) % kLooksPerRenewal == 0) renew_fields(crowd);
}

/// Renews the fields in use where people queue, and others that still count queues of before.
void AutoNavigation::renew_fields(const Crowd& crowd) {
  for (const auto& ground : grounds_) {
    for (SharedField& shared : ground->fields) shared.in_use = false;
  }
  for (std::size_t i = 0; !congestion_.is_nil() && i < routes_.size(); ++i) {
    const Route& route = routes_[i];
    if (crowd.agents.present[i] == 0 || route.field < 0) continue;
    Ground& ground = *grounds_[static_cast<std::size_t>(route.ground)];
    ground.fields[static_cast<std::size_t>(route.field)].in_use = true;
  }
  stale_.clear();
  for (const auto& ground : grounds_) {
    for (SharedField& shared : ground->fields) {
      if (shared.in_use || shared.field.has_delays()) stale_.emplace_back(ground.get(), &shared);
    }
  }
  const Congestion none;
  parallel_ranges(stale_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [ground, shared] = stale_[i];
      shared->field.renew(shared->in_use ? congestion_ : none, ground->searches.local().buffers);
    }
  });
}

/// Plans again if queues lie ahead and another path is quicker.
void AutoNavigation::reconsider(const Crowd& crowd, std::size_t agent, Route& route) {
  constexpr float kWorthM = 5;      // of delay
  constexpr float kQuicker = 0.8F;  // so that nobody goes to and fro
  const bool is_time = (crowd.step + agent) / steps_between_looks(crowd) % kLooksPerChoice == 0;
  if (!is_time || congestion_.is_nil() || route.field < 0 || !route.whole) return;
  Ground& ground = *grounds_[static_cast<std::size_t>(route.ground)];
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const std::span<const Eigen::Vector2f> ahead(route.bends.data() + route.next,
                                               static_cast<std::size_t>(route.count - route.next));
  const float cost = path_cost_m(p, ahead, congestion_);
  if (cost - path_cost_m(p, ahead, {}) < kWorthM) return;
  const NavMesh::Location from = place_on(ground.mesh, p, route.polygon);
  const NavMesh::Location to =
      destination(ground.mesh, route.target, ground.mesh[from.polygon].island);
  const int number = to.polygon < 0 ? -1 : ground.field_of[static_cast<std::size_t>(to.polygon)];
  if (number < 0) return;
  auto& [path, buffers] = ground.searches.local();
  const TravelField& field = ground.fields[static_cast<std::size_t>(number)].field;
  if (field.find(from, to.point, congestion_, path, buffers) < kQuicker * cost) {
    plan(crowd, agent, route);
  }
}

/// Not everybody at the same time.
bool AutoNavigation::is_time_to_look(const Crowd& crowd, std::size_t agent) const {
  return (crowd.step + agent) % steps_between_looks(crowd) == 0;
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
  reconsider(crowd, agent, route);
  if (!holds_lane(route, p)) {
    while (route.next + 1 < route.count && sees(route.next + 1)) ++route.next;
  }
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
  const NavMesh::Location to = destination(mesh, route.target, island);

  // Places beside a wall are off the mesh by a radius; so may be whom others push against one.
  constexpr float kBeside = 2;  // radii
  const float beside = kBeside * ground.radius;
  route.known = true;
  route.whole = true;
  route.polygon = from.polygon;
  route.next = 0;
  route.lane_end = 0;
  route.count = 0;
  const bool is_far_out = !mesh.bounds().contains(route.target);
  route.reaches = is_far_out || (to.point - route.target).norm() <= beside;
  if ((from.point - p).norm() > beside) route.bends[route.count++] = from.point;
  auto& [path, buffers] = ground.searches.local();
  const bool is_shared = crowd.agents.goal[agent] >= 0 && to.polygon >= 0;
  route.field = is_shared ? ground.field_of[static_cast<std::size_t>(to.polygon)] : -1;
  if (route.field < 0) {
    path.find(from, to, 0);
  } else {
    ground.fields[static_cast<std::size_t>(route.field)].field.find(from, to.point, congestion_,
                                                                    path, buffers);
  }
  for (const Eigen::Vector2f& bend : path.bends()) {
    route.whole = route.count < kMaxBends;
    if (!route.whole) break;
    route.bends[static_cast<std::size_t>(route.count++)] = bend;
  }
}

/// Goes on to the next bend where the agent is at the one before and sees the next, or across the
/// line of a corner. Somebody beside a door who went on too early would walk into its jamb.
void AutoNavigation::pass_bends(const Crowd& crowd, std::size_t agent, Route& route) const {
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const float near = crowd.agents[Property::radius][agent];
  const int before = route.next;
  if (route.lane && route.next < route.lane_end && route.lane->is_passed(p)) {
    route.next = route.lane_end;
  } else if (!holds_lane(route, p)) {
    const NavMesh& mesh = grounds_[static_cast<std::size_t>(route.ground)]->mesh;
    const auto bend = [&](int i) { return route.bends[static_cast<std::size_t>(i)]; };
    while (route.next + 1 < route.count && (route.aim - p).squaredNorm() < near * near &&
           mesh.is_clear(place_on(mesh, p, route.polygon), bend(route.next + 1))) {
      ++route.next;
      route.aim = bend(route.next);
    }
  }
  if (route.next != before) route.aim = route.bends[static_cast<std::size_t>(route.next)];
}

/// How much the agent keeps its distance from the wall of a corner, 0 to 1: a person alone takes
/// the shortest path; in a crowd, the whole width is used.
float AutoNavigation::keeping(const Crowd& crowd, std::size_t agent) const {
  constexpr float kAround = 2;  // m
  constexpr int kFew = 1;       // people around
  constexpr int kMany = 4;
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  int others = -1;
  everywhere_.visit(p, kAround, [&](std::size_t slot) {
    if ((everywhere_.position(slot) - p).squaredNorm() < kAround * kAround) ++others;
  });
  return std::clamp(static_cast<float>(others - kFew) / (kMany - kFew), 0.0F, 1.0F);
}

/// Whether the agent goes on to the line of its corner though it may see behind the corner.
bool AutoNavigation::holds_lane(const Route& route, const Eigen::Vector2f& p) {
  return route.lane && route.next < route.lane_end && route.keeping > 0 &&
         !route.lane->is_passed(p);
}

/// Looks for the corner at the next bend; several bends in a row may go around one corner.
void AutoNavigation::find_lane(const Crowd& crowd, std::size_t agent, Route& route) {
  if (route.next < route.lane_end) return;
  const Ground& ground = *grounds_[static_cast<std::size_t>(route.ground)];
  const auto bend = [&](int i) { return route.bends[static_cast<std::size_t>(i)]; };
  route.lane_end = route.next + 1;
  const auto turn = [&](int i) {
    const Eigen::Vector2f before = i > route.next ? bend(i - 1) : crowd.agents.position[agent];
    return geometry::cross(bend(i) - before, bend(i + 1) - bend(i));
  };
  while (route.lane_end + 1 < route.count && turn(route.lane_end) * turn(route.next) > 0 &&
         (bend(route.lane_end) - bend(route.lane_end - 1)).norm() < corner_reach_m(ground.radius)) {
    ++route.lane_end;
  }
  route.lane = corner_lane(crowd.obstacles, ground.obstacle_mask,
                           {crowd.agents.position[agent], bend(route.next),
                            bend(route.lane_end - 1), bend(route.lane_end)},
                           ground.radius, walls_.local());
}

/// Chooses where the agent passes the next bend.
void AutoNavigation::aim(const Crowd& crowd, std::size_t agent, Route& route) {
  constexpr float kMaxAside = 10;  // m from the corner
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const Eigen::Vector2f bend = route.bends[static_cast<std::size_t>(route.next)];
  route.aim = bend;
  if (route.next + 1 >= route.count) return;
  find_lane(crowd, agent, route);
  route.keeping = route.lane ? keeping(crowd, agent) : 0;
  if (!holds_lane(route, p)) return;
  const Ground& ground = *grounds_[static_cast<std::size_t>(route.ground)];
  const CornerLane& lane = *route.lane;
  const NavMesh::Location here = place_on(ground.mesh, p, route.polygon);
  const float leg = (route.bends[static_cast<std::size_t>(route.lane_end)] - lane.corner).norm();
  Eigen::Vector2f aside = lane.pass(p) - lane.corner;
  aside *= route.keeping * std::min(1.0F, std::min(kMaxAside, leg) / std::max(aside.norm(), 1e-3F));
  constexpr float kLess = 0.8F;
  for (int tries = 0; tries < 8; ++tries, aside *= kLess) {
    // Not nearer to the corner than the shortest path.
    if ((aside - (bend - lane.corner)).dot(lane.across) <= 0) return;
    const Eigen::Vector2f place = lane.corner + aside;
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

class Observation : public Process {
 public:
  explicit Observation(std::shared_ptr<AutoNavigation> navigation)
      : navigation_(std::move(navigation)) {}
  void before_start(const Crowd& crowd) override { navigation_->begin(crowd); }
  void before_decisions(Crowd& crowd, Machine&) override { navigation_->observe(crowd); }

 private:
  std::shared_ptr<AutoNavigation> navigation_;
};

std::unique_ptr<VelComponent> make_around_obstacles(const Element&, const Attributes& attributes,
                                                    BehaviorContext& context) {
  WalkableMeshOptions options;
  options.margin_m = attributes.real("margin");
  if (attributes.has("cell_size")) options.cell_m = attributes.real("cell_size");
  const std::string key = fmt::format("{} {}", options.cell_m.value_or(0), options.margin_m);
  return std::make_unique<AroundObstacles>(context.crowd.parts->get<AutoNavigation>(key, [&] {
    auto made = std::make_shared<AutoNavigation>(context.crowd, options);
    context.processes.push_back(std::make_unique<Observation>(made));
    return made;
  }));
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
