#include <fmt/core.h>

#include <algorithm>

#include "crowd/behavior/stress.h"

namespace throng::crowd {

namespace {

/// Attributes of every element with stress: how much each property changes, and what happens when
/// the state is left.
class Response {
 public:
  Response(const Attributes& attributes, BehaviorContext& context);

  void enter(const Crowd& crowd, std::size_t agent, const Stressor& stressor);
  void leave(Crowd& crowd, std::size_t agent);

 private:
  Stress& stress_;
  std::vector<Sampler> deltas_;  // by Stress::Affected
  Stress::Exit exit_;
  Sampler cool_s_;
};

struct DeltaAttribute {
  std::string_view prefix;
  double initial;
  std::string_view help;
};

/// By Stress::Affected.
constexpr std::array<DeltaAttribute, Stress::kAffectedCount> kDeltas = {{
    {"neighbor_dist_", -0.0402, "change of neighbor_dist at full stress, as a share of it"},
    {"max_neighbors_", -0.188, "change of max_neighbors at full stress, as a share of it"},
    {"radius_", 0.6675, "change of r at full stress, as a share of it"},
    {"pref_speed_", 0.684, "change of pref_speed at full stress, as a share of it"},
    {"time_horizon_", -0.202, "change of the model's tau at full stress, as a share of it"},
}};
constexpr double kCoolDuration = 5;  // s
constexpr double kMaxDelta = 100;

/// In the order of Stress::Exit.
const std::vector<std::string_view>& exit_words() {
  static const std::vector<std::string_view> kWords = {"reset", "continue", "pause", "cool down"};
  return kWords;
}

Sampler sampler_or(const Attributes& attributes, std::string_view prefix, double initial,
                   BehaviorContext& context) {
  return context.make_sampler(attributes.has(prefix) ? attributes.distribution(prefix)
                                                     : Distribution::constant(initial));
}

Response::Response(const Attributes& attributes, BehaviorContext& context)
    : stress_(stress_process(context)),
      exit_(static_cast<Stress::Exit>(
          std::find(exit_words().begin(), exit_words().end(), attributes.text("exit_behavior")) -
          exit_words().begin())),
      cool_s_(sampler_or(attributes, "cool_duration_", kCoolDuration, context)) {
  for (const DeltaAttribute& delta : kDeltas) {
    deltas_.push_back(sampler_or(attributes, delta.prefix, delta.initial, context));
  }
}

void Response::enter(const Crowd& crowd, std::size_t agent, const Stressor& stressor) {
  Stress::Deltas deltas{};
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    deltas[i] = static_cast<float>(deltas_[i](agent, crowd.agents.entry[agent]));
  }
  stress_.begin(agent, stressor, deltas);
}

void Response::leave(Crowd& crowd, std::size_t agent) {
  stress_.end(crowd, agent, exit_, static_cast<float>(cool_s_(agent, crowd.agents.entry[agent])));
}

/// Stress that grows from 0 to 1 in some time.
class TimedStress : public Action, public Stressor {
 public:
  TimedStress(const Attributes& attributes, BehaviorContext& context)
      : duration_s_(context.make_sampler(attributes.distribution("duration_"))),
        response_(attributes, context),
        duration_of_s_(context.agent_count) {}

  void enter(Crowd& crowd, std::size_t agent) override {
    constexpr double kMinLength = 1e-3;
    duration_of_s_[agent] =
        static_cast<float>(std::max(duration_s_(agent, crowd.agents.entry[agent]), kMinLength));
    response_.enter(crowd, agent, *this);
  }
  void leave(Crowd& crowd, std::size_t agent) override { response_.leave(crowd, agent); }

  float next_level(const Crowd&, std::size_t agent, float level, float dt_s) const override {
    return level + dt_s / duration_of_s_[agent];
  }

 private:
  Sampler duration_s_;
  Response response_;
  std::vector<float> duration_of_s_;
};

/// Stress by the distance to a region: 1 up to `inner`, 0 from `outer` on.
class DistanceStress : public Action, public Stressor {
 public:
  DistanceStress(const Element& element, const Attributes& attributes, BehaviorContext& context)
      : region_(read_shape_choice(element, attributes)),
        inner_(context.make_sampler(attributes.distribution("inner_"))),
        outer_(context.make_sampler(attributes.distribution("outer_"))),
        quadratic_(attributes.text("fall_off") == "quadratic"),
        response_(attributes, context),
        range_(context.agent_count) {}

  void enter(Crowd& crowd, std::size_t agent) override {
    const std::uint32_t entry = crowd.agents.entry[agent];
    const auto inner = static_cast<float>(inner_(agent, entry));
    range_[agent] = {inner, std::max(inner, static_cast<float>(outer_(agent, entry)))};
    response_.enter(crowd, agent, *this);
  }
  void leave(Crowd& crowd, std::size_t agent) override { response_.leave(crowd, agent); }

  float next_level(const Crowd& crowd, std::size_t agent, float, float) const override {
    const float distance = region_->distance(crowd.agents.position[agent]);
    const Range& range = range_[agent];
    if (distance <= range.inner) return 1;
    if (distance >= range.outer) return 0;
    const float share = (range.outer - distance) / (range.outer - range.inner);
    return quadratic_ ? share * share : share;
  }

 private:
  struct Range {
    float inner = 0;  // m
    float outer = 0;  // m
  };

  std::unique_ptr<GoalShape> region_;
  Sampler inner_;
  Sampler outer_;
  bool quadratic_;
  Response response_;
  std::vector<Range> range_;
};

std::unique_ptr<Action> make_timed(const Element&, const Attributes& attributes,
                                   BehaviorContext& context) {
  return std::make_unique<TimedStress>(attributes, context);
}

std::unique_ptr<Action> make_distance(const Element& element, const Attributes& attributes,
                                      BehaviorContext& context) {
  return std::make_unique<DistanceStress>(element, attributes, context);
}

AttributeTable with_response(AttributeTable table) {
  for (const DeltaAttribute& delta : kDeltas) {
    table.push_back(optional(distribution(delta.prefix, delta.help, -kMaxDelta, kMaxDelta)));
  }
  table.push_back(word("exit_behavior", exit_words(), "of the stress, when the state is left"));
  table.push_back(optional(
      distribution("cool_duration_", "how long full stress takes to cool down, in s (5)", 0, 1e6)));
  return table;
}

}  // namespace

std::vector<ActionRegistry::Entry> stress_actions() {
  AttributeTable distance = shape_choice_attributes();
  distance.push_back(distribution("inner_", "up to here, in m, stress is full", 0));
  distance.push_back(distribution("outer_", "from here on, in m, there is none", 0));
  distance.push_back(word("fall_off", {"linear", "quadratic"}, "of stress in between"));
  return {
      {"timed_stress", "stress that grows with time",
       with_response({distribution("duration_", "until stress is full, in s", 0, 1e6)}),
       make_timed},
      {"distance_stress", "stress near a region", with_response(std::move(distance)),
       make_distance},
  };
}

}  // namespace throng::crowd
