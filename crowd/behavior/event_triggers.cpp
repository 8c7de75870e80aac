#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "crowd/behavior/events.h"

namespace throng::crowd {

namespace {

/// Waits for a call from outside.
class External : public EventTrigger {
 public:
  explicit External(std::shared_ptr<Signal> signal) : signal_(std::move(signal)) {}
  bool fires(const Crowd&) override { return std::exchange(signal_->raised, false); }

 private:
  std::shared_ptr<Signal> signal_;
};

/// Watches how many agents are in a state.
class StatePopulation : public EventTrigger {
 public:
  enum class Watch { on_increase, on_decrease, rise_to, drop_to, while_higher, while_lower };

  StatePopulation(std::uint8_t state, Watch watch, std::size_t threshold)
      : state_(state), watch_(watch), threshold_(threshold) {}

  bool fires(const Crowd& crowd) override {
    const std::size_t now = population(crowd);
    // The initial number is no change.
    const std::size_t before = before_.value_or(now);
    before_ = now;
    switch (watch_) {
      case Watch::on_increase:
        return now > before;
      case Watch::on_decrease:
        return now < before;
      case Watch::rise_to:
        return before < threshold_ && now >= threshold_;
      case Watch::drop_to:
        return before > threshold_ && now <= threshold_;
      case Watch::while_higher:
        return now > threshold_;
      case Watch::while_lower:
        break;
    }
    return now < threshold_;
  }

 private:
  std::size_t population(const Crowd& crowd) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < crowd.agents.count(); ++i) {
      if (crowd.agents.present[i] != 0 && crowd.agents.state[i] == state_) ++count;
    }
    return count;
  }

  std::uint8_t state_;
  Watch watch_;
  std::size_t threshold_;
  std::optional<std::size_t> before_;
};

/// In the order of Watch.
const std::vector<std::string_view>& watch_words() {
  static const std::vector<std::string_view> kWords = {
      "on_increase", "on_decrease", "rise_to", "drop_to", "while_higher", "while_lower"};
  return kWords;
}

std::unique_ptr<EventTrigger> make_external(const Element&, const Attributes& attributes,
                                            BehaviorContext& context) {
  auto signal = std::make_shared<Signal>(Signal{attributes.text("name")});
  context.signals.push_back(signal);
  return std::make_unique<External>(std::move(signal));
}

std::unique_ptr<EventTrigger> make_state_population(const Element& element,
                                                    const Attributes& attributes,
                                                    BehaviorContext& context) {
  using Watch = StatePopulation::Watch;
  const auto word =
      std::find(watch_words().begin(), watch_words().end(), attributes.text("behavior"));
  const auto watch = static_cast<Watch>(word - watch_words().begin());
  const bool needs_threshold = watch != Watch::on_increase && watch != Watch::on_decrease;
  if (needs_threshold && !attributes.has("threshold")) {
    element.fail_attribute("threshold", "nothing", "a number of agents");
  }
  return std::make_unique<StatePopulation>(
      context.require_state(element, "state", attributes.text("state")), watch,
      needs_threshold ? static_cast<std::size_t>(attributes.integer("threshold")) : 0);
}

}  // namespace

const EventTriggerRegistry& event_trigger_registry() {
  static const EventTriggerRegistry kRegistry(
      {{
          {"external", "the program that runs the simulation fires its name", {}, make_external},
          {"state_population",
           "the number of agents in a state changes, or passes a threshold",
           {text("state", "the name of a state"),
            word("behavior", watch_words(),
                 "any change; the step in which the number gets to the threshold; or every step in "
                 "which it is beyond"),
            optional(integer("threshold", "number of agents; for all but on_...", 0, kMaxId))},
           make_state_population},
      }},
      {text("name", "of the trigger")});
  return kRegistry;
}

}  // namespace throng::crowd
