#include "crowd/navigation/obstacle_sets.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "crowd/navigation/nav_mesh_file.h"

namespace throng::crowd {

namespace {

constexpr float kMinEdge = 1e-3F;  // m

/// Removes a last corner that repeats the first, as many programs write closed polygons.
void drop_repeated_corner(const Element& element, std::vector<Eigen::Vector2f>& corners) {
  constexpr std::size_t kTriangle = 3;
  if (corners.size() <= kTriangle || (corners.back() - corners.front()).norm() >= kMinEdge) return;
  element.warn(fmt::format("a last corner that repeats the first at ({}, {}), which is dropped",
                           corners.front().x(), corners.front().y()),
               "each corner once: the last is joined to the first anyway");
  corners.pop_back();
}

/// Throws for what has no sides.
void check_polygon(const Element& element, const std::vector<Eigen::Vector2f>& corners) {
  constexpr double kMinArea = 1e-6;  // m^2
  if (corners.size() < 3) {
    element.fail(fmt::format("{} corners", corners.size()), "at least three <Vertex>");
  }
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2f& a = corners[i];
    const Eigen::Vector2f& b = corners[(i + 1) % corners.size()];
    if ((b - a).norm() < kMinEdge) {
      element.fail(fmt::format("two corners at ({}, {})", a.x(), a.y()), "corners apart");
    }
    area += 0.5 * (static_cast<double>(a.x()) * b.y() - static_cast<double>(a.y()) * b.x());
  }
  if (std::abs(area) < kMinArea) {
    element.fail("a polygon without area", "a polygon, counter-clockwise when it is solid");
  }
}

std::unique_ptr<ObstacleSet> make_explicit(const Element& element, const Attributes&,
                                           ObstacleSetContext&) {
  auto set = std::make_unique<ObstacleSet>();
  for (const Element& child : element.children()) {
    if (child.name() != "Obstacle") child.fail_unknown("<Obstacle>");
    const Attributes obstacle(child, {boolean("closed", "1: only closed polygons are known")});
    if (!obstacle.boolean("closed")) child.fail_attribute("closed", "0", "1");
    set->polygons.push_back({read_polygon(child), child});
  }
  return set;
}

std::unique_ptr<ObstacleSet> make_of_mesh(const Element& element, const Attributes& attributes,
                                          ObstacleSetContext& context) {
  element.require_no_children();
  const auto file = shared_nav_mesh(element.text_file(attributes.text("file_name")), context.parts);
  auto set = std::make_unique<ObstacleSet>();
  for (const std::vector<Eigen::Vector2f>& outline : file->outlines) {
    set->polygons.push_back({outline, element});
  }
  return set;
}

bool anybody_inside(const Crowd& crowd, const Polygon& polygon) {
  const Agents& agents = crowd.agents;
  for (std::size_t i = 0; i < agents.count(); ++i) {
    if ((agents.obstacle_mask[i] & polygon.obstacle_class) == 0) continue;
    if (crowd.obstacles.encloses(polygon, agents.position[i])) return true;
  }
  return false;
}

}  // namespace

std::vector<Eigen::Vector2f> read_polygon(const Element& element) {
  std::vector<Eigen::Vector2f> corners;
  for (const Element& vertex : element.children()) {
    if (vertex.name() != "Vertex") vertex.fail_unknown("<Vertex>");
    vertex.require_no_children();
    const Attributes place(vertex, {number("p_x", "in m"), number("p_y", "in m")});
    corners.emplace_back(place.real("p_x"), place.real("p_y"));
  }
  drop_repeated_corner(element, corners);
  check_polygon(element, corners);
  return corners;
}

const ObstacleSetRegistry& obstacle_set_registry() {
  static const ObstacleSetRegistry kRegistry(
      {{
          {"explicit", "polygons listed corner by corner", {}, make_explicit},
          {"nav_mesh",
           "the obstacles of a navigation mesh",
           {text("file_name", "a .nav file")},
           make_of_mesh},
      }},
      {integer("class", "bits that agents' obstacleSet is compared with", 0,
               std::numeric_limits<std::uint32_t>::max())});
  return kRegistry;
}

void ObstacleSets::load(const Element& element, Crowd& crowd) {
  const ObstacleSetRegistry::Entry& entry = obstacle_set_registry().find(element);
  const Attributes attributes(element, entry.attributes);
  ObstacleSetContext context{*crowd.parts};
  const std::unique_ptr<ObstacleSet> set = entry.make(element, attributes, context);
  for (const ObstacleSet::Polygon& polygon : set->polygons) {
    crowd.obstacles.add_polygon(polygon.corners,
                                static_cast<std::uint32_t>(attributes.integer("class")));
    elements_.push_back(polygon.element);
  }
}

void ObstacleSets::report(const Crowd& crowd) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Polygon& polygon = crowd.obstacles.polygons()[i];
    const bool anybody = anybody_inside(crowd, polygon);
    if (polygon.solid && anybody) {
      elements_[i].warn("agents that start inside of it",
                        "agents outside, or corners in clockwise order for a wall around people");
    } else if (!polygon.solid && !anybody) {
      elements_[i].warn("corners in clockwise order, which keep people inside, and nobody there",
                        "counter-clockwise order for something solid");
    }
  }
}

}  // namespace throng::crowd
