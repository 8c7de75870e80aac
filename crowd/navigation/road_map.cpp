#include "crowd/navigation/road_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "crowd/elements/number_file.h"
#include "crowd/navigation/navigation.h"

namespace throng::crowd {

RoadMap load_road_map(const TextFile& source) {
  NumberFile file(source);
  RoadMap map;
  const int vertices = file.count("the number of vertices", 1, 3);
  for (int i = 0; i < vertices; ++i) {
    file.integer("the number of roads at a vertex", 0, std::numeric_limits<int>::max());
    const float x = file.real("a vertex's x in m");
    map.vertices.emplace_back(x, file.real("a vertex's y in m"));
  }
  map.roads.resize(map.vertices.size());
  const int roads = file.count("the number of roads", 0, 2);
  for (int i = 0; i < roads; ++i) {
    const int from = file.integer("the vertex where a road begins", 0, vertices - 1);
    const int to = file.integer("the vertex where a road ends", 0, vertices - 1);
    const float length = (map.vertices[to] - map.vertices[from]).norm();
    map.roads[from].push_back({to, length});
    map.roads[to].push_back({from, length});
  }
  if (!file.at_end()) file.fail("more after the last road", "the end of the file");
  return map;
}

RoadFinder::RoadFinder(const RoadMap& map) : nodes_(map.vertices.size()) {
  std::size_t roads = 1;
  for (const std::vector<RoadMap::Road>& from : map.roads) roads += from.size();
  open_.reserve(roads);
  vertices_.reserve(map.vertices.size());
}

bool RoadFinder::find(const RoadMap& map, int from, int to) {
  const auto worse = [](const Open& a, const Open& b) {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.vertex > b.vertex;
  };
  const Eigen::Vector2f& end = map.vertices[to];
  vertices_.clear();
  open_.clear();
  nodes_[from] = {++search_, false, -1, 0};
  open_.push_back({(end - map.vertices[from]).norm(), from});
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), worse);
    const int vertex = open_.back().vertex;
    open_.pop_back();
    if (nodes_[vertex].done) continue;
    nodes_[vertex].done = true;
    if (vertex == to) {
      for (int i = to; i >= 0; i = nodes_[i].before) vertices_.push_back(i);
      std::reverse(vertices_.begin(), vertices_.end());
      return true;
    }
    for (const RoadMap::Road& road : map.roads[vertex]) {
      Node& node = nodes_[road.to];
      const float cost = nodes_[vertex].cost + road.length_m;
      if (node.search == search_ && (node.done || cost >= node.cost)) continue;
      node = {search_, false, vertex, cost};
      open_.push_back({cost + (end - map.vertices[road.to]).norm(), road.to});
      std::push_heap(open_.begin(), open_.end(), worse);
    }
  }
  return false;
}

RoadMapRoutes::RoadMapRoutes(RoadMap map) : map_(std::move(map)), finders_(RoadFinder(map_)) {}

void RoadMapRoutes::enter(const Crowd& crowd, std::size_t agent) {
  if (agent >= routes_.size()) routes_.resize(std::max(crowd.agents.count(), agent + 1));
  routes_[agent].known = false;
}

void RoadMapRoutes::prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) {
  Route& route = routes_[agent];
  if (crowd.compat != Compat::none) return prefer_as_menge(crowd, agent, route, preferred);
  const Eigen::Vector2f target = goal_place(crowd, agent, crowd.agents.position[agent]);
  if (!route.known || is_elsewhere(crowd, agent, route) || !advance(crowd, agent, target, route)) {
    plan(crowd, agent, route);
    advance(crowd, agent, target, route);
  }
  head_on(crowd, agent, target, route, preferred);
}

void RoadMapRoutes::prefer_as_menge(const Crowd& crowd, std::size_t agent, Route& route,
                                    PreferredVelocity& preferred) {
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const Eigen::Vector2f target = goal_place(crowd, agent, p);
  const int goal = crowd.agents.goal[agent];
  const bool has_moved = goal >= 0 && route.known && route.noticed_end != route.end;
  if (!route.known || has_moved) plan(crowd, agent, route);
  if (goal >= 0) {
    const Eigen::Vector2f edge = crowd.goals[goal].shape->nearest_point(p, 0);
    if (edge != route.edge) route.noticed_end = nearest_visible(crowd, agent, edge);
    route.edge = edge;
  }
  if (!advance(crowd, agent, target, route)) {
    if (route.whole && sees(crowd, agent, route.seen_from)) {
      return head_through(crowd, agent, route.seen_from, preferred);
    }
    plan(crowd, agent, route);
    advance(crowd, agent, target, route);
  }
  route.seen_from = p;
  head_on(crowd, agent, target, route, preferred);
}

