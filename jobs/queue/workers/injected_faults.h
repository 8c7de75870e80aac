// Fault injection: shows users the effect of a failing machine on their jobs, and lets tests prove
// that it does no harm. $THRONG_FAULTS is a list of KIND:PLACE[:AMOUNT], for example
// "die:run000/shard0001:2,slow:*:0.5":
//
//   die    the process is killed at once (SIGKILL)
//   fail   the task fails with an environment error
//   grow   the process allocates memory until its limit stops it, at most 4 GiB
//   hang   the process is suspended (SIGSTOP): its supervisor has to notice
//   slow   the task waits AMOUNT seconds (default: 1) before it starts
//
// PLACE is a task's name, or * for any task. For die, fail, grow and hang, AMOUNT is the number of
// attempts that fail (default: all). The server has the places server/EVENT/before and
// server/EVENT/after, before and after a job's change of state is written; EVENT is a
// to_string(JobEvent).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace throng::jobs {

inline constexpr const char* kFaultsVariable = "THRONG_FAULTS";

/// One entry of the list.
struct Fault {
  enum class Kind { die, fail, grow, hang, slow };
  Kind kind = Kind::die;
  std::string place;
  std::optional<double> amount;
};

/// Parses a list of faults. Throws InputError if it is malformed.
std::vector<Fault> parse_faults(std::string_view list);

/// Provokes the faults that $THRONG_FAULTS lists for this place and attempt (from 1). Throws
/// InputError if the list is malformed and, for `fail` and `grow`, EnvironmentError; `grow` may
/// throw std::bad_alloc.
void inject_faults(std::string_view place, int attempt);

}  // namespace throng::jobs
