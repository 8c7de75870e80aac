#include <fmt/core.h>

#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

/// One of several states, by weight.
class StateLottery : public Target {
 public:
  struct Ticket {
    std::uint8_t state = 0;
    double weight = 1;
  };

  StateLottery(std::vector<Ticket> tickets, const Sampler& unit)
      : tickets_(std::move(tickets)), unit_(unit) {
    for (const Ticket& ticket : tickets_) total_ += ticket.weight;
  }

  std::uint8_t state(const Crowd& crowd, std::size_t agent) override {
    double left = unit_(agent, crowd.agents.entry[agent]) * total_;
    std::uint8_t chosen = tickets_.front().state;
    for (const Ticket& ticket : tickets_) {
      if (ticket.weight == 0) continue;
      chosen = ticket.state;
      if (left < ticket.weight) break;
      left -= ticket.weight;
    }
    return chosen;
  }

  double total() const { return total_; }

  void list_states(std::vector<std::uint8_t>& states) const override {
    for (const Ticket& ticket : tickets_) {
      if (ticket.weight > 0) states.push_back(ticket.state);
    }
  }

 private:
  std::vector<Ticket> tickets_;
  Sampler unit_;
  double total_ = 0;
};

class Return : public Target {
 public:
  std::uint8_t state(const Crowd& crowd, std::size_t agent) override {
    return crowd.agents.previous_state[agent];
  }
};

std::unique_ptr<Target> make_lottery(const Element& element, const Attributes&,
                                     BehaviorContext& context) {
  std::vector<StateLottery::Ticket> tickets;
  for (const Element& child : element.children()) {
    if (child.name() != "State") child.fail_unknown("<State>");
    child.require_no_children();
    const Attributes attributes(child,
                                {text("name", "the name of a state"),
                                 optional(number("weight", "share of the agents", 0, 1e6), "1")});
    tickets.push_back({context.require_state(child, "name", attributes.text("name")),
                       attributes.number("weight")});
  }
  if (tickets.empty()) element.fail("no states", "at least one <State>");
  auto made = std::make_unique<StateLottery>(std::move(tickets), context.make_unit_sampler());
  if (made->total() == 0) element.fail("weights of 0", "a state with a weight above 0");
  return made;
}

std::unique_ptr<Target> make_return(const Element& element, const Attributes&, BehaviorContext&) {
  element.require_no_children();
  return std::make_unique<Return>();
}

}  // namespace

const TargetRegistry& target_registry() {
  static const TargetRegistry kRegistry({{
      {"prob", "one of several states, by weight", {}, make_lottery},
      {"return", "the state from which this one was entered", {}, make_return},
  }});
  return kRegistry;
}

}  // namespace throng::crowd
