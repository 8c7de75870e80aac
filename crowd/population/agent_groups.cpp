#include "crowd/population/agent_groups.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "crowd/motion/facing.h"
#include "crowd/population/arrivals.h"
#include "crowd/population/generators.h"

namespace throng::crowd {

namespace {

class OneProfile : public ProfileSelector {
 public:
  explicit OneProfile(std::size_t profile) : profile_(profile) {}
  std::size_t select(std::size_t) override { return profile_; }

 private:
  std::size_t profile_;
};

/// One of several profiles, by weight.
class ProfileLottery : public ProfileSelector {
 public:
  struct Ticket {
    std::size_t profile = 0;
    double weight = 1;
  };

  ProfileLottery(std::vector<Ticket> tickets, std::uint64_t seed,
                 std::shared_ptr<MengeRandom> sequence)
      : tickets_(std::move(tickets)), seed_(seed), sequence_(std::move(sequence)) {
    for (const Ticket& ticket : tickets_) total_ += ticket.weight;
  }

  std::size_t select(std::size_t agent) override {
    double left = draw(agent) * total_;
    for (const Ticket& ticket : tickets_) {
      if (left < ticket.weight) return ticket.profile;
      left -= ticket.weight;
    }
    return tickets_.back().profile;
  }

 private:
  double draw(std::size_t agent) {
    if (sequence_) return sequence_->uniform();
    constexpr std::uint64_t kWhichProfile = std::uint64_t{1} << 63;  // apart from properties
    return Random(seed_, Stream::crowd_profile, kWhichProfile | agent).uniform();
  }

  std::vector<Ticket> tickets_;
  double total_ = 0;
  std::uint64_t seed_;
  std::shared_ptr<MengeRandom> sequence_;
};

class OneState : public StateSelector {
 public:
  explicit OneState(std::uint8_t state) : state_(state) {}
  std::uint8_t select(std::size_t) override { return state_; }

