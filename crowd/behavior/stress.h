// Stress: growth and decay per agent, and its effects on properties. Based on Selye's general
// adaptation syndrome, applied to crowds by Kim, Guy, Manocha and Lin ("Interactive simulation of
// dynamic crowd behaviors using general adaptation syndrome theory", 2012).
#pragma once

#include <array>

#include "crowd/state/behavior.h"

namespace throng::crowd {

/// A source of stress.
class Stressor {
 public:
  virtual ~Stressor() = default;
  /// Returns the level, 0 to 1, after a further dt_s under the stressor; `level` is the previous
  /// value.
  virtual float next_level(const Crowd& crowd, std::size_t agent, float level,
                           float dt_s) const = 0;
};

/// The stress of all agents. At level s, a property is base (1 + s delta), where base is the value
/// that files and other actions set.
class Stress : public Process {
 public:
  enum Affected { neighbor_dist, max_neighbors, radius, pref_speed, time_horizon };
  static constexpr int kAffectedCount = 5;
  using Deltas = std::array<float, kAffectedCount>;

  /// Effect of leaving the state with the stressor.
  enum class Exit {
    reset,       ///< level becomes 0 immediately
    keep_going,  ///< stressor stays active
    pause,       ///< level stays constant
    cool_down    ///< level decreases to 0
  };

  explicit Stress(const Crowd& crowd);

  /// Makes this stressor active; the level continues from its current value.
  void begin(std::size_t agent, const Stressor& stressor, const Deltas& deltas);
  /// `cool_s`: duration of cooling down from level 1 to 0.
  void end(Crowd& crowd, std::size_t agent, Exit exit, float cool_s);

  void after_motion(Crowd& crowd, Machine& machine) override;

 private:
  enum class Mode : std::uint8_t { calm, stressed, held, cooling };

  struct Value {
    float base = 0;
    float applied = 0;  // value including stress
  };

  struct Patient {
    Mode mode = Mode::calm;
    float level = 0;
    float cooling = 0;  // decrease of the level, 1/s
    const Stressor* stressor = nullptr;
    Deltas deltas{};
    std::array<Value, kAffectedCount> values{};
  };

  /// Returns the address of a value; null if the model has no time horizon.
  float* find_value(Crowd& crowd, std::size_t agent, int affected) const;
  void apply(Crowd& crowd, std::size_t agent, Patient& patient) const;
  void calm(Crowd& crowd, std::size_t agent, Patient& patient) const;

  std::vector<Patient> patients_;  // per agent
  int time_horizon_ = -1;          // index of the model's parameter; -1: none
};

/// Returns the stress process of this load, which is created at the first call.
Stress& stress_process(BehaviorContext& context);

}  // namespace throng::crowd
