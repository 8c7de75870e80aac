#include "sim/people/people_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/sim/yard.h"

namespace throng::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::uint8_t kCalm = 0;
constexpr std::uint8_t kAware = 1;

/// Twenty people in the yard, seen every second.
class Watched : public ::testing::Test {
 protected:
  Watched() {
    header.state_names = {"Calm", "Flee"};
    header.role.assign(20, world::AgentRole::person);
    header.alarm = world::Alarm{10.0, {"Flee"}};
    now.position.assign(20, {1, 2});
    now.state.assign(20, kCalm);
    now.exit_intent.assign(20, -1);
    now.flags.assign(20, world::kPresent);
  }

  /// The warnings about a run in which people, from a time on, are as `later` makes them.
  template <typename Later>
  std::vector<std::string> said(double end_s, double later_s, const Later& later,
                                std::optional<double> images_from_s = {}) {
    PeopleWatch watch(scenario, header, images_from_s);
    world::CrowdStep step = now;
    for (double time_s = 0; time_s <= end_s; time_s += 1) {
      step.time_s = time_s;
      if (time_s == later_s) later(step);
      watch.look(step);
    }
    std::vector<std::string> texts;
    for (const Problem& warning : watch.warnings()) {
      texts.push_back(warning.where + " " + warning.found);
    }
    return texts;
  }
  std::vector<std::string> said(double end_s) {
    return said(end_s, -1, [](world::CrowdStep&) {});
  }

  /// The first of the people know, head for an exit and walk.
  static void flee(world::CrowdStep& step, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      step.state[i] = kAware;
      step.exit_intent[i] = 0;
      step.position[i] = {-9, 2};
    }
  }

  world::Scenario scenario = testing::yard();
  world::TraceHeader header;
  world::CrowdStep now;
};

TEST_F(Watched, FleeingPeopleCauseNoWarning) {
  EXPECT_THAT(said(60, 12, [](auto& step) { flee(step, 20); }), IsEmpty());
  EXPECT_THAT(said(60, 12, [](auto& step) { flee(step, 2); }), IsEmpty()) << "some do";
}

TEST_F(Watched, AnAlarmThatNobodyNotices) {
  EXPECT_THAT(said(60), ElementsAre("/scenario an alarm at 10 s that none of 20 people noticed "
                                    "until 60 s"));
  EXPECT_THAT(said(60, 12, [](auto& step) { flee(step, 1); }),
              ElementsAre(HasSubstr("only 1 of 20 people noticed")));
}

TEST_F(Watched, ARunThatEndsSoonAfterTheAlarmSaysNothing) { EXPECT_THAT(said(19), IsEmpty()); }

TEST_F(Watched, ARunThatEndsBeforeTheAlarm) {
  EXPECT_THAT(said(9), ElementsAre("/capture/to_s an end at 9 s, before the alarm at 10 s"));
  EXPECT_THAT(said(
                  9, -1, [](auto&) {}, 2),
              IsEmpty())
      << "with images";
}

TEST_F(Watched, AwarePeopleWithoutAnExit) {
  EXPECT_THAT(said(60, 12, [](auto& step) { step.state.assign(20, kAware); }),
              ElementsAre(HasSubstr("none of 20 people who head for an exit")));
  EXPECT_THAT(said(60, 12,
                   [](auto& step) {
                     flee(step, 20);
                     step.exit_intent.assign(20, -1);
                     step.flags.assign(20, world::kPresent | world::kFollowing);
                   }),
              IsEmpty())
      << "behind a guide";
}

TEST_F(Watched, PeopleThatNeverMove) {
  const auto stay = [](auto& step) {
    flee(step, 20);
    step.position.assign(20, {1.5F, 2.5F});
  };
  EXPECT_THAT(said(60, 12, stay), ElementsAre(HasSubstr("none of 20 people who move by more")));
  header.alarm.reset();
  EXPECT_THAT(said(60), ElementsAre(HasSubstr("from 0 s to 60 s")));
  EXPECT_THAT(said(60, 12,
                   [](auto& step) {
                     step.position[7] = {3, 2};
                   }),
              IsEmpty())
      << "an audience may stand";
}

TEST_F(Watched, WithoutAwareStatesANewExitIsNotice) {
  header.alarm->aware_states.clear();
  now.exit_intent.assign(20, 1);
  const auto walk = [](auto& step) { step.position.assign(20, {9, 2}); };
  EXPECT_THAT(said(60, 12, walk), ElementsAre(HasSubstr("none of 20 people noticed")));
  EXPECT_THAT(said(60, 12,
                   [&](auto& step) {
                     walk(step);
                     step.exit_intent.assign(20, 0);
                   }),
              IsEmpty());
}

TEST_F(Watched, PeopleThatStartOutside) {
  for (std::size_t i = 0; i < 3; ++i) now.position[i] = {30, 0};
  const auto texts = said(60, 12, [](auto& step) { flee(step, 20); });
  EXPECT_THAT(texts, ElementsAre(HasSubstr("3 of 20 people who start outside")));
  now.position.assign(20, {30, 0});
  EXPECT_THAT(said(60), ElementsAre(HasSubstr("20 of 20 people who start outside"),
                                    HasSubstr("nobody inside at the alarm, at 10 s")));
}

TEST_F(Watched, ImagesOfAPlaceThatEverybodyHasLeft) {
  const auto leave = [](auto& step) {
    flee(step, 20);
    step.position.assign(20, {-30, 0});
  };
  const auto run = [&](double leave_s, double images_from_s) {
    header.alarm->at_s = 0;
    return said(60, leave_s, leave, images_from_s);
  };
  now.state.assign(20, kAware);
  now.exit_intent.assign(20, 0);
  EXPECT_THAT(run(30, 40), ElementsAre(HasSubstr("none of 20 people who move"),
                                       "/capture/from_s images from 40 s on, when everybody has "
                                       "left (at 29 s)"));
  EXPECT_THAT(run(30, 20), ElementsAre(HasSubstr("none of 20 people who move")));
}

TEST_F(Watched, DangersAndAbsentPeopleDoNotCount) {
  header.role.assign(20, world::AgentRole::disaster);
  header.role[3] = world::AgentRole::person;
  header.role[4] = world::AgentRole::person;
  now.flags[4] = 0;
  EXPECT_THAT(said(60), ElementsAre(HasSubstr("none of 1 person noticed")));
  now.flags[3] = 0;
  EXPECT_THAT(said(60), IsEmpty());
}

TEST_F(Watched, RecordedPeopleNoticeNothingAndMayStand) {
  header.crowd.model = world::kRecordedCrowd;
  EXPECT_THAT(said(60), IsEmpty());
}

}  // namespace
}  // namespace throng::sim
