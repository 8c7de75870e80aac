#include "crowd/population/social_groups.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"

namespace throng::crowd {

namespace {

constexpr std::size_t kMinGroupSize = 2;  // members of a group
constexpr float kMaxGroupDistance = 5;    // m, between those who are put into one group
constexpr float kRelaxationS = 0.5F;      // of the social force model (Helbing, Molnar 1995)

/// Agents without a group, by square cells as wide as a group may be.
class Loners {
 public:
  Loners(const Agents& agents, std::size_t first, std::size_t count) : agents_(agents) {
    for (std::size_t i = first; i < first + count; ++i)
      cells_[cell(agents.position[i])].push_back(i);
  }

  bool has(std::size_t agent) const {
    const auto found = cells_.find(cell(agents_.position[agent]));
    return std::find(found->second.begin(), found->second.end(), agent) != found->second.end();
  }

  void remove(std::size_t agent) { std::erase(cells_[cell(agents_.position[agent])], agent); }

  /// Those near `agent` in its state, the nearest first, ties by id; without itself.
  std::vector<std::size_t> near(std::size_t agent) const {
    const Eigen::Vector2f& place = agents_.position[agent];
    std::vector<std::pair<float, std::size_t>> found;
    for (const float dx : {-kMaxGroupDistance, 0.0F, kMaxGroupDistance}) {
      for (const float dy : {-kMaxGroupDistance, 0.0F, kMaxGroupDistance}) {
        const auto bucket = cells_.find(cell(place + Eigen::Vector2f(dx, dy)));
        if (bucket == cells_.end()) continue;
        for (const std::size_t other : bucket->second) {
          const float apart = (agents_.position[other] - place).norm();
          const bool fits = other != agent && agents_.state[other] == agents_.state[agent];
          if (fits && apart <= kMaxGroupDistance) found.emplace_back(apart, other);
        }
      }
    }
    std::sort(found.begin(), found.end());
    std::vector<std::size_t> ids;
    ids.reserve(found.size());
    for (const auto& [apart, other] : found) ids.push_back(other);
    return ids;
  }

 private:
  static std::int64_t cell(const Eigen::Vector2f& place) {
    const auto column = static_cast<std::int64_t>(std::floor(place.x() / kMaxGroupDistance));
    const auto row = static_cast<std::int64_t>(std::floor(place.y() / kMaxGroupDistance));
    return row * (std::int64_t{1} << 32) + column;
  }

  const Agents& agents_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

std::size_t draw_size(const SocialGroupsSpec& spec, Random& random) {
  const double total = std::accumulate(spec.weights.begin(), spec.weights.end(), 0.0);
  double left = random.uniform() * total;
  std::size_t size = kMinGroupSize;
  for (const double weight : spec.weights) {
    if (left < weight) break;
    left -= weight;
    ++size;
  }
  return std::min(size, kMinGroupSize + spec.weights.size() - 1);
}

void join(Crowd& crowd, const std::vector<std::size_t>& members) {
  Agents& agents = crowd.agents;
  std::vector<float>& speed = agents[Property::pref_speed];
  float slowest = speed[members.front()];
  for (const std::size_t member : members) slowest = std::min(slowest, speed[member]);
  std::vector<std::uint32_t> ids;
  for (const std::size_t member : members) {
    agents.social_group[member] = static_cast<std::int32_t>(crowd.social_groups.size());
    speed[member] = slowest;
    ids.push_back(static_cast<std::uint32_t>(member));
  }
  std::sort(ids.begin(), ids.end());
  crowd.social_groups.push_back(std::move(ids));
}

class SocialGroupForces : public VelModifier {
 public:
  explicit SocialGroupForces(const SocialGroupsSpec& spec) : spec_(spec) {}

