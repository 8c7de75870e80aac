// The queue model against people's choice of exits.
#include "sim/policies/queue_model.h"

#include <gtest/gtest.h>

#include "tests/sim/yard.h"

namespace throng::sim {
namespace {

using Eigen::Vector2d;
using testing::people_about;
using testing::yard;

/// The yard with a third door, next to the left one.
world::Scenario yard_with_third_door(bool open) {
  world::Scenario scenario = yard();
  scenario.exits.push_back({"third", {-20, 9}, {-20, 11}, {-1, 0}, open, {{3, 2}}});
  return scenario;
}

WorldView make_view(const world::Scenario& scenario, std::vector<PersonSeen> people) {
  WorldView view;
  view.people = std::move(people);
  view.exit_flow_per_s.resize(scenario.exits.size());
  return view;
}

TEST(QueueModel, PeopleAtAClosedDoorJoinTheQueueOfTheNearestOpenOne) {
  const world::Scenario scenario = yard_with_third_door(false);
  const std::vector<PersonSeen> people = people_about({-5, 5}, 40, 2);
  QueueModel queues(scenario);
  queues.update(make_view(scenario, people), 0);
  EXPECT_EQ(queues.ends_up_at(people.front()), 0);
  EXPECT_NEAR(queues.wait_s(0), 40 / queues.capacity_per_s(0), 1e-9);
  EXPECT_EQ(queues.wait_s(1), 0);
  EXPECT_GT(queues.wait_s(2), 500) << "nobody should be led there";
}

TEST(QueueModel, ADoorThatADisasterReachesIsShutFromThenOn) {
  world::Scenario scenario = yard_with_third_door(true);
  scenario.exits[2].closes_at_s = 10;
  QueueModel queues(scenario);
  WorldView view = make_view(scenario, people_about({-5, 5}, 40, 2));
  view.time_s = 9.9;
  queues.update(view, 0);
  EXPECT_EQ(queues.ends_up_at(view.people.front()), 2);
  EXPECT_NEAR(queues.wait_s(2), 40 / queues.capacity_per_s(2), 1e-9);
  view.time_s = 10;
  queues.update(view, 0);
  EXPECT_FALSE(queues.is_open(2));
  EXPECT_EQ(queues.ends_up_at(view.people.front()), 0);
  EXPECT_GT(queues.wait_s(2), 500);
}

TEST(QueueModel, PeopleWhoHaveNotNoticedAreExpectedAtTheNearestOpenExit) {
  const world::Scenario scenario = yard_with_third_door(false);
  QueueModel queues(scenario);
  queues.update(make_view(scenario, people_about({-15, 10}, 30, -1)), 0);
  EXPECT_GT(queues.wait_s(0), 20 / queues.capacity_per_s(0));
  EXPECT_EQ(queues.wait_s(1), 0);
}

TEST(QueueModel, LearnsWherePeopleRunFromWhereTheyAre) {
  // Half of the people beside the left door run to the right one, as if informed so; those who have
  // not noticed will do alike.
  const world::Scenario scenario = yard();
  std::vector<PersonSeen> people = people_about({-8, 0}, 20, 0);
  for (std::size_t i = 0; i < people.size(); i += 2) people[i].exit = 1;
  for (const PersonSeen& person : people_about({-8, 10}, 50, -1)) people.push_back(person);
  const WorldView view = make_view(scenario, people);
  QueueModel queues(scenario);
  queues.update(view, 0);
  const double at_first_s = queues.wait_s(1);
  for (int i = 0; i < 200; ++i) queues.update(view, 0);
  EXPECT_GT(queues.wait_s(1), 2 * at_first_s);
  EXPECT_NEAR(queues.wait_s(1) * queues.capacity_per_s(1), 10 + 0.8 * 50 * 0.5, 3);
}

}  // namespace
}  // namespace throng::sim
