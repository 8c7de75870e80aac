// Access to Slurm's controller: one thread runs Slurm's programs one at a time, so that the rate of
// requests is bounded for any number of jobs. While the controller does not answer, requests are
// repeated with growing pauses.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "jobs/queue/slurm/slurm_state.h"

namespace throng::jobs {

/// Prefix of the names of all array jobs that throng submits.
inline constexpr const char* kSlurmPrefix = "throng-";

/// An answer of squeue.
struct SlurmQueue {
  using Clock = std::chrono::steady_clock;
  using Key = std::pair<std::string, int>;  ///< array job, index

  Clock::time_point asked = {};  ///< when the answer was asked for; the epoch: never
  std::map<Key, SlurmTask> tasks = {};
  std::map<std::string, std::string> jobs = {};  ///< array jobs by name
  std::string away = {};                         ///< why squeue fails now; "" if it does not
};

/// Result of one of Slurm's programs.
struct SlurmAnswer {
  bool is_ok = false;    ///< exit code 0
  std::string text;      ///< stdout and stderr
  bool is_away = false;  ///< the controller did not answer
};

struct SlurmControllerOptions {
  double poll_s = 5;              ///< pause between two calls of squeue
  double max_pause_s = 60;        ///< max pause while the controller does not answer
  double command_timeout_s = 30;  ///< time limit of Slurm's programs
};

/// Runs a program and returns its output; ends it at the timeout or a request by `stop`. Blocks.
SlurmAnswer run_slurm(const std::vector<std::string>& command, double timeout_s,
                      const std::stop_token& stop = {});

/// Safe to use from many threads.
class SlurmController {
 public:
  explicit SlurmController(SlurmControllerOptions options);
  /// Runs the pending calls of scancel if the controller can be reached.
  ~SlurmController();
  SlurmController(const SlurmController&) = delete;
  SlurmController& operator=(const SlurmController&) = delete;

  /// squeue is called regularly as long as an object of this class exists.
  class Watch {
   public:
    explicit Watch(SlurmController& controller);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    SlurmController& controller_;
  };

  /// The newest answer of squeue; never null.
  std::shared_ptr<const SlurmQueue> queue() const;

  /// Queues a call of sbatch or sacct behind all earlier ones.
  std::future<SlurmAnswer> run(std::vector<std::string> command);
  /// Queues a call of scancel or scontrol and repeats it until the controller answers, whatever the
  /// answer is.
  void run_until_answered(std::vector<std::string> command);
  /// Calls squeue right after the queued calls, if the controller answers.
  void poll_next();

 private:
  using Clock = SlurmQueue::Clock;

  struct Order {
    std::vector<std::string> command;
    std::optional<std::promise<SlurmAnswer>> promise;  ///< none: the answer is not needed
  };

  void work(const std::stop_token& stop);
  void carry_out(Order order, const std::stop_token& stop);
  void look(const std::stop_token& stop);
  void note_away(const std::string& why);
  void note_back();
  bool has_orders_now() const;
  void drain();

  SlurmControllerOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Order> orders_;                 ///< guarded by mutex_
  std::shared_ptr<const SlurmQueue> queue_;  ///< guarded by mutex_
  int watches_ = 0;                          ///< guarded by mutex_
  int failures_ = 0;                         ///< consecutive failures; guarded by mutex_
  Clock::time_point next_look_ = {};         ///< guarded by mutex_
  Clock::time_point next_order_ = {};        ///< while it is away; guarded by mutex_
  std::jthread thread_;                      ///< last member: joined before the others end
};

}  // namespace throng::jobs
