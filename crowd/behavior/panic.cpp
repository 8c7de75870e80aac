#include "crowd/behavior/panic.h"

#include <algorithm>
#include <cmath>

#include "base/compute/random.h"

namespace throng::crowd {

namespace {

/// The places of those in panic, sorted by square cells as wide as the radius.
class Alarmed {
 public:
  void gather(const Agents& agents, float cell_m) {
    cell_m_ = cell_m;
    entries_.clear();
    entries_.reserve(agents.count());
    for (std::size_t i = 0; i < agents.count(); ++i) {
      if (agents.present[i] == 0 || agents.panicked[i] == 0) continue;
      entries_.push_back({cell(agents.position[i], 0, 0), agents.position[i]});
    }
    // The order within a cell does not matter: those in it are only counted.
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.cell < b.cell; });
  }

  bool empty() const { return entries_.empty(); }

  int count_near(const Eigen::Vector2f& place, float radius_m) const {
    int count = 0;
    for (int row = -1; row <= 1; ++row) {
      for (int column = -1; column <= 1; ++column) {
        const std::int64_t wanted = cell(place, column, row);
        auto entry =
            std::lower_bound(entries_.begin(), entries_.end(), wanted,
                             [](const Entry& e, std::int64_t key) { return e.cell < key; });
        for (; entry != entries_.end() && entry->cell == wanted; ++entry) {
          if ((entry->place - place).squaredNorm() < radius_m * radius_m) ++count;
        }
      }
    }
    return count;
  }

 private:
  struct Entry {
    std::int64_t cell;
    Eigen::Vector2f place;
  };

  std::int64_t cell(const Eigen::Vector2f& place, int column, int row) const {
    const auto x = static_cast<std::int64_t>(std::floor(place.x() / cell_m_)) + column;
    const auto y = static_cast<std::int64_t>(std::floor(place.y() / cell_m_)) + row;
    return y * (std::int64_t{1} << 32) + x;
  }

  float cell_m_ = 1;
  std::vector<Entry> entries_;
};

class Contagion : public Process {
 public:
  Contagion(const PanicSpec& spec, std::uint64_t seed) : spec_(spec), seed_(seed) {}

  void after_motion(Crowd& crowd, Machine&) override {
    Agents& agents = crowd.agents;
    alarmed_.gather(agents, spec_.radius_m);
    if (alarmed_.empty()) return;
    for (std::size_t i = 0; i < agents.count(); ++i) {
      if (agents.present[i] == 0) continue;
      const bool panicked = agents.panicked[i] != 0;
      const double rate =
          panicked ? spec_.recovery_per_s
                   : spec_.rate_per_s * alarmed_.count_near(agents.position[i], spec_.radius_m);
      if (rate <= 0) continue;
      const double chance = -std::expm1(-rate * crowd.dt_s);
      const std::uint64_t key = (static_cast<std::uint64_t>(i) << 32) | (crowd.step & 0xffffffffU);
      if (Random(seed_, Stream::crowd_panic, key).uniform() < chance) {
        agents.panicked[i] = panicked ? 0 : 1;
      }
    }
  }

 private:
  PanicSpec spec_;
  std::uint64_t seed_;
  Alarmed alarmed_;
};

class Hurry : public VelModifier {
 public:
  explicit Hurry(float factor) : factor_(factor) {}
  void modify(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) const override {
    if (crowd.agents.panicked[agent] == 0) return;
    const float max_speed_mps = std::max(preferred.speed, crowd.agents[Property::max_speed][agent]);
    preferred.speed = std::min(factor_ * preferred.speed, max_speed_mps);
  }

 private:
  float factor_;
};

class Panicked : public Condition {
 public:
  bool holds(const Crowd& crowd, std::size_t agent) const override {
    return crowd.agents.panicked[agent] != 0;
  }
};

template <int kPanicked>
class SetPanic : public Action {
 public:
  void enter(Crowd& crowd, std::size_t agent) override { crowd.agents.panicked[agent] = kPanicked; }
  void leave(Crowd&, std::size_t) override {}
};

template <int kPanicked>
std::unique_ptr<Action> make_set_panic(const Element&, const Attributes&, BehaviorContext&) {
  return std::make_unique<SetPanic<kPanicked>>();
}

std::unique_ptr<Condition> make_panicked(const Element& element, const Attributes&,
                                         BehaviorContext&) {
  element.require_no_children();
  return std::make_unique<Panicked>();
}

}  // namespace

AttributeTable panic_attributes() {
  return {
      optional(number("radius", "how far panic is noticed, in m", 0.1, 100), "3"),
      optional(number("rate", "chance in a second to catch it from each nearby", 0, 1e3), "0.2"),
      optional(number("recovery", "chance in a second to calm down", 0, 1e3), "0"),
      optional(number("speed_factor", "of the preferred speed in panic", 0, 10), "1.5")};
}

PanicSpec load_panic(const Element& element) {
  element.require_no_children();
  const Attributes attributes(element, panic_attributes());
  return {attributes.real("radius"), attributes.number("rate"), attributes.number("recovery"),
          attributes.real("speed_factor")};
}

std::unique_ptr<Process> make_panic_contagion(const PanicSpec& spec, std::uint64_t seed) {
  return std::make_unique<Contagion>(spec, seed);
}

std::unique_ptr<VelModifier> make_panic_modifier(const PanicSpec& spec) {
  return std::make_unique<Hurry>(spec.speed_factor);
}

std::vector<ConditionRegistry::Entry> panic_conditions() {
  return {{"panicked", "the agent is in panic", {}, make_panicked}};
}

std::vector<ActionRegistry::Entry> panic_actions() {
  return {{"panic", "the agent panics", {}, make_set_panic<1>},
          {"calm", "the agent's panic ends", {}, make_set_panic<0>}};
}

}  // namespace throng::crowd
