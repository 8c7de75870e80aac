// Detection of agents who stand still until the end of a run although they have somewhere to go.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.h"
#include "crowd/output/recorder.h"

namespace throng::crowd {

/// Watches how long agents have stood. Writes no file; warning() speaks of the last recorded time.
/// An agent stands from when it has remained within 50 cm in the same state. It wants to go on if
/// its state is not final, its desired speed is above 0, and it prefers to move or has a goal
/// farther than 1 m away.
class StandingWatch : public Recorder {
 public:
  /// Shorter waits are those of queues and doors (s).
  static constexpr double kPatienceS = 20;

  void record(const Simulation& crowd) override;
  void finish(const Simulation& crowd) override;

  /// After finish(): the warning, with the number of agents that stood for the last kPatienceS
  /// seconds or longer and their states; nothing if there are none.
  const std::optional<Problem>& warning() const { return warning_; }

 private:
  struct Stay {
    Eigen::Vector2f place = Eigen::Vector2f::Zero();
    double since_s = 0;
    std::uint8_t state = 0;
    bool known = false;
  };

  std::vector<Stay> stays_;  // per agent
  std::optional<Problem> warning_;
};

}  // namespace throng::crowd
