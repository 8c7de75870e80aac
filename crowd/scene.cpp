#include "crowd/scene.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "crowd/navigation/elevation.h"
#include "crowd/navigation/obstacle_sets.h"
#include "crowd/population/agent_groups.h"
#include "crowd/population/profile.h"

namespace throng::crowd {

namespace {

void load_spatial_query(const Element& element, Crowd& crowd) {
  element.require_no_children();
  const Attributes attributes(element, spatial_query_attributes());
  crowd.test_visibility = attributes.boolean("test_visibility");
}

/// Reads a model's element in the scene, which holds for all agents.
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

AttributeTable spatial_query_attributes() {
  return {word("type", {"kd-tree", "nav_mesh"}, "neighbor search; not used: a grid serves"),
          optional(text("file_name", "a .nav file; not used")),
          optional(boolean("test_visibility", "1: walls hide neighbors"), "0")};
}

Scene load_scene(const Element& experiment, const std::vector<std::string>& state_names,
                 const ModelEntry& model, MengeSequences& sequences, Crowd& crowd) {
  const Attributes root_attributes(experiment,
                                   {optional(text("version", "of the format: 2.0"), "2.0")});
  for (const ModelParameter& parameter : model.parameters) {
    crowd.model_parameter_names.push_back(parameter.name);
  }
  bool common = false;
  bool spatial_query = false;
  std::vector<Profile> profiles;
  std::vector<Element> groups;
  ObstacleSets obstacles;
  std::optional<SocialGroupsSpec> social_groups;
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
    } else if (child.name() == "SocialGroups") {
      if (social_groups) child.fail("a second <SocialGroups>", "only one");
      social_groups = load_social_groups(child);
    } else if (child.name() == "ObstacleSet") {
      obstacles.load(child, crowd);
    } else if (child.name() == model.tag) {
      load_constants(child, model, crowd.model_constants);
    } else if (!is_model_tag(child.name())) {
      child.fail_unknown(
          "<SpatialQuery>, <Common>, <Elevation>, <AgentProfile>, <AgentGroup>, <SocialGroups>, "
          "<ObstacleSet> or a model's element");
    }
  }
  if (!common) experiment.fail("no <Common>", "one <Common>");
  if (!spatial_query) experiment.fail("no <SpatialQuery>", "one <SpatialQuery>");
  if (profiles.empty()) experiment.fail("no <AgentProfile>", "at least one <AgentProfile>");
  if (groups.empty()) experiment.fail("no <AgentGroup>", "at least one <AgentGroup>");
  Scene scene;
  GroupContext context{profiles, state_names, crowd.seed, sequences, social_groups};
  crowd.obstacles.build();
  for (const Element& group : groups) {
    scene.first_agents.push_back(crowd.agents.count());
    load_group(group, context, crowd, scene.processes);
  }
  if (social_groups) scene.modifiers.push_back(make_social_group_modifier(*social_groups));
  obstacles.report(crowd);
  for (Profile& profile : profiles) scene.profile_modifiers.push_back(std::move(profile.modifiers));
  return scene;
}

}  // namespace throng::crowd
