// Actions of two people of a group and one more, whose trajectories are known.
#include "annotate/people/actions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/render/synthetic_people.h"

namespace throng::annotate {
namespace {

constexpr double kActionStepS = 0.1;

/// Over 20 s: 0 walks along +x past 1, which stands at (10, 1) for 10 s, falls and lies. 2 stands
/// far away. 0 and 1 are of one group.
world::Trace walk_past() {
  world::Trace trace;
  trace.header.dt_s = kActionStepS;
  trace.header.seed = 5;
  trace.header.role.assign(3, world::AgentRole::person);
  trace.header.radius_m.assign(3, 0.3F);
  trace.header.group = {0, 0, -1};
  for (int step = 0; step <= 200; ++step) {
    trace.time_s.push_back(kActionStepS * step);
    trace.position.emplace_back(0.13F * static_cast<float>(step), 0);
    trace.position.emplace_back(10, 1);
    trace.position.emplace_back(40, 40);
    trace.velocity.emplace_back(1.3F, 0);
    trace.velocity.emplace_back(0, 0);
    trace.velocity.emplace_back(0, 0);
    trace.yaw_rad.insert(trace.yaw_rad.end(), 3, 0);
    const std::uint8_t flags = world::kPresent | (step >= 100 ? world::kFallen : 0);
    trace.flags.push_back(world::kPresent);
    trace.flags.push_back(flags);
    trace.flags.push_back(world::kPresent);
  }
  return trace;
}

struct ActionRow {
  std::string track;
  std::string action;
  std::string other;
  double from_s = 0;
  double to_s = 0;
};

std::vector<ActionRow> read_rows(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "track_id,action,other,from_s,to_s");
  std::vector<ActionRow> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    ActionRow& row = rows.emplace_back();
    std::string from;
    std::string to;
    std::getline(cells, row.track, ',');
    std::getline(cells, row.action, ',');
    std::getline(cells, row.other, ',');
    std::getline(cells, from, ',');
    std::getline(cells, to, ',');
    row.from_s = std::stod(from);
    row.to_s = std::stod(to);
  }
  return rows;
}

class ActionsTest : public ::testing::Test {
 protected:
  std::vector<ActionRow> rows(double from_s, double to_s) const {
    return read_rows(actions_csv(trace_, animator_, facts_, from_s, to_s, 2));
  }

  static skinning::Population people_with_clips() {
    skinning::Population people = render::synthetic_people();
    people.clips = {{"idle", 0, 0, 8},
                    {"walk", 1.3F, 8, 20, 0.8F, 0.25F},
                    {"fall_forwards", 0, 28, 16, 0, 0, false},
                    {"fall_backwards", 0, 44, 16, 0, 0, false}};
    return people;
  }

  skinning::Population people_ = people_with_clips();
  world::Trace trace_ = walk_past();
  render::Animator animator_{trace_, people_};
  ActionFacts facts_{trace_, people_, {}};
};

TEST_F(ActionsTest, OfASingleFrameBetweenStepsAreThoseOfBoth) {
  const double step_s = trace_.time_s.at(1);
  const double time_s = 5.5 * step_s;
  int walks = 0;
  for (const ActionRow& row : rows(time_s, time_s)) {
    if (row.track != "2000001" || row.action != "walk") continue;
    ++walks;
    EXPECT_NEAR(row.from_s, 5 * step_s, 1e-9);
    EXPECT_NEAR(row.to_s, 6 * step_s, 1e-9);
  }
  EXPECT_EQ(walks, 1);
}

TEST_F(ActionsTest, OfTheRunHaveTimes) {
  bool walks = false;
  double lies_from_s = 0;
  double stands_to_s = 0;
  for (const ActionRow& row : rows(0, 20)) {
    if (row.track == "2000001" && row.action == "walk") {
      walks = true;
      EXPECT_EQ(row.from_s, 0);
      EXPECT_EQ(row.to_s, 20);
    }
    if (row.track == "2000002" && row.action == "stand") {
      stands_to_s = std::max(stands_to_s, row.to_s);
    }
    if (row.track == "2000002" && row.action == "lie") lies_from_s = row.from_s;
    EXPECT_FALSE(row.track == "2000003" && row.action == "walk");
  }
  EXPECT_TRUE(walks);
  EXPECT_NEAR(stands_to_s, 10, 0.3);
  EXPECT_GT(lies_from_s, 10.3) << "falling takes its time";
  EXPECT_LT(lies_from_s, 13);
}

TEST_F(ActionsTest, GroupsAreTogetherWithinThreeMeters) {
  const auto found = rows(0, 20);
  const auto is_together = [](const ActionRow& row) { return row.action == "together"; };
  ASSERT_EQ(std::count_if(found.begin(), found.end(), is_together), 2) << "one for each of them";
  const auto row = std::find_if(found.begin(), found.end(), is_together);
  EXPECT_EQ(row->track, "2000001");
  EXPECT_EQ(row->other, "2000002");
  // sqrt(9 - 1) = 2.83 m before and after x = 10, at 1.3 m/s.
  EXPECT_NEAR(row->from_s, (10 - 2.83) / 1.3, 0.11);
  EXPECT_NEAR(row->to_s, (10 + 2.83) / 1.3, 0.11);
}

TEST_F(ActionsTest, AreCutToTheFrames) {
  for (const ActionRow& row : rows(4, 6)) {
    EXPECT_GE(row.from_s, 4 - 1e-6);
    EXPECT_LE(row.to_s, 6 + 1e-6);
    EXPECT_NE(row.action, "lie");
  }
}

TEST_F(ActionsTest, OfImagesAreThoseOfTheirTime) {
  FrameLabels labels;
  for (const render::PersonInstance& person : animator_.scene_at(15, 0).people) {
    PersonLabel& label = labels.people.emplace_back();
    label.agent = person.agent;
    label.person.agent = person.agent;
    label.person.actions = person.actions;
  }
  add_actions(facts_, 9, labels);
  ASSERT_EQ(labels.people.size(), 3U);
  const auto does = [&](std::size_t person, std::string_view name) {
    const auto& names = labels.people[person].actions->names;
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  EXPECT_TRUE(does(0, "walk"));
  EXPECT_TRUE(does(1, "lie"));
  EXPECT_TRUE(does(2, "stand"));
  EXPECT_EQ(labels.people[0].actions->together_with, (std::vector<std::uint32_t>{1}));
  EXPECT_TRUE(labels.people[2].actions->together_with.empty());
}

}  // namespace
}  // namespace throng::annotate