void RoadMapRoutes::head_on(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& target,
                            const Route& route, PreferredVelocity& preferred) const {
  if (route.next == route.count) {
    head_for(crowd, agent, target, preferred);
  } else {
    head_through(crowd, agent, map_.vertices[route.vertices[route.next]], preferred);
  }
}

/// Whether the goal has moved to where another vertex is the nearest.
bool RoadMapRoutes::is_elsewhere(const Crowd& crowd, std::size_t agent, Route& route) const {
  const Eigen::Vector2f now = goal_place(crowd, agent, route.target);
  if (now == route.target) return false;
  route.target = now;
  return nearest_visible(crowd, agent, now) != route.end;
}

bool RoadMapRoutes::sees(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& vertex) {
  const Agents& agents = crowd.agents;
  return crowd.obstacles.visible(agents.position[agent], vertex, agents[Property::radius][agent],
                                 agents.obstacle_mask[agent]);
}

/// Goes on from vertex to vertex as long as the agent sees the next; false if it is lost.
bool RoadMapRoutes::advance(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& target,
                            Route& route) const {
  const auto sees_place = [&](std::size_t i) {
    return sees(crowd, agent, i == route.count ? target : map_.vertices[route.vertices[i]]);
  };
  // After the last vertex comes the goal, unless that is not the end of the way.
  const std::size_t last = route.whole || route.count == 0 ? route.count : route.count - 1;
  const std::size_t before = route.next;
  while (route.next < last && sees_place(route.next + 1)) ++route.next;
  if (!route.whole && route.next == last) return false;
  return route.next > before || sees_place(route.next);
}

void RoadMapRoutes::plan(const Crowd& crowd, std::size_t agent, Route& route) {
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  route.known = true;
  route.whole = true;
  route.next = 0;
  route.count = 0;
  route.target = goal_place(crowd, agent, p);
  RoadFinder& finder = finders_.local();
  route.end = nearest_visible(crowd, agent, route.target);
  route.noticed_end = route.end;
  if (!finder.find(map_, nearest_visible(crowd, agent, p), route.end)) return;
  route.count = std::min(finder.vertices().size(), kMaxVertices);
  route.whole = route.count == finder.vertices().size();
  std::copy_n(finder.vertices().begin(), route.count, route.vertices.begin());
}

/// The nearest vertex that a point sees; if it sees none, the nearest.
int RoadMapRoutes::nearest_visible(const Crowd& crowd, std::size_t agent,
                                   const Eigen::Vector2f& point) const {
  const Agents& agents = crowd.agents;
  int nearest = 0;
  int seen = -1;
  const auto distance_sq = [&](int vertex) {
    return (map_.vertices[vertex] - point).squaredNorm();
  };
  for (int i = 0; i < static_cast<int>(map_.vertices.size()); ++i) {
    if (distance_sq(i) < distance_sq(nearest)) nearest = i;
    if (seen >= 0 && distance_sq(i) >= distance_sq(seen)) continue;
    if (crowd.obstacles.visible(point, map_.vertices[i], agents[Property::radius][agent],
                                agents.obstacle_mask[agent])) {
      seen = i;
    }
  }
  return seen >= 0 ? seen : nearest;
}

namespace {

class AlongRoads : public VelComponent {
 public:
  explicit AlongRoads(std::shared_ptr<RoadMapRoutes> routes) : routes_(std::move(routes)) {}
  void enter(const Crowd& crowd, std::size_t agent) override { routes_->enter(crowd, agent); }
  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) override {
    routes_->prefer(crowd, agent, preferred);
  }

 private:
  std::shared_ptr<RoadMapRoutes> routes_;
};

std::unique_ptr<VelComponent> make_along_roads(const Element& element, const Attributes& attributes,
                                               BehaviorContext& context) {
  const TextFile file = element.text_file(attributes.text("file_name"));
  return std::make_unique<AlongRoads>(context.crowd.parts->get<RoadMapRoutes>(
      file.key(), [&] { return std::make_shared<RoadMapRoutes>(load_road_map(file)); }));
}

}  // namespace

VelComponentRegistry::Entry road_map_component() {
  return {"road_map",
          "along the roads of a graph, from vertex to vertex",
          {text("file_name", "of the graph")},
          make_along_roads};
}

}  // namespace throng::crowd
