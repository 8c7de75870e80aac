// When people on a stand sit, stand and cheer: functions of the time and of a person's key alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace throng::sim {

/// The posture of a person on a stand.
enum class Posture : std::uint8_t { sitting, standing, cheering, leaving };

/// How long people take to get up or to sit down.
inline constexpr double kRiseS = 0.8;

/// A posture, with how far somebody has risen from the seat.
struct PostureNow {
  Posture posture = Posture::sitting;
  double risen = 0;  ///< 0 on the seat to 1 on the feet; follows the posture within kRiseS
};

/// The moments of a run that make people get up: about one in 25 s, the first one between 5 and
/// 15 s; each lasts 6 to 10 s and spreads over the stands within 1.5 s.
class CheeringWaves {
 public:
  /// `step_s`: postures change at multiples of it.
  CheeringWaves(std::uint64_t seed, double step_s);

  /// The posture of a person at a time. `key` is the person's; `place` from 0 to 1 is where the
  /// person's block is among all blocks.
  PostureNow posture_at(double time_s, std::uint64_t key, double place) const;

 private:
  struct Span;
  double on_step(double time_s) const;
  Span wave_for(double time_s, std::uint64_t key, double place) const;
  Span change_for(double time_s, std::uint64_t key) const;

  std::uint64_t seed_;
  double step_s_;
};

}  // namespace throng::sim
