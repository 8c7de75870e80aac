#include "jobs/queue/store/state.h"

namespace throng::jobs {

namespace {

struct Transition {
  JobState from;
  JobEvent event;
  JobState to;
};

constexpr std::array kTransitions = {
    Transition{JobState::queued, JobEvent::start, JobState::running},
    Transition{JobState::queued, JobEvent::cancel, JobState::cancelled},
    Transition{JobState::running, JobEvent::resume, JobState::running},
    Transition{JobState::running, JobEvent::succeed, JobState::succeeded},
    Transition{JobState::running, JobEvent::succeed_partly, JobState::partial},
    Transition{JobState::running, JobEvent::fail, JobState::failed},
    Transition{JobState::running, JobEvent::cancel, JobState::cancelled},
    Transition{JobState::partial, JobEvent::retry, JobState::queued},
    Transition{JobState::failed, JobEvent::retry, JobState::queued},
    Transition{JobState::cancelled, JobEvent::retry, JobState::queued},
};

}  // namespace

std::optional<JobState> next_state(JobState state, JobEvent event) {
  for (const Transition& transition : kTransitions) {
    if (transition.from == state && transition.event == event) return transition.to;
  }
  return std::nullopt;
}

bool is_active(JobState state) { return state == JobState::queued || state == JobState::running; }

bool has_dataset(JobState state) {
  return state == JobState::succeeded || state == JobState::partial;
}

std::string_view to_string(JobState state) {
  switch (state) {
    case JobState::queued:
      return "queued";
    case JobState::running:
      return "running";
    case JobState::succeeded:
      return "succeeded";
    case JobState::partial:
      return "partial";
    case JobState::failed:
      return "failed";
    case JobState::cancelled:
      break;
  }
  return "cancelled";
}

std::string_view to_string(JobEvent event) {
  switch (event) {
    case JobEvent::start:
      return "started";
    case JobEvent::resume:
      return "resumed";
    case JobEvent::succeed:
      return "succeeded";
    case JobEvent::succeed_partly:
      return "partial";
    case JobEvent::fail:
      return "failed";
    case JobEvent::cancel:
      return "cancelled";
    case JobEvent::retry:
      break;
  }
  return "retried";
}

std::optional<JobState> job_state_named(std::string_view name) {
  for (const JobState state : kJobStates) {
    if (to_string(state) == name) return state;
  }
  return std::nullopt;
}

}  // namespace throng::jobs