 private:
  std::uint8_t state_;
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

AttributeSpec profile_name() { return text("name", "the name of a profile"); }

std::unique_ptr<ProfileSelector> make_one_profile(const Element& element,
                                                  const Attributes& attributes,
                                                  GroupContext& context) {
  element.require_no_children();
  return std::make_unique<OneProfile>(
      require_profile(element, attributes.text("name"), context.profiles));
}

template <bool kWeighted>
std::unique_ptr<ProfileSelector> make_lottery(const Element& element, const Attributes&,
                                              GroupContext& context) {
  AttributeTable table = {profile_name()};
  if (kWeighted) table.push_back(number("weight", "share of the agents, above 0", 1e-6, 1e6));
  std::vector<ProfileLottery::Ticket> tickets;
  for (const Element& child : element.children()) {
    if (child.name() != "Profile") child.fail_unknown("<Profile>");
    child.require_no_children();
    const Attributes choice(child, table);
    tickets.push_back({require_profile(child, choice.text("name"), context.profiles),
                       kWeighted ? choice.number("weight") : 1});
  }
  if (tickets.empty()) element.fail("no profiles", "at least one <Profile>");
  return std::make_unique<ProfileLottery>(std::move(tickets), context.seed,
                                          context.sequences.next());
}

std::unique_ptr<StateSelector> make_one_state(const Element& element, const Attributes& attributes,
                                              GroupContext& context) {
  element.require_no_children();
  const std::vector<std::string>& names = context.state_names;
  const auto found = std::find(names.begin(), names.end(), attributes.text("name"));
  if (found == names.end()) {
    element.fail_attribute("name", in_quotes(attributes.text("name")),
                           fmt::format("the name of a state: {}", fmt::join(names, ", ")));
  }
  return std::make_unique<OneState>(static_cast<std::uint8_t>(found - names.begin()));
}

std::optional<Element> at_most_one(const Element& group, std::string_view name) {
  std::optional<Element> found;
  for (const Element& child : group.children()) {
    if (child.name() != name) continue;
    if (found) child.fail(fmt::format("a second <{}>", name), fmt::format("one <{}>", name));
    found = child;
  }
  return found;
}

/// The one child of an <AgentGroup> with this name.
Element only(const Element& group, std::string_view name) {
  const std::optional<Element> found = at_most_one(group, name);
  if (!found) group.fail(fmt::format("no <{}>", name), fmt::format("exactly one <{}>", name));
  return *found;
}

/// Orientation of a group's standing agents; null: their heading, as in Menge.
std::unique_ptr<Facing> make_facing(const Element& group, const GroupContext& context,
                                    const Crowd& crowd) {
  FacingContext facing{context.seed};
  if (const std::optional<Element> given = at_most_one(group, "Facing")) {
    return facing_registry().make(*given, facing);
  }
  return crowd.compat == Compat::none ? any_facing(context.seed) : nullptr;
}

void add_agents(const std::vector<Eigen::Vector2f>& places, ProfileSelector& profile,
                StateSelector& state, const Facing* facing, const GroupContext& context,
                Crowd& crowd) {
  Agents& agents = crowd.agents;
  const std::size_t first = agents.count();
  agents.resize(first + places.size(), context.profiles.front().model_parameters.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t agent = first + i;
    const std::size_t chosen = profile.select(agent);
    apply_profile(context.profiles[chosen], context.seed, agent, agents);
    agents.profile[agent] = static_cast<std::uint32_t>(chosen);
    agents.position[agent] = places[i];
    agents.state[agent] = state.select(agent);
    if (facing != nullptr) agents.facing[agent] = facing->direction(agent, places[i]);
  }
}

}  // namespace

const ProfileSelectorRegistry& profile_selector_registry() {
  static const ProfileSelectorRegistry kRegistry({{
      {"const", "one profile for all", {profile_name()}, make_one_profile},
      {"random", "any of its <Profile> children", {}, make_lottery<false>},
      {"weighted", "any of its <Profile> children, by weight", {}, make_lottery<true>},
  }});
  return kRegistry;
}

const StateSelectorRegistry& state_selector_registry() {
  static const StateSelectorRegistry kRegistry(
      {{{"const", "one state for all", {text("name", "the name of a state")}, make_one_state}}});
  return kRegistry;
}

void load_group(const Element& group, GroupContext& context, Crowd& crowd,
                std::vector<std::unique_ptr<Process>>& processes) {
  const Attributes no_attributes(group, {});
  const auto profile = profile_selector_registry().make(only(group, "ProfileSelector"), context);
  const auto state = state_selector_registry().make(only(group, "StateSelector"), context);
  const std::unique_ptr<Facing> facing = make_facing(group, context, crowd);
  const std::size_t first = crowd.agents.count();
  const std::optional<Element> arrivals = at_most_one(group, "Arrivals");
  std::vector<Eigen::Vector2f> places;
  for (const Element& child : group.children()) {
    if (child.name() == "Generator") {
      const std::vector<Eigen::Vector2f> more = generate_positions(
          child, {crowd, context.seed, first + places.size()}, context.sequences);
      places.insert(places.end(), more.begin(), more.end());
      // Each generator's agents are made at once: the order in which compatible runs draw.
      if (!arrivals) add_agents(more, *profile, *state, facing.get(), context, crowd);
    } else if (child.name() != "ProfileSelector" && child.name() != "StateSelector" &&
               child.name() != "Arrivals" && child.name() != "Facing") {
      child.fail_unknown("<ProfileSelector>, <StateSelector>, <Generator>, <Facing> or <Arrivals>");
    }
  }
  if (places.empty()) group.fail("no <Generator>", "at least one <Generator>");
  if (!arrivals) {
    if (context.social_groups) {
      form_social_groups(*context.social_groups, first, places.size(), context.seed, crowd);
    }
    return;
  }
  ArrivalPlan plan = load_arrivals(*arrivals, places, first, context.seed);
  std::vector<Eigen::Vector2f> entrances(plan.time_s.size());
  for (std::size_t i = 0; i < entrances.size(); ++i) entrances[i] = places[i % places.size()];
  add_agents(entrances, *profile, *state, facing.get(), context, crowd);
  if (context.social_groups && plan.come_in_groups) {
    form_arriving_groups(*context.social_groups, first, plan.time_s, context.seed, crowd);
  }
  processes.push_back(make_arrivals(std::move(plan), crowd));
}

}  // namespace throng::crowd