  void modify(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) const override {
    const Agents& agents = crowd.agents;
    const std::int32_t group = agents.social_group[agent];
    if (group < 0 || preferred.speed <= 0) return;
    const std::vector<std::uint32_t>& members = crowd.social_groups[group];
    Eigen::Vector2f sum = Eigen::Vector2f::Zero();
    int others = 0;
    Eigen::Vector2f spacing = Eigen::Vector2f::Zero();
    for (const std::uint32_t member : members) {
      if (member == agent || !walks_along(agents, agent, member)) continue;
      sum += agents.position[member];
      ++others;
      spacing += away_from(agents, agent, member);
    }
    if (others == 0) return;
    const Eigen::Vector2f to_others = sum / static_cast<float>(others) - agents.position[agent];
    const Eigen::Vector2f force =
        gaze(agents, agent, preferred, to_others) +
        progress(agents, agent, preferred) * cohesion(agents.position[agent], sum, others) +
        spec_.spacing * spacing;
    Eigen::Vector2f wanted = preferred.speed * preferred.direction + kRelaxationS * force;
    // Nobody stops for the group altogether.
    const float along = wanted.dot(preferred.direction);
    const float min_progress_mps = kMinProgress * preferred.speed;
    if (along < min_progress_mps) wanted += (min_progress_mps - along) * preferred.direction;
    const float speed = wanted.norm();
    preferred.direction = wanted / speed;
    // Members that have fallen behind may hurry a little.
    constexpr float kHurry = 1.3F;
    preferred.speed = std::min(speed, kHurry * preferred.speed);
  }

 private:
  static constexpr float kMinProgress = 0.3F;  // of the preferred speed, along the path

  /// Members that are elsewhere, or in another state, are not waited for.
  static bool walks_along(const Agents& agents, std::size_t agent, std::uint32_t member) {
    constexpr float kLost = 15;  // m
    return agents.present[member] != 0 && agents.state[member] == agents.state[agent] &&
           (agents.position[member] - agents.position[agent]).squaredNorm() < kLost * kLost;
  }

  /// Slows who would have to turn the head by more than 90 degrees to see the others.
  Eigen::Vector2f gaze(const Agents& agents, std::size_t agent, const PreferredVelocity& preferred,
                       const Eigen::Vector2f& to_others) const {
    const float angle = std::abs(std::atan2(geometry::cross(preferred.direction, to_others),
                                            preferred.direction.dot(to_others)));
    const float turn = std::max(0.0F, angle - 0.5F * std::numbers::pi_v<float>);
    return -spec_.gaze * turn * agents.velocity[agent];
  }

  /// Share of the cohesion: 1 for members that get ahead along the path, down to 0 for those that
  /// do not. Two members whose paths lead around an obstacle on different sides would hold each
  /// other there for ever.
  static float progress(const Agents& agents, std::size_t agent,
                        const PreferredVelocity& preferred) {
    const float along = preferred.direction.dot(agents.velocity[agent]);
    return std::clamp(along / (kMinProgress * preferred.speed), 0.0F, 1.0F);
  }

  /// Towards the group's center of mass (its own place included), when farther than a group of its
  /// size is wide: (N - 1) / 2 m. Sets in over some centimeters, so that nobody trembles there.
  Eigen::Vector2f cohesion(const Eigen::Vector2f& place, const Eigen::Vector2f& sum,
                           int others) const {
    const Eigen::Vector2f way = (sum + place) / static_cast<float>(others + 1) - place;
    const float distance = way.norm();
    constexpr float kSetsIn = 0.3F;  // m
    const float beyond = distance - 0.5F * static_cast<float>(others);
    if (beyond <= 0) return Eigen::Vector2f::Zero();
    return spec_.cohesion * std::min(1.0F, beyond / kSetsIn) * (way / distance);
  }

  /// A unit vector away from who is nearer than touching distance (0.8 m, or the bodies).
  static Eigen::Vector2f away_from(const Agents& agents, std::size_t agent, std::uint32_t member) {
    constexpr float kElbowRoom = 0.8F;  // m
    const std::vector<float>& radius = agents[Property::radius];
    const Eigen::Vector2f way = agents.position[agent] - agents.position[member];
    const float distance = way.norm();
    const float room = std::max(kElbowRoom, radius[agent] + radius[member] + 0.1F);
    if (distance >= room || distance <= 0) return Eigen::Vector2f::Zero();
    return way / distance;
  }

