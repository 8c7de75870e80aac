#include "crowd/scene.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "crowd/agent_groups.h"
#include "crowd/profile.h"

namespace throng::crowd {

namespace {

/// Throws for what is not a solid polygon.
void check_polygon(const Element& element, const std::vector<Eigen::Vector2f>& corners) {
  constexpr float kShortestEdge = 1e-3F;  // m
  constexpr double kSmallestArea = 1e-6;  // m^2
  if (corners.size() < 3) {
    element.fail(fmt::format("{} corners", corners.size()), "at least three <Vertex>");
  }
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2f& a = corners[i];
    const Eigen::Vector2f& b = corners[(i + 1) % corners.size()];
    if ((b - a).norm() < kShortestEdge) {
      element.fail(fmt::format("two corners at ({}, {})", a.x(), a.y()), "corners apart");
    }
    area += 0.5 * (static_cast<double>(a.x()) * b.y() - static_cast<double>(a.y()) * b.x());
  }
  if (area < kSmallestArea) {
    element.fail(area < -kSmallestArea ? "corners in clockwise order" : "a polygon without area",
                 "a polygon whose corners are in counter-clockwise order");
  }
}

void load_obstacles(const Element& element, Obstacles& obstacles) {
  const Attributes attributes(element,
                              {word("type", {"explicit"}, "how obstacles are given"),
                               integer("class", "bits that agents' obstacleSet is compared with", 0,
                                       std::numeric_limits<std::uint32_t>::max())});
  for (const Element& child : element.children()) {
    if (child.name() != "Obstacle") child.fail_unknown("<Obstacle>");
    const Attributes obstacle(child, {boolean("closed", "1: only closed polygons are known")});
    if (!obstacle.boolean("closed")) child.fail_attribute("closed", "0", "1");
    std::vector<Eigen::Vector2f> corners;
    for (const Element& vertex : child.children()) {
      if (vertex.name() != "Vertex") vertex.fail_unknown("<Vertex>");
      vertex.require_no_children();
      const Attributes place(vertex, {number("p_x", "in m"), number("p_y", "in m")});
      corners.emplace_back(place.real("p_x"), place.real("p_y"));
    }
    check_polygon(child, corners);
    obstacles.add_polygon(corners, static_cast<std::uint32_t>(attributes.integer("class")));
  }
}

void load_spatial_query(const Element& element, Crowd& crowd) {
  element.require_no_children();
  const Attributes attributes(
      element, {word("type", {"kd-tree"}, "how neighbours are found; a grid serves here"),
                optional(boolean("test_visibility", "1: walls hide neighbours"), "0")});
  crowd.test_visibility = attributes.boolean("test_visibility");
}

/// What a model's element in the scene says for all agents.
void load_constants(const Element& element, const ModelEntry& model, std::vector<float>& values) {
  AttributeTable table;
  for (const ModelParameter& constant : model.constants) {
    table.push_back(optional(number(constant.name, constant.help, constant.min, constant.max)));
  }
  const Attributes attributes(element, table);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (attributes.has(table[i].name)) values[i] = attributes.real(table[i].name);
  }
}

/// For elements that a scene has once.
void mark(const Element& element, bool& seen) {
  if (seen) element.fail(fmt::format("a second <{}>", element.name()), "only one");
  seen = true;
}

}  // namespace

Scene load_scene(const Element& experiment, const std::vector<std::string>& state_names,
                 const ModelEntry& model, MengeSequences& sequences, Crowd& crowd) {
  const Attributes root_attributes(experiment,
                                   {optional(text("version", "of the format: 2.0"), "2.0")});
  for (const ModelParameter& constant : model.constants) {
    crowd.model_constants.push_back(constant.initial);
  }
  for (const ModelParameter& parameter : model.parameters) {
    crowd.model_parameter_names.push_back(parameter.name);
  }
  bool common = false;
  bool spatial_query = false;
  std::vector<Profile> profiles;
  std::vector<Element> groups;
  for (const Element& child : experiment.children()) {
    if (child.name() == "Common") {
      mark(child, common);
      child.require_no_children();
      crowd.dt_s = Attributes(child, {optional(number("time_step", "in s", 1e-4, 10), "0.1")})
                       .number("time_step");
    } else if (child.name() == "SpatialQuery") {
      mark(child, spatial_query);
      load_spatial_query(child, crowd);
    } else if (child.name() == "Elevation") {
      if (crowd.elevation) child.fail("a second <Elevation>", "only one");
      child.require_no_children();
      ElevationContext ground{*crowd.parts};
      crowd.elevation = elevation_registry().make(child, ground);
    } else if (child.name() == "AgentProfile") {
      profiles.push_back(load_profile(child, profiles, model, sequences));
    } else if (child.name() == "AgentGroup") {
      groups.push_back(child);
    } else if (child.name() == "ObstacleSet") {
      load_obstacles(child, crowd.obstacles);
    } else if (child.name() == model.tag) {
      load_constants(child, model, crowd.model_constants);
    } else if (!is_model_tag(child.name())) {
      child.fail_unknown(
          "<SpatialQuery>, <Common>, <Elevation>, <AgentProfile>, <AgentGroup>, <ObstacleSet> or a "
          "model's element");
    }
  }
  if (!common) experiment.fail("no <Common>", "one <Common>");
  if (!spatial_query) experiment.fail("no <SpatialQuery>", "one <SpatialQuery>");
  if (profiles.empty()) experiment.fail("no <AgentProfile>", "at least one <AgentProfile>");
  if (groups.empty()) experiment.fail("no <AgentGroup>", "at least one <AgentGroup>");
  GroupContext context{profiles, state_names, crowd.seed, sequences};
  for (const Element& group : groups) load_group(group, context, crowd);
  crowd.obstacles.build();
  Scene scene;
  for (Profile& profile : profiles) scene.profile_modifiers.push_back(std::move(profile.modifiers));
  return scene;
}

}  // namespace throng::crowd
