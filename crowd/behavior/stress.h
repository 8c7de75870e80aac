// Stress: how it grows and fades in every agent, and what it does to them.
// The idea is Selye's general adaptation syndrome, which Kim, Guy, Manocha and Lin ("Interactive
// simulation of dynamic crowd behaviors using general adaptation syndrome theory", 2012) brought to
// crowds.
#pragma once

#include <array>

#include "crowd/behavior.h"

namespace throng::crowd {

/// A source of stress.
class Stressor {
 public:
  virtual ~Stressor() = default;
  /// From 0 to 1, after another dt_s under it; `level` is what it was.
  virtual float next_level(const Crowd& crowd, std::size_t agent, float level,
                           float dt_s) const = 0;
};

/// Everybody's stress. At level s a property is its base times 1 + s * delta, where the base is
/// what files and other actions make it.
class Stress : public Process {
 public:
  enum Affected { neighbor_dist, max_neighbors, radius, pref_speed, time_horizon };
  static constexpr int kAffectedCount = 5;
  using Deltas = std::array<float, kAffectedCount>;

  /// When the state with the stressor is left.
  enum class Exit {
    reset,       ///< calm at once
    keep_going,  ///< the stressor stays
    pause,       ///< the level stays
    cool_down    ///< the level falls to 0
  };

  explicit Stress(const Crowd& crowd);

  /// From now on this stressor rules; the level goes on from where it is.
  void begin(std::size_t agent, const Stressor& stressor, const Deltas& deltas);
  /// `cool_s`: how long full stress takes to cool down.
  void end(Crowd& crowd, std::size_t agent, Exit exit, float cool_s);

  void after_motion(Crowd& crowd, Machine& machine) override;

 private:
  enum class Mode : std::uint8_t { calm, stressed, held, cooling };

  struct Value {
    float base = 0;
    float applied = 0;  // what stress made of it
  };

  struct Patient {
    Mode mode = Mode::calm;
    float level = 0;
    float cooling = 0;  // of the level, 1/s
    const Stressor* stressor = nullptr;
    Deltas deltas{};
    std::array<Value, kAffectedCount> values{};
  };

  /// Address of an agent's value; null for a model without a time horizon.
  float* find_value(Crowd& crowd, std::size_t agent, int affected) const;
  void apply(Crowd& crowd, std::size_t agent, Patient& patient) const;
  void calm(Crowd& crowd, std::size_t agent, Patient& patient) const;

  std::vector<Patient> patients_;  // per agent
  int time_horizon_ = -1;          // the model's parameter
};

/// The process of this load, which is made when it is first asked for.
Stress& stress_process(BehaviorContext& context);

}  // namespace throng::crowd
