// The way to Slurm's controller: one thread runs Slurm's programs, one at a time, so that the
// controller is asked at a bounded rate however many jobs wait for answers. While it does not
// answer it is asked again with growing pauses.
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

/// Begins the names of all jobs that we submit.
inline constexpr const char* kSlurmPrefix = "throng-";

/// An answer of squeue.
struct SlurmQueue {
  using Clock = std::chrono::steady_clock;
  using Key = std::pair<std::string, int>;  ///< array job, index

  Clock::time_point asked = {};  ///< when the answer was asked for; the epoch: never
  std::map<Key, SlurmTask> tasks = {};
  std::map<std::string, std::string> jobs = {};  ///< array jobs by name
  std::string away = {};                         ///< why newer answers are missing; "" when none is
};

struct SlurmAnswer {
  bool is_ok = false;
  std::string text;  ///< its output, of stdout and stderr
  bool is_away = false;
};

struct SlurmControllerOptions {
  double poll_s = 5;              ///< between two looks at the queue
  double max_pause_s = 60;        ///< while the controller is away
  double command_timeout_s = 30;  ///< of Slurm's programs
};

/// Runs a program and returns what it prints; ends it when it takes too long, or `stop` asks.
/// Blocks.
SlurmAnswer run_slurm(const std::vector<std::string>& command, double timeout_s,
                      const std::stop_token& stop = {});

/// Safe to use from many threads.
class SlurmController {
 public:
  explicit SlurmController(SlurmControllerOptions options);
  /// Cancels what was asked to be cancelled, if the controller can be reached.
  ~SlurmController();
  SlurmController(const SlurmController&) = delete;
  SlurmController& operator=(const SlurmController&) = delete;

  /// As long as one exists the queue is looked at.
  class Watch {
   public:
    explicit Watch(SlurmController& controller);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    SlurmController& controller_;
  };

  /// The newest answer.
  std::shared_ptr<const SlurmQueue> queue() const;

  /// Runs sbatch, or sacct, after everything that was asked for before.
  std::future<SlurmAnswer> run(std::vector<std::string> command);
  /// Runs scancel or scontrol; until the controller answers, whatever it answers.
  void run_until_answered(std::vector<std::string> command);
  /// The next look at the queue follows what was asked for before, if the controller answers.
  void poll_next();

 private:
  using Clock = SlurmQueue::Clock;

  struct Order {
    std::vector<std::string> command;
    std::optional<std::promise<SlurmAnswer>> promise;  ///< none: nobody waits for the answer
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
  int failures_ = 0;                         ///< in a row; guarded by mutex_
  Clock::time_point next_look_ = {};         ///< guarded by mutex_
  Clock::time_point next_order_ = {};        ///< while it is away; guarded by mutex_
  std::jthread thread_;                      ///< last: ends before what it uses
};

}  // namespace throng::jobs
