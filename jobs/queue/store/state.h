// State machine of a queued job: states, events and transitions. Pure functions; the store applies
// them.
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
  retry,  ///< a partial, failed or cancelled job is queued again; its finished tasks are kept
};

inline constexpr std::array kJobStates = {JobState::queued,    JobState::running,
                                          JobState::succeeded, JobState::partial,
                                          JobState::failed,    JobState::cancelled};
inline constexpr std::array kJobEvents = {
    JobEvent::start, JobEvent::resume, JobEvent::succeed, JobEvent::succeed_partly,
    JobEvent::fail,  JobEvent::cancel, JobEvent::retry};

/// The state after the event; std::nullopt if the event is not allowed in this state.
std::optional<JobState> next_state(JobState state, JobEvent event);

/// Whether the job is queued or running.
bool is_active(JobState state);
/// Whether a job in this state has a dataset, complete or partial.
bool has_dataset(JobState state);

std::string_view to_string(JobState state);
/// Name of the event in the past tense: "started", "failed".
std::string_view to_string(JobEvent event);
/// The state of this name; std::nullopt for any other text.
std::optional<JobState> job_state_named(std::string_view name);

}  // namespace throng::jobs
