// Decides which task may begin next where several jobs have tasks and workers and memory are
// limited. Running tasks are never ended for others: the claim that is ahead gets the next free
// worker.
//
// Order: the higher priority; then the owner with fewer running tasks, and among equals the one who
// has had less time of the workers (an owner who comes back gets nothing for the time away); then,
// of one owner's jobs, the one with the fewest tasks left, so that small jobs end early, but every
// fourth task is the oldest job's, so that large ones end at all.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/compute/steady_time.h"

namespace throng::jobs {

struct AdmissionLimits {
  int workers = 1;              ///< tasks at once
  std::int64_t memory_mib = 0;  ///< that all tasks may need together; 0: any
  /// Memory that the machine has left, in MiB; none: not asked.
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
  /// Jobs that have tasks waiting or running.
  int jobs() const;

  class Permit;
  class Claimant;

 private:
  struct Owner {
    std::string name = {};
    int claimants = 0;
    int running = 0;
    double served_s = 0;  ///< time of workers, less what others got while this one was away
    int turns = 0;        ///< tasks that were begun
  };

  /// The kind of memory that a claim lacks that would be next otherwise.
  enum class Lack {
    none,
    limit,    ///< of what all tasks may need together
    machine,  ///< other programs have it
  };

  struct Claim {
    Owner* owner = nullptr;
    std::string job;
    int priority = 0;
    std::size_t tasks_left = 0;
    std::int64_t memory_mib = 0;  ///< of the task that waits
    /// When it last asked; not waiting if unset.
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
};

/// A task may run as long as it is held.
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

/// One job's place in the queue for workers. Use from one thread.
class Admission::Claimant {
 public:
  Claimant(Admission& admission, const std::string& owner, const std::string& job);
  ~Claimant();
  Claimant(const Claimant&) = delete;
  Claimant& operator=(const Claimant&) = delete;

  /// Asks to begin a task; nothing when it has to wait: ask again within a second, or lose the
  /// place to others. `tasks_left` counts this task and all that follow in the job.
  std::optional<Permit> request(int priority, std::size_t tasks_left, std::int64_t memory_mib);
  /// No task waits now.
  void withdraw();
  /// Whether the task that was last asked for waits for memory, and not for a worker.
  bool waits_for_memory() const;

 private:
  Admission& admission_;
  std::list<Claim>::iterator claim_;
};

}  // namespace throng::jobs
