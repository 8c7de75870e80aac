#include "jobs/queue/store/state.h"

#include <gtest/gtest.h>

namespace throng::jobs {
namespace {

using enum JobState;
using enum JobEvent;

TEST(State, EveryStateAndEvent) {
  constexpr std::optional<JobState> kNone;
  // Rows as kJobStates; columns: start, resume, succeed, succeed_partly, fail, cancel, retry.
  const std::array<std::array<std::optional<JobState>, kJobEvents.size()>, kJobStates.size()>
      expected = {{
          {running, kNone, kNone, kNone, kNone, cancelled, kNone},
          {kNone, running, succeeded, partial, failed, cancelled, kNone},
          {kNone, kNone, kNone, kNone, kNone, kNone, kNone},
          {kNone, kNone, kNone, kNone, kNone, kNone, queued},
          {kNone, kNone, kNone, kNone, kNone, kNone, queued},
          {kNone, kNone, kNone, kNone, kNone, kNone, queued},
      }};
  for (std::size_t s = 0; s < kJobStates.size(); ++s) {
    for (std::size_t e = 0; e < kJobEvents.size(); ++e) {
      EXPECT_EQ(next_state(kJobStates[s], kJobEvents[e]), expected[s][e]) << s << " " << e;
    }
  }
}

TEST(State, AJobThatHasEndedCanAtMostBeTriedAgain) {
  for (const JobState state : kJobStates) {
    bool moves = false;
    for (const JobEvent event : kJobEvents) {
      moves |= event != JobEvent::retry && next_state(state, event).has_value();
    }
    EXPECT_EQ(moves, is_active(state)) << to_string(state);
  }
}

TEST(State, NamesReadBack) {
  for (const JobState state : kJobStates) EXPECT_EQ(job_state_named(to_string(state)), state);
  EXPECT_FALSE(job_state_named("paused"));
}

}  // namespace
}  // namespace throng::jobs
