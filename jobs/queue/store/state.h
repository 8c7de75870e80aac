// The states of a queued job, and what may follow what. Pure: the store applies it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace throng::jobs {

enum class JobState {
  queued,
  running,
  succeeded,
  partial,  ///< some of its runs failed; the dataset holds the others
  failed,
  cancelled
};

enum class JobEvent {
  start,   ///< a supervisor takes the job up
  resume,  ///< the server was restarted: a new supervisor takes up a job that was running
  succeed,
  succeed_partly,
  fail,
  cancel,
  retry,  ///< of a job that did not come to its end: what it has published is kept
};

inline constexpr std::array kJobStates = {JobState::queued,    JobState::running,
                                          JobState::succeeded, JobState::partial,
                                          JobState::failed,    JobState::cancelled};
inline constexpr std::array kJobEvents = {
    JobEvent::start, JobEvent::resume, JobEvent::succeed, JobEvent::succeed_partly,
    JobEvent::fail,  JobEvent::cancel, JobEvent::retry};

/// The state after the event; nothing when the event cannot happen in this state.
std::optional<JobState> next_state(JobState state, JobEvent event);

/// Whether the job waits or runs: something may still happen to it.
bool is_active(JobState state);
/// Whether there is a dataset to be had.
bool has_dataset(JobState state);

std::string_view to_string(JobState state);
/// Name of the event: "started", "failed".
std::string_view to_string(JobEvent event);
/// The state of this name; nothing for any other word.
std::optional<JobState> job_state_named(std::string_view name);

}  // namespace throng::jobs
