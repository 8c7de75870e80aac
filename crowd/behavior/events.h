// Events: when a trigger fires, an effect is applied to the agents of a target.
#pragma once

#include <memory>

#include "crowd/state/behavior.h"

namespace throng::crowd {

/// Decides when an event happens. Called once per (sub-)step, before the agents decide.
class EventTrigger {
 public:
  virtual ~EventTrigger() = default;
  virtual bool fires(const Crowd& crowd) = 0;
};

/// The agents that an event concerns.
class EventTarget {
 public:
  virtual ~EventTarget() = default;
  virtual bool includes(const Crowd& crowd, std::size_t agent) const = 0;
};

/// The effect of an event on each agent.
class EventEffect {
 public:
  virtual ~EventEffect() = default;
  virtual void apply(Crowd& crowd, Machine& machine, std::size_t agent) = 0;
};

using EventTriggerRegistry = Registry<EventTrigger, BehaviorContext>;
using EventTargetRegistry = Registry<EventTarget, BehaviorContext>;
using EventEffectRegistry = Registry<EventEffect, BehaviorContext>;

const EventTriggerRegistry& event_trigger_registry();
const EventTargetRegistry& event_target_registry();
const EventEffectRegistry& event_effect_registry();

/// Reads an <EventSystem> into a process of the context. Throws InputError; with conservative="0",
/// invalid child elements are ignored with a warning instead.
void load_events(const Element& element, BehaviorContext& context);

}  // namespace throng::crowd
