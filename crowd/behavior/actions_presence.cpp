#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

/// Takes the agent out of the simulation for good: a sink. The machine does the rest.
class Leave : public Action {
 public:
  void enter(Crowd& crowd, std::size_t agent) override { crowd.agents.present[agent] = 0; }
  void leave(Crowd&, std::size_t) override {}
};

std::unique_ptr<Action> make_leave(const Element&, const Attributes&, BehaviorContext&) {
  return std::make_unique<Leave>();
}

}  // namespace

std::vector<ActionRegistry::Entry> presence_actions() {
  return {{"leave", "the agent leaves the simulation for good", {}, make_leave}};
}

}  // namespace throng::crowd
