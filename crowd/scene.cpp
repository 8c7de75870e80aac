#include "crowd/scene.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "crowd/generators.h"
#include "crowd/profile.h"

namespace throng::crowd {

namespace {

/// Which of the profiles each agent of a group has.
struct ProfileLottery {
  std::vector<std::size_t> profiles;
  std::vector<double> weights;

  std::size_t draw(Random random) const {
    double total = 0;
    for (const double weight : weights) total += weight;
    double left = random.uniform() * total;
    for (std::size_t i = 0; i + 1 < profiles.size(); ++i) {
      if (left < weights[i]) return profiles[i];
      left -= weights[i];
    }
    return profiles.back();
  }
};

std::size_t require_profile(const Element& element, const std::string& name,
                            const std::vector<Profile>& profiles) {
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    if (profiles[i].name == name) return i;
    known.push_back(profiles[i].name);
  }
  element.fail_attribute("name", in_quotes(name),
                         fmt::format("the name of a profile: {}", fmt::join(known, ", ")));
}

ProfileLottery load_profile_selector(const Element& element, const std::vector<Profile>& profiles) {
  const std::vector<std::string_view> types = {"const", "random", "weighted"};
  ProfileLottery lottery;
  if (element.attribute("type").value_or("") == "const") {
    element.require_no_children();
    const Attributes attributes(element, {word("type", types, "how profiles are chosen"),
                                          text("name", "the name of a profile")});
    lottery.profiles.push_back(require_profile(element, attributes.text("name"), profiles));
    lottery.weights.push_back(1);
    return lottery;
  }
  const Attributes attributes(element, {word("type", types, "how profiles are chosen")});
  AttributeTable table = {text("name", "the name of a profile")};
  if (attributes.text("type") == "weighted") {
    table.push_back(number("weight", "share of the agents, above 0", 1e-6, 1e6));
  }
  for (const Element& child : element.children()) {
    if (child.name() != "Profile") child.fail_unknown("<Profile>");
    child.require_no_children();
    const Attributes choice(child, table);
    lottery.profiles.push_back(require_profile(child, choice.text("name"), profiles));
    lottery.weights.push_back(table.size() > 1 ? choice.number("weight") : 1);
  }
  if (lottery.profiles.empty()) element.fail("no profiles", "at least one <Profile>");
  return lottery;
}

std::uint8_t load_state_selector(const Element& element,
                                 const std::vector<std::string>& state_names) {
  element.require_no_children();
  const Attributes attributes(element, {word("type", {"const"}, "how states are chosen"),
                                        text("name", "the name of a state")});
  const auto found = std::find(state_names.begin(), state_names.end(), attributes.text("name"));
  if (found == state_names.end()) {
    element.fail_attribute("name", in_quotes(attributes.text("name")),
                           fmt::format("the name of a state: {}", fmt::join(state_names, ", ")));
  }
  return static_cast<std::uint8_t>(found - state_names.begin());
}

/// The one child of an <AgentGroup> with this name.
Element group_child(const Element& group, std::string_view name) {
  std::optional<Element> found;
  for (const Element& child : group.children()) {
    if (child.name() != name) continue;
    if (found) child.fail(fmt::format("a second <{}>", name), fmt::format("one <{}>", name));
    found = child;
  }
  if (!found) group.fail(fmt::format("no <{}>", name), fmt::format("exactly one <{}>", name));
  return *found;
}

void load_group(const Element& group, const std::vector<Profile>& profiles,
                const std::vector<std::string>& state_names, std::uint64_t seed, Crowd& crowd) {
  const Attributes no_attributes(group, {});
  const ProfileLottery lottery =
      load_profile_selector(group_child(group, "ProfileSelector"), profiles);
  const std::uint8_t state = load_state_selector(group_child(group, "StateSelector"), state_names);
  bool any_generator = false;
  for (const Element& child : group.children()) {
    if (child.name() == "Generator") {
      any_generator = true;
      Agents& agents = crowd.agents;
      const std::size_t first = agents.count();
      const std::vector<Eigen::Vector2f> places = generate_places(child, seed, first);
      agents.resize(first + places.size(), profiles.front().model_parameters.size());
      for (std::size_t i = 0; i < places.size(); ++i) {
        const std::size_t agent = first + i;
        constexpr std::uint64_t kWhichProfile = std::uint64_t{1} << 63;  // apart from properties
        const std::size_t profile =
            lottery.draw(Random(seed, Stream::crowd_profile, kWhichProfile | agent));
        apply_profile(profiles[profile], seed, agent, agents);
        agents.position[agent] = places[i];
        agents.state[agent] = state;
      }
    } else if (child.name() != "ProfileSelector" && child.name() != "StateSelector") {
      child.fail_unknown("<ProfileSelector>, <StateSelector> or <Generator>");
    }
  }
  if (!any_generator) group.fail("no <Generator>", "at least one <Generator>");
}

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

void load_spatial_query(const Element& element) {
  element.require_no_children();
  const Attributes attributes(
      element, {word("type", {"kd-tree"}, "how neighbours are found; a grid serves here"),
                optional(boolean("test_visibility", "1: walls hide neighbours"), "0")});
  if (attributes.boolean("test_visibility")) {
    element.fail_attribute("test_visibility", "1", "0 (walls that hide neighbours are not known)");
  }
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

void load_scene(const Element& experiment, const std::vector<std::string>& state_names,
                const ModelEntry& model, std::uint64_t seed, Crowd& crowd) {
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
      load_spatial_query(child);
    } else if (child.name() == "Elevation") {
      const Attributes flat(child, {word("type", {"flat"}, "only flat ground is known")});
    } else if (child.name() == "AgentProfile") {
      profiles.push_back(load_profile(child, profiles, model));
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
  for (const Element& group : groups) load_group(group, profiles, state_names, seed, crowd);
  crowd.obstacles.build();
}

}  // namespace throng::crowd
