// Admission control: decides which task of which job starts next when workers and memory are
// limited. Running tasks are never preempted: the first claim gets the next free worker.
//
// Claims are ordered by higher priority; then by the owner with fewer running tasks, then by the
// owner with less worker time so far (an owner who returns gets no credit for the time away). Among
// one owner's jobs, the one with the fewest tasks left comes first, so that small jobs end early,
// but every fourth task is the oldest job's, so that large jobs end at all.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "base/compute/steady_time.h"

namespace throng::jobs {

/// Limits on all running tasks together.
struct AdmissionLimits {
  int workers = 1;              ///< max number of running tasks
  std::int64_t memory_mib = 0;  ///< max sum of the tasks' needs; 0: unlimited
  /// Returns the memory that the machine has left, in MiB; empty: not checked.
  std::function<std::int64_t()> available_mib = {};
  SteadyNow now = &steady_now;
};

/// Safe to use from many threads.
class Admission {
 public:
  explicit Admission(AdmissionLimits limits);
  ~Admission();
  Admission(const Admission&) = delete;
  Admission& operator=(const Admission&) = delete;

  const AdmissionLimits& limits() const { return limits_; }
  /// The number of jobs that have a Claimant.
  int jobs() const;

  /// Starts no more tasks, and blocks until none runs, for at most `limit` or until a stop.
  void drain(std::chrono::milliseconds limit, const std::stop_token& stop);

  class Permit;
  class Claimant;

 private:
  struct Owner {
    std::string name = {};
    int claimants = 0;
    int running = 0;
    double served_s = 0;  ///< worker time, raised on return to the least of the active owners
    int turns = 0;        ///< number of tasks started so far
  };

  /// The kind of memory that keeps a claim from starting.
  enum class Lack {
    none,
    limit,    ///< AdmissionLimits::memory_mib is used up
    machine,  ///< the machine has too little free memory
  };

  struct Claim {
    Owner* owner = nullptr;
    std::string job;
    int priority = 0;
    std::size_t tasks_left = 0;
    std::int64_t memory_mib = 0;  ///< need of the waiting task
    /// Time of the last request; unset if no task waits.
    std::optional<SteadyTime> asked = {};
    Lack lack = Lack::none;
    std::optional<SteadyTime> lacks_since = {};  ///< if `lack` is not none
  };

  struct Running {
    Owner* owner = nullptr;
    std::int64_t memory_mib = 0;
    SteadyTime begun;
  };

  bool is_ahead(const Claim& a, const Claim& b) const;
  Lack lack_of(const Claim& claim) const;
  bool may_begin(Claim& claim);
  void finish(std::list<Running>::iterator running);

  AdmissionLimits limits_;
  mutable std::mutex mutex_;
  std::map<std::string, Owner> owners_;
  std::list<Claim> claims_;
  std::list<Running> running_;
  bool is_draining_ = false;
  std::condition_variable_any idle_;  ///< no task runs
};

/// The right to run one task; given back by the destructor.
class Admission::Permit {
 public:
  Permit(Permit&& other) noexcept : admission_(other.admission_), running_(other.running_) {
    other.admission_ = nullptr;
  }
  Permit(const Permit&) = delete;
  Permit& operator=(const Permit&) = delete;
  Permit& operator=(Permit&&) = delete;
  ~Permit() {
    if (admission_ != nullptr) admission_->finish(running_);
  }

 private:
  friend class Claimant;
  Permit(Admission& admission, std::list<Running>::iterator running)
      : admission_(&admission), running_(running) {}

  Admission* admission_;
  std::list<Running>::iterator running_;
};

/// One job in the queue for workers. Use from one thread.
class Admission::Claimant {
 public:
  Claimant(Admission& admission, const std::string& owner, const std::string& job);
  ~Claimant();
  Claimant(const Claimant&) = delete;
  Claimant& operator=(const Claimant&) = delete;

  /// Asks to start a task. Returns std::nullopt if it has to wait: ask again within a second, or
  /// claims that come later go ahead. `tasks_left` counts this task and all later ones of the job.
  std::optional<Permit> request(int priority, std::size_t tasks_left, std::int64_t memory_mib);
  /// Ends the request: no task of the job waits now.
  void withdraw();
  /// Whether the requested task waits for memory rather than for a worker.
  bool waits_for_memory() const;

 private:
  Admission& admission_;
  std::list<Claim>::iterator claim_;
};

}  // namespace throng::jobs
