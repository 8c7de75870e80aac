// Faults on purpose, so that users can see what a failing machine does to their jobs, and tests
// that it does no harm. $THRONG_FAULTS is a list of KIND:PLACE[:AMOUNT], for example
// "die:run000/shard0001:2,slow:*:0.5":
//
//   die    the process is killed on the spot (SIGKILL)
//   fail   the task fails as if the machine had failed
//   grow   the process takes memory until its limit stops it
//   hang   the process stands still: its supervisor has to notice
//   slow   the task waits AMOUNT seconds before it begins
//
// PLACE is a task's name, or * for any. For die, fail, grow and hang AMOUNT is at how many attempts
// it happens (default: at each). The server's own places are server/EVENT/before and
// server/EVENT/after: around the moment at which a job's change of state is written, with EVENT a
// to_string(JobEvent).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace throng::jobs {

inline constexpr const char* kFaultsVariable = "THRONG_FAULTS";

struct Fault {
  enum class Kind { die, fail, grow, hang, slow };
  Kind kind = Kind::die;
  std::string place;
  std::optional<double> amount;
};

/// Throws InputError when the list is malformed.
std::vector<Fault> parse_faults(std::string_view list);

/// Makes happen what $THRONG_FAULTS has for this place at this attempt (from 1). Throws InputError
/// and, for `fail`, EnvironmentError.
void inject_faults(std::string_view place, int attempt);

}  // namespace throng::jobs
