#include "jobs/queue/workers/admission.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace throng::jobs {

namespace {

using namespace std::chrono_literals;

// A claim that was not renewed for so long belongs to a thread that is busy: others go on.
constexpr auto kMaxSilence = 1s;
// How long smaller tasks may go ahead of one that waits for memory.
constexpr auto kMaxOvertaking = 60s;
constexpr int kTurnsOfOldest = 4;
// Memory of the machine that no task gets.
constexpr std::int64_t kReserveMib = 256;
// How long a task that was begun may take to fill its memory.
constexpr auto kGrowth = 10s;

}  // namespace

Admission::Admission(AdmissionLimits limits) : limits_(std::move(limits)) {}

Admission::~Admission() = default;

int Admission::jobs() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(claims_.size());
}

bool Admission::is_ahead(const Claim& a, const Claim& b) const {
  if (a.priority != b.priority) return a.priority > b.priority;
  if (a.owner != b.owner) {
    if (a.owner->running != b.owner->running) return a.owner->running < b.owner->running;
    if (a.owner->served_s != b.owner->served_s) return a.owner->served_s < b.owner->served_s;
    return a.owner->name < b.owner->name;
  }
  const bool is_turn_of_oldest = a.owner->turns % kTurnsOfOldest == kTurnsOfOldest - 1;
  if (!is_turn_of_oldest && a.tasks_left != b.tasks_left) return a.tasks_left < b.tasks_left;
  return a.job < b.job;
}

Admission::Lack Admission::lack_of(const Claim& claim) const {
  if (claim.memory_mib == 0) return Lack::none;
  std::int64_t used = 0;
  for (const Running& running : running_) used += running.memory_mib;
  // A task that is larger than all there is was accepted under another limit: it runs alone.
  if (limits_.memory_mib > 0 && used + claim.memory_mib > limits_.memory_mib && !running_.empty()) {
    return Lack::limit;
  }
  if (!limits_.available_mib) return Lack::none;
  const SteadyTime now = limits_.now();
  std::int64_t promised = 0;  // to tasks that have not taken it yet
  for (const Running& running : running_) {
    if (now - running.begun < kGrowth) promised += running.memory_mib;
  }
  const bool has_left = limits_.available_mib() >= claim.memory_mib + promised + kReserveMib;
  return has_left ? Lack::none : Lack::machine;
}

bool Admission::may_begin(Claim& claim) {
  const SteadyTime now = limits_.now();
  if (is_draining_ || static_cast<int>(running_.size()) >= limits_.workers) return false;
  for (const Claim& other : claims_) {
    if (&other == &claim || !other.asked || now - *other.asked > kMaxSilence) continue;
    if (!is_ahead(other, claim)) continue;
    const bool may_be_overtaken =
        other.lack == Lack::machine ||
        (other.lack == Lack::limit && now - *other.lacks_since < kMaxOvertaking);
    if (!may_be_overtaken) return false;
  }
  const Lack lack = lack_of(claim);
  if (lack != claim.lack) claim.lacks_since = now;
  claim.lack = lack;
  return lack == Lack::none;
}

void Admission::finish(std::list<Running>::iterator running) {
  const std::lock_guard lock(mutex_);
  Owner& owner = *running->owner;
  --owner.running;
  owner.served_s += std::chrono::duration<double>(limits_.now() - running->begun).count();
  running_.erase(running);
  if (running_.empty()) idle_.notify_all();
}

void Admission::drain(std::chrono::milliseconds limit, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  is_draining_ = true;
  idle_.wait_for(lock, stop, limit, [this] { return running_.empty(); });
}

Admission::Claimant::Claimant(Admission& admission, const std::string& owner,
                              const std::string& job)
    : admission_(admission) {
  const std::lock_guard lock(admission.mutex_);
  Owner& mine = admission.owners_[owner];
  mine.name = owner;
  if (mine.claimants == 0) {
    std::optional<double> least;
    for (const auto& [name, other] : admission.owners_) {
      if (other.claimants == 0 && other.running == 0) continue;
      least = std::min(least.value_or(other.served_s), other.served_s);
    }
    mine.served_s = std::max(mine.served_s, least.value_or(0));
  }
  ++mine.claimants;
  claim_ = admission.claims_.insert(admission.claims_.end(), Claim{&mine, job});
}

Admission::Claimant::~Claimant() {
  const std::lock_guard lock(admission_.mutex_);
  --claim_->owner->claimants;
  admission_.claims_.erase(claim_);
}

std::optional<Admission::Permit> Admission::Claimant::request(int priority, std::size_t tasks_left,
                                                              std::int64_t memory_mib) {
  const std::lock_guard lock(admission_.mutex_);
  claim_->priority = priority;
  claim_->tasks_left = tasks_left;
  claim_->memory_mib = memory_mib;
  claim_->asked = admission_.limits_.now();
  if (!admission_.may_begin(*claim_)) return std::nullopt;
  claim_->asked.reset();
  ++claim_->owner->running;
  ++claim_->owner->turns;
  return Permit(admission_,
                admission_.running_.insert(admission_.running_.end(),
                                           {claim_->owner, memory_mib, admission_.limits_.now()}));
}

void Admission::Claimant::withdraw() {
  const std::lock_guard lock(admission_.mutex_);
  claim_->asked.reset();
  claim_->lack = Lack::none;
}

bool Admission::Claimant::waits_for_memory() const {
  const std::lock_guard lock(admission_.mutex_);
  return claim_->asked && claim_->lack != Lack::none;
}

}  // namespace throng::jobs
