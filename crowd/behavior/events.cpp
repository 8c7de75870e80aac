#include "crowd/behavior/events.h"

#include <fmt/core.h>

#include <map>
#include <string>

namespace throng::crowd {

namespace {

struct Response {
  EventEffect* effect = nullptr;
  EventTarget* target = nullptr;
};

struct Event {
  std::unique_ptr<EventTrigger> trigger;
  std::vector<Response> responses;
};

class EventSystem : public Process {
 public:
  EventSystem(const Element& element, BehaviorContext& context);

  void before_decisions(Crowd& crowd, Machine& machine) override {
    for (Event& event : events_) {
      if (!event.trigger->fires(crowd)) continue;
      for (const Response& response : event.responses) respond(crowd, machine, response);
    }
  }

 private:
  template <typename Part>
  using Named = std::map<std::string, std::unique_ptr<Part>, std::less<>>;

  static void respond(Crowd& crowd, Machine& machine, const Response& response) {
    for (std::size_t i = 0; i < crowd.agents.count(); ++i) {
      if (crowd.agents.present[i] == 0 || !response.target->includes(crowd, i)) continue;
      response.effect->apply(crowd, machine, i);
    }
  }

  void load_child(const Element& element, BehaviorContext& context);
  void load_event(const Element& element, BehaviorContext& context);
  Response load_response(const Element& element) const;

  Named<EventTarget> targets_;
  Named<EventEffect> effects_;
  std::vector<Event> events_;
  bool conservative_ = true;
};

/// Does what `load` does, or warns of what it throws.
template <typename Load>
void load_or_leave_out(const Element& element, bool conservative, const Load& load) {
  if (conservative) return load();
  try {
    load();
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    element.warn(fmt::format("{} ({}), so this is left out", problem.found, problem.where),
                 problem.expected);
  }
}

template <typename Part>
void load_named(const Registry<Part, BehaviorContext>& registry, const Element& element,
                BehaviorContext& context,
                std::map<std::string, std::unique_ptr<Part>, std::less<>>& parts) {
  const auto& entry = registry.find(element);
  const Attributes attributes(element, entry.attributes);
  const std::string& name = attributes.text("name");
  if (parts.contains(name)) {
    element.fail_attribute("name", in_quotes(name) + " again", "a name of its own");
  }
  parts[name] = entry.make(element, attributes, context);
}

template <typename Part>
Part* require_named(const Element& element, std::string_view attribute, const std::string& name,
                    const std::map<std::string, std::unique_ptr<Part>, std::less<>>& parts) {
  const auto found = parts.find(name);
  if (found != parts.end()) return found->second.get();
  std::string known;
  for (const auto& part : parts) known += (known.empty() ? "" : ", ") + part.first;
  element.fail_attribute(attribute, in_quotes(name),
                         known.empty() ? fmt::format("the name of an {} (there is none)", attribute)
                                       : "one of " + known);
}

EventSystem::EventSystem(const Element& element, BehaviorContext& context) {
  const Attributes attributes(
      element,
      {optional(boolean("conservative", "0: what is wrong is left out, with a warning"), "1")});
  conservative_ = attributes.boolean("conservative");
  // Events refer to the others, wherever those stand.
  for (const bool events : {false, true}) {
    for (const Element& child : element.children()) {
      if ((child.name() == "Event") != events) continue;
      load_or_leave_out(child, conservative_, [&] { load_child(child, context); });
    }
  }
}

void EventSystem::load_child(const Element& element, BehaviorContext& context) {
  if (element.name() == "Target") {
    load_named(event_target_registry(), element, context, targets_);
  } else if (element.name() == "Effect") {
    load_named(event_effect_registry(), element, context, effects_);
  } else if (element.name() == "Event") {
    load_event(element, context);
  } else {
    element.fail_unknown("<Target>, <Effect> or <Event>");
  }
}

void EventSystem::load_event(const Element& element, BehaviorContext& context) {
  const Attributes attributes(element, {text("name", "of the event")});
  Event event;
  for (const Element& child : element.children()) {
    if (child.name() == "Trigger") {
      if (event.trigger) child.fail("a second <Trigger>", "exactly one <Trigger>");
      child.require_no_children();
      event.trigger = event_trigger_registry().make(child, context);
    } else if (child.name() == "Response") {
      load_or_leave_out(child, conservative_,
                        [&] { event.responses.push_back(load_response(child)); });
    } else {
      child.fail_unknown("<Trigger> or <Response>");
    }
  }
  if (!event.trigger) element.fail("no <Trigger>", "exactly one <Trigger>");
  if (event.responses.empty()) element.fail("no <Response>", "at least one <Response>");
  events_.push_back(std::move(event));
}

Response EventSystem::load_response(const Element& element) const {
  element.require_no_children();
  const Attributes attributes(element, {text("effect", "the name of an <Effect>"),
                                        text("target", "the name of a <Target>")});
  return {require_named(element, "effect", attributes.text("effect"), effects_),
          require_named(element, "target", attributes.text("target"), targets_)};
}

}  // namespace

void load_events(const Element& element, BehaviorContext& context) {
  auto events = std::make_unique<EventSystem>(element, context);
  context.processes.push_back(std::move(events));
}

}  // namespace throng::crowd