  SocialGroupsSpec spec_;
};

}  // namespace

AttributeTable social_groups_attributes() {
  return {optional(number("share", "of the people who walk in groups", 0, 1), "0.6"),
          optional(number("pairs", "weight of groups of two", 0, 1e6), "0.7"),
          optional(number("threes", "weight of groups of three", 0, 1e6), "0.2"),
          optional(number("fours", "weight of groups of four", 0, 1e6), "0.1"),
          optional(number("gaze", "how much they slow to see each other", 0, 100), "4"),
          optional(number("cohesion", "how much they draw near, m/s^2", 0, 100), "3"),
          optional(number("spacing", "how much they keep off, m/s^2", 0, 100), "1")};
}

SocialGroupsSpec load_social_groups(const Element& element) {
  element.require_no_children();
  const Attributes attributes(element, social_groups_attributes());
  SocialGroupsSpec spec;
  spec.share = attributes.number("share");
  spec.weights = {attributes.number("pairs"), attributes.number("threes"),
                  attributes.number("fours")};
  if (spec.weights[0] + spec.weights[1] + spec.weights[2] <= 0) {
    element.fail("weights of 0", "a weight above 0 for some size of groups");
  }
  spec.gaze = attributes.real("gaze");
  spec.cohesion = attributes.real("cohesion");
  spec.spacing = attributes.real("spacing");
  return spec;
}

void form_social_groups(const SocialGroupsSpec& spec, std::size_t first, std::size_t count,
                        std::uint64_t seed, Crowd& crowd) {
  Loners loners(crowd.agents, first, count);
  std::vector<std::pair<std::uint32_t, std::size_t>> order;  // at random
  for (std::size_t i = first; i < first + count; ++i) {
    order.emplace_back(Random(seed, Stream::crowd_groups, i).bits(), i);
  }
  std::sort(order.begin(), order.end());
  const double wanted = spec.share * static_cast<double>(count);
  double grouped = 0;
  for (const auto& [ticket, agent] : order) {
    if (grouped + 1 >= wanted) return;
    if (!loners.has(agent)) continue;
    Random random(seed, Stream::crowd_groups, (std::uint64_t{1} << 63) | agent);
    const std::size_t size = draw_size(spec, random);
    std::vector<std::size_t> members = loners.near(agent);
    if (members.empty()) continue;
    members.resize(std::min(members.size(), size - 1));
    members.push_back(agent);
    for (const std::size_t member : members) loners.remove(member);
    join(crowd, members);
    grouped += static_cast<double>(members.size());
  }
}

void form_arriving_groups(const SocialGroupsSpec& spec, std::size_t first,
                          std::vector<double>& arrival_s, std::uint64_t seed, Crowd& crowd) {
  // Somebody starts a group with the chance that gives the share, given the mean size.
  const double weights = spec.weights[0] + spec.weights[1] + spec.weights[2];
  const double mean_size =
      (2 * spec.weights[0] + 3 * spec.weights[1] + 4 * spec.weights[2]) / weights;
  const double chance = spec.share / (spec.share + mean_size * (1 - spec.share));
  const Agents& agents = crowd.agents;
  for (std::size_t i = 0; i < arrival_s.size();) {
    Random random(seed, Stream::crowd_groups, first + i);
    std::vector<std::size_t> members = {first + i};
    if (random.uniform() < chance) {
      const std::size_t size = draw_size(spec, random);
      while (members.size() < size && i + members.size() < arrival_s.size() &&
             agents.state[members.back() + 1] == agents.state[first + i]) {
        members.push_back(members.back() + 1);
      }
      std::fill_n(arrival_s.begin() + static_cast<std::ptrdiff_t>(i), members.size(), arrival_s[i]);
      if (members.size() >= kMinGroupSize) join(crowd, members);
    }
    i += members.size();
  }
}

std::unique_ptr<VelModifier> make_social_group_modifier(const SocialGroupsSpec& spec) {
  return std::make_unique<SocialGroupForces>(spec);
}

}  // namespace throng::crowd
