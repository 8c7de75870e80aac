#include "crowd/navigation/formation.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/geometry/polygon.h"
#include "crowd/elements/number_file.h"

namespace throng::crowd {

namespace {

struct WeightedPosition {
  Eigen::Vector2f place;
  float weight = 1;
};

std::vector<float> read_rest(NumberFile& file) {
  constexpr std::size_t kMaxNumbers = 3000;
  std::vector<float> numbers;
  while (!file.at_end()) {
    if (numbers.size() == kMaxNumbers) {
      file.fail("one more number", fmt::format("at most {} in a formation", kMaxNumbers));
    }
    numbers.push_back(file.real("a coordinate or weight"));
  }
  return numbers;
}

}  // namespace

Formation::Formation(const TextFile& source) {
  NumberFile file(source);
  const int border = file.count("the number of border points", 1, 3);
  const std::vector<float> numbers = read_rest(file);
  // The way may have a weight like the points.
  const std::size_t way_numbers = numbers.size() % 3 == 0 ? 3 : numbers.size() % 3;
  const std::size_t points = numbers.size() / 3 - (way_numbers == 3 ? 1 : 0);
  if (way_numbers == 1 || numbers.size() < 3 || points < static_cast<std::size_t>(border)) {
    file.fail(
        fmt::format("{} numbers after the count", numbers.size()),
        fmt::format("x, y and weight of {} points or more, and x and y of a direction", border));
  }
  const Eigen::Vector2f way(numbers[3 * points], numbers[3 * points + 1]);
  if (way.isZero(0)) file.fail("a direction of 0 0", "a direction");
  const Eigen::Vector2f ahead = way.normalized();
  std::vector<WeightedPosition> all;
  for (std::size_t i = 0; i < points; ++i) {
    const Eigen::Vector2f p(numbers[3 * i], numbers[3 * i + 1]);
    all.push_back({{ahead.dot(p), geometry::cross(ahead, p)}, numbers[3 * i + 2]});
  }
  std::stable_sort(
      all.begin(), all.end(),
      [](const WeightedPosition& a, const WeightedPosition& b) { return a.weight > b.weight; });
  for (const WeightedPosition& each : all) places_.push_back(each.place);
}

FormationGroup::FormationGroup(Formation formation, std::size_t agent_count)
    : formation_(std::move(formation)),
      asked_(agent_count, 0),
      wanted_(agent_count, Eigen::Vector2f::Zero()),
      place_(agent_count, kNone) {
  members_.reserve(agent_count);
  before_.reserve(agent_count);
}

bool FormationGroup::gather(const Crowd& crowd) {
  before_.swap(members_);
  members_.clear();
  for (std::size_t i = 0; i < asked_.size(); ++i) {
    if (asked_[i] != 0 && crowd.agents.present[i] != 0) {
      members_.push_back(static_cast<std::uint32_t>(i));
    }
    asked_[i] = 0;
  }
  return members_ != before_;
}

Eigen::Vector2f FormationGroup::turned(const Eigen::Vector2f& place) const {
  return place.x() * heading_ + place.y() * Eigen::Vector2f(-heading_.y(), heading_.x());
}

Eigen::Vector2f FormationGroup::middle_of_members(const Crowd& crowd) const {
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  for (const std::uint32_t agent : members_) sum += crowd.agents.position[agent];
  return sum / static_cast<float>(members_.size());
}

void FormationGroup::take_places(const Crowd& crowd, const Eigen::Vector2f& middle) {
  for (const std::uint32_t agent : members_) place_[agent] = kNone;
  const std::size_t count = std::min(members_.size(), formation_.places().size());
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2f at = middle + turned(formation_.places()[i]);
    std::uint32_t nearest = members_.front();
    float nearest_sq = std::numeric_limits<float>::infinity();
    for (const std::uint32_t agent : members_) {
      if (place_[agent] != kNone) continue;
      const float distance_sq = (crowd.agents.position[agent] - at).squaredNorm();
      if (distance_sq >= nearest_sq) continue;
      nearest = agent;
      nearest_sq = distance_sq;
    }
    place_[nearest] = static_cast<int>(i);
  }
}

void FormationGroup::before_decisions(Crowd& crowd, Machine&) {
  const bool changed = gather(crowd);
  if (members_.empty()) return;
  const auto count = static_cast<float>(members_.size());
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  for (const std::uint32_t agent : members_) sum += wanted_[agent];
  velocity_ = sum / count;
  constexpr float kStanding = 1e-3F;  // m/s
  if (velocity_.norm() > kStanding) heading_ = velocity_.normalized();

  // The middle of the places that are taken is where the middle of the members is.
  const std::size_t taken = std::min(members_.size(), formation_.places().size());
  const auto& places = formation_.places();
  const Eigen::Vector2f middle_place =
      std::accumulate(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(taken),
                      Eigen::Vector2f(Eigen::Vector2f::Zero())) /
      static_cast<float>(taken);
  origin_ = middle_of_members(crowd) - turned(middle_place);
  if (changed) take_places(crowd, origin_);
}

PreferredVelocity FormationGroup::lead(const Crowd& crowd, std::size_t agent,
                                       const PreferredVelocity& alone) {
  constexpr float kCatchUpS = 1;      // in which somebody would be at its place
  constexpr float kHaste = 1.5F;      // how much faster than alone it goes for that
  constexpr float kStanding = 1e-6F;  // m/s
  const bool was_member =
      std::binary_search(members_.begin(), members_.end(), static_cast<std::uint32_t>(agent));
  asked_[agent] = 1;
  wanted_[agent] = alone.speed * alone.direction;
  if (!was_member || place_[agent] == kNone || alone.speed <= 0) return alone;
  const Eigen::Vector2f place =
      origin_ + turned(formation_.places()[static_cast<std::size_t>(place_[agent])]);
  const Eigen::Vector2f velocity = velocity_ + (place - crowd.agents.position[agent]) / kCatchUpS;
  const float speed = velocity.norm();
  if (speed <= kStanding) return {alone.direction, 0};
  const float max_speed_mps =
      std::min(kHaste * alone.speed, crowd.agents[Property::max_speed][agent]);
  return {velocity / speed, std::min(speed, max_speed_mps)};
}

namespace {

class InFormation : public VelModifier {
 public:
  explicit InFormation(FormationGroup& group) : group_(group) {}
  void modify(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) const override {
    preferred = group_.lead(crowd, agent, preferred);
  }

 private:
  FormationGroup& group_;  // one of the behavior's processes
};

std::unique_ptr<VelModifier> make_formation(const Element& element, const Attributes& attributes,
                                            BehaviorContext& context) {
  auto group = std::make_unique<FormationGroup>(
      Formation(element.text_file(attributes.text("file_name"))), context.agent_count);
  auto made = std::make_unique<InFormation>(*group);
  context.processes.push_back(std::move(group));
  return made;
}

}  // namespace

std::vector<VelModifierRegistry::Entry> formation_modifiers() {
  return {{"formation",
           "those with this modifier walk in a formation",
           {text("file_name", "a file of positions: see the documentation")},
           make_formation}};
}

}  // namespace throng::crowd
