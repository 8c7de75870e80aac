// Requests to a flight, and the time of its next step.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "live/loop/moment.h"
#include "live/loop/pilot_input.h"
#include "live/loop/step_clock.h"
#include "spec/live/commands.h"

namespace throng::live {

/// A drone's velocity and yaw rate hold for this much simulated time after they were commanded:
/// it goes as far without its pilot whatever the pace of the flight, and others' commands do not
/// keep it going.
inline constexpr double kSilenceS = 1;

/// The next action of a flight. Rest: time stands still from now on.
enum class Turn { step, rest, reset, end };

/// The pace of a flight.
struct Pace {
  double factor = 1;  ///< simulated seconds per second; 0: as fast as it can
  bool paused = false;
  bool is_watched = true;      ///< time stands still while nobody looks on
  double max_s = kMaxFlightS;  ///< the flight ends at this simulated time
};

/// Safe to use from many threads: clients ask, one thread flies, one shows images.
class Control {
 public:
  /// Reports the end of what was asked for: a problem or "", and the simulated time.
  using Answer = std::function<void(const std::string& problem, double time_s)>;

  /// A request to begin again.
  struct Reset {
    std::optional<std::uint64_t> seed;  ///< none: the same
    Answer answer;
  };

  /// `drones` are their ids. A request by `stop` ends the flight.
  Control(std::vector<std::string> drones, const Pace& pace, std::stop_token stop = {});

  /// Ids of the drones.
  const std::vector<std::string>& drones() const { return drones_; }

  // For clients.

  /// Adds commands; those that move a drone hold from now on.
  void command(const Commands& commands);
  /// Simulates steps although the flight is paused. Throws InputError if it is not.
  void step(std::int64_t steps, Answer answer);
  /// Throws InputError if a reset is under way.
  void reset(std::optional<std::uint64_t> seed, Answer answer);
  /// Says whether somebody looks on.
  void watch(bool is_watched);
  bool is_watched() const;
  void end();
  /// Ends the flight by an exception, which wait_for_turn() throws.
  void fail(std::exception_ptr problem);
  PilotInput input() const;
  double time_s() const;
  /// Simulated time per time, lately; that which is asked for after a rest.
  double reached_factor() const;

  // For the thread that flies.

  /// Another flight, which begins at this moment without commands.
  void begin(std::shared_ptr<const Moment> moment);
  /// Waits until something is to be done.
  Turn wait_for_turn();
  /// The commands for the next step.
  PilotInput in_force() const;
  /// A step has been simulated.
  void done(std::shared_ptr<const Moment> moment);
  /// The reset that wait_for_turn() has reported.
  Reset take_reset();
  /// Answers all who wait.
  void refuse_all(const std::string& problem);

  // For images.

  /// The time to be shown now, in the newest step.
  struct Shown {
    std::shared_ptr<const Moment> moment;
    double time_s = 0;
  };
  Shown shown() const;

 private:
  struct Waiting {
    std::uint64_t step = 0;  ///< number of the step for which it waits
    Answer answer;
  };

  // With the mutex held.
  bool should_end() const { return ends_ || problem_ || stop_.stop_requested(); }
  bool rests() const { return input_.paused || !is_watched_; }

  const std::vector<std::string> drones_;
  const double max_s_;
  std::stop_token stop_;
  mutable std::mutex mutex_;  ///< of all below
  std::condition_variable_any changed_;
  PilotInput input_;
  std::vector<double> commanded_s_;  ///< per drone: simulated time of the last velocity
  std::shared_ptr<const Moment> moment_;
  std::uint64_t steps_ = 0;  ///< of all flights
  std::uint64_t goal_ = 0;   ///< steps up to this one are simulated although it is paused
  std::vector<Waiting> waiting_;
  std::optional<Reset> reset_;
  bool is_watched_;
  bool is_at_rest_ = false;  ///< wait_for_turn() has said so since the last step
  bool ends_ = false;
  std::exception_ptr problem_;
  StepClock clock_;
};

}  // namespace throng::live
