// Recorded boundary conditions repeated with models.
#include "validation/experiments/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/files/files.h"
#include "tests/validation/experiments/recordings.h"
#include "tests/world/temporary_folder.h"
#include "validation/experiments/comparison.h"

namespace throng::validation {
namespace {

using testing::TemporaryFolder;

/// A corridor of 20 m; its recording is a file of the folder.
Experiment recorded(const TemporaryFolder& folder, const std::vector<Straight>& people) {
  Experiment experiment;
  experiment.name = "corridor";
  experiment.free_speeds = {1.2, 0};
  experiment.recording = corridor();
  experiment.recording->file = folder.write("walk.txt", recording_text(people));
  return experiment;
}

TEST(Replay, LetsOnePersonWalkAtTheFreeSpeed) {
  const TemporaryFolder folder;
  // The recorded one is slower: the model must not follow the recording.
  const Replay replay(recorded(folder, {{2, {1, 1}, {0.8, 0}, 20}}));
  EXPECT_NEAR(value(replay.recorded(), "speed"), 0.8, 1e-3);
  for (const char* model : {"ttc", "orca"}) {
    const Measures measures = replay.simulate({model}, 1);
    ASSERT_EQ(measures.passages_s.size(), 1U) << model;
    // The first frame of the file is that in which the person appears.
    EXPECT_NEAR(measures.passages_s[0], 9 / 1.2, 0.6) << model << ", from standing";
    EXPECT_NEAR(value(measures, "speed"), 1.2, 0.02) << model;
  }
}

TEST(Replay, TakesAnyFreeSpeedsOfTheFile) {
  const TemporaryFolder folder;
  Experiment experiment = recorded(folder, {{0, {1, 1}, {1, 0}, 18}});
  for (const FreeSpeeds speeds : {FreeSpeeds{0.3, 0},
                                  {0.3, 2},
                                  {2.5, 0},
                                  {2.5, 2},
                                  {1, 1e-9},
                                  {0.3, 0.0011},
                                  {2.5, 0.0011}}) {
    experiment.free_speeds = speeds;
    EXPECT_EQ(Replay(experiment).simulate({"orca"}, 1).passages_s.size(), 1U)
        << speeds.mean_mps << " " << speeds.stddev_mps;
  }
}

TEST(Replay, KeepsRecordedArrivals) {
  const std::vector<Straight> people = {
      {0, {1, 0.5}, {1, 0}, 15}, {3.3, {2, 1.5}, {1, 0}, 15}, {7, {1, 1}, {1, 0}, 15}};
  const TemporaryFolder folder;
  const Experiment experiment = recorded(folder, people);
  Walks walks{0.1, {}};
  for (const Straight& person : people) walks.people.push_back(straight_walk(person, 0.1));
  for (const char* model : {"ttc", "helbing"}) {
    const Walks replayed =
        replayed_walks(*experiment.recording, walks, experiment.free_speeds, {model}, 3);
    ASSERT_EQ(replayed.people.size(), people.size());
    for (std::size_t i = 0; i < people.size(); ++i) {
      ASSERT_FALSE(replayed.people[i].places.empty()) << model;
      EXPECT_NEAR(0.1 * static_cast<double>(replayed.people[i].first_step), people[i].from_s, 0.11)
          << model << " " << i;
      EXPECT_NEAR((replayed.people[i].places.front() - people[i].place).norm(), 0, 0.2)
          << model << " " << i;
      EXPECT_GT(replayed.people[i].places.back().x(), 17) << "the goal";
    }
  }
}

TEST(Replay, WalksToTheGoalOfEachStream) {
  const TemporaryFolder folder;
  Experiment experiment =
      recorded(folder, {{0, {1, 0.5}, {1, 0}, 15}, {0, {19, 1.5}, {-1, 0}, 15}});
  experiment.recording->goals.push_back({Eigen::Vector2d(0.5, 0.2), Eigen::Vector2d(1.5, 1.8)});
  const Replay replay(experiment);
  const Measures measures = replay.simulate({"ttc"}, 1);
  EXPECT_EQ(measures.passages_s.size(), 2U) << "both come past the middle";
  EXPECT_EQ(measures.quantities.size(), replay.recorded().quantities.size());
}

TEST(Replay, IgnoresGoalsThatNobodyWalksTo) {
  const TemporaryFolder folder;
  Experiment experiment = recorded(
      folder, {{0, {19, 1}, {-1, 0}, 18}, {1, {19, 1}, {-1, 0}, 18}, {2, {19, 1}, {-1, 0}, 18}});
  experiment.recording->goals.push_back({Eigen::Vector2d(0.5, 0.2), Eigen::Vector2d(1.5, 1.8)});
  const Replay replay(experiment);
  EXPECT_EQ(replay.experiment().recording->goals.size(), 1U);
  EXPECT_EQ(replay.recorded().quantities.front().name, "flow");
  EXPECT_EQ(replay.simulate({"orca"}, 1).passages_s.size(), 3U) << "they reach the used one";
}

TEST(Replay, AvoidsObstaclesOfTheRecording) {
  const TemporaryFolder folder;
  Experiment experiment = recorded(folder, {{0, {1, 1}, {1, 0}, 18}});
  experiment.recording->obstacles = {{{9.5, 0.6}, {10.5, 0.6}, {10.5, 2}, {9.5, 2}}};
  Walks walks{0.1, {straight_walk({0, {1, 1}, {1, 0}, 18}, 0.1)}};
  const Walks replayed =
      replayed_walks(*experiment.recording, walks, experiment.free_speeds, {"ttc"}, 1);
  for (const Eigen::Vector2d& place : replayed.people.at(0).places) {
    EXPECT_FALSE(std::abs(place.x() - 10) < 0.5 && place.y() > 0.6) << place.transpose();
  }
  EXPECT_GT(replayed.people.at(0).places.back().x(), 17);
}

void expect_refused(const Experiment& experiment, const std::vector<std::string>& words) {
  try {
    const Replay replay(experiment);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    for (const std::string& word : words) EXPECT_THAT(error.what(), ::testing::HasSubstr(word));
  }
}

TEST(Replay, RefusesRecordingsThatDoNotFit) {
  const TemporaryFolder folder;
  const Experiment sound = recorded(folder, {{0, {1, 1}, {1, 0}, 18}});
  Experiment wrong = sound;
  wrong.recording->format.unit_m = 100;
  expect_refused(wrong,
                 {"walk.txt", "nobody on the walkable ground", "[100.00, 100.00] m", "unit"});
  wrong = sound;
  wrong.recording->steady = TimeRange{5, 30};
  expect_refused(wrong, {"walk.txt", "corridor", "18.0 s", "until 30 s"});
  wrong = sound;
  wrong.recording->format.frames_per_s = 0.02;
  expect_refused(wrong, {"walk.txt", "9000 s", "frame rate"});
  wrong = sound;
  wrong.recording->file = folder.write("damaged.txt.gz", "\x1f\x8bnothing");
  expect_refused(wrong, {"damaged.txt.gz", "a damaged gzip file"});
  wrong = sound;
  wrong.recording->file = folder.write("words.txt", "# framerate: 10\n1 0 0.5 here\n");
  expect_refused(wrong, {"words.txt", "line 2"});
}

Experiment in_single_file(const TemporaryFolder& folder) {
  // 1 m apart at 0.5 m/s: 20 people fill 20 m.
  std::vector<Straight> people;
  for (int i = 0; i < 30; ++i) people.push_back({0, {-1.0 * i, 0}, {0.5, 0}, 40});
  Experiment experiment;
  experiment.name = "file";
  experiment.single_file = {folder.write("file.txt", recording_text(people)), {}, 20, 0.8, 0, 1};
  return experiment;
}

TEST(Replay, MeasuresSingleFileAsALoop) {
  const TemporaryFolder folder;
  const Replay replay(in_single_file(folder));
  ASSERT_EQ(replay.recorded().quantities.size(), 1U);
  const Quantity& flow = replay.recorded().quantities[0];
  EXPECT_NEAR(flow.at_density, 1 / 0.8, 0.15) << "1 person per meter, 0.8 m wide";
  EXPECT_NEAR(flow.value, flow.at_density * 0.5, 0.03);
  const Measures simulated = replay.simulate({"ttc"}, 1);
  ASSERT_EQ(simulated.quantities.size(), 1U);
  EXPECT_EQ(simulated.quantities[0].name, flow.name);
  EXPECT_GT(simulated.quantities[0].value, 0);
}

TEST(Replay, MeasuresSingleFileWhereItWasFilmed) {
  // Two cameras see other parts of the straight: the density is that of the people, not of the
  // ground that one of them does not see.
  const TemporaryFolder folder;
  for (const double from_x_m : {-1.0, 6.0}) {
    std::string text = "# framerate: 10\n";
    for (int frame = 1; frame <= 200; ++frame) {
      for (int person = 0; person < 60; ++person) {
        // 0.8 m apart at 0.5 m/s.
        const double x_m = 0.5 * 0.1 * frame - 0.8 * person + 14;
        if (x_m < from_x_m || x_m > from_x_m + 3) continue;
        text += std::to_string(person) + " " + std::to_string(frame) + " " + std::to_string(x_m) +
                " 0\n";
      }
    }
    Experiment experiment;
    experiment.name = "file";
    experiment.single_file = {folder.write("camera.txt", text), {}, 20, 0.8, 0, 0};
    const Replay replay(experiment);
    ASSERT_EQ(replay.recorded().quantities.size(), 1U);
    EXPECT_NEAR(replay.recorded().quantities[0].at_density, 1 / 0.8 / 0.8, 0.1) << from_x_m;
  }
}

TEST(Replay, RefusesASingleFileWithoutPeople) {
  const TemporaryFolder folder;
  Experiment experiment = in_single_file(folder);
  experiment.single_file->from_x_m = 100;
  experiment.single_file->until_x_m = 110;
  expect_refused(experiment, {"file.txt", "x = 100 to 110 m", "0 people per meter"});
  experiment = in_single_file(folder);
  experiment.single_file->people = 1;
  expect_refused(experiment, {"file.txt", "1 people would fill"});
}

TEST(Replay, IsCancelled) {
  const TemporaryFolder folder;
  const Replay replay(recorded(folder, {{0, {1, 1}, {1, 0}, 18}}));
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(replay.simulate({"ttc"}, 1, source.get_token()), Cancelled);
}

TEST(Comparison, DoesNotDependOnThreads) {
  const TemporaryFolder folder;
  std::vector<Straight> people;
  for (int i = 0; i < 20; ++i) people.push_back({0.6 * i, {1, i % 2 == 0 ? 0.6 : 1.4}, {1, 0}, 18});
  std::vector<Experiment> experiments = {recorded(folder, people), {}};
  experiments[1].name = "loop";
  experiments[1].loop = Loop{20, 2, {{0.5, 1.2}, {1, 1}}};
  std::vector<Comparison> results;
  std::size_t calls = 0;
  for (const int threads : {1, 4}) {
    results.push_back(compare(experiments, {{"ttc"}, {"orca"}}, 3, threads,
                              [&](std::size_t done, std::size_t total) {
                                ++calls;
                                EXPECT_EQ(total, 12U);
                                EXPECT_LE(done, total);
                              }));
  }
  EXPECT_EQ(calls, 24U);
  ASSERT_EQ(results[0].experiments.size(), 2U);
  for (std::size_t e = 0; e < 2; ++e) {
    const ComparedExperiment& one = results[0].experiments[e];
    const ComparedExperiment& four = results[1].experiments[e];
    ASSERT_EQ(one.quantities.size(), four.quantities.size());
    EXPECT_EQ(one.passages_s, four.passages_s);
    for (std::size_t q = 0; q < one.quantities.size(); ++q) {
      for (std::size_t m = 0; m < 2; ++m) {
        EXPECT_EQ(one.quantities[q].models[m].values, four.quantities[q].models[m].values);
        EXPECT_EQ(one.quantities[q].models[m].values.size(), 3U);
      }
    }
  }
  EXPECT_EQ(results[0].experiments[0].people, 20U);
  EXPECT_EQ(results[0].experiments[1].people, 0U);
  EXPECT_TRUE(results[0].experiments[1].curve_differences.empty());
}

TEST(Sample, HasAnIntervalOfStudentsT) {
  EXPECT_DOUBLE_EQ((Sample{{1, 2, 3, 4}}.mean()), 2.5);
  // t of 3 degrees of freedom at 97.5 %: 3.182446; standard deviation 1.290994.
  EXPECT_NEAR((Sample{{1, 2, 3, 4}}.half_interval()), 3.182446 * 1.290994 / 2, 1e-5);
  EXPECT_EQ((Sample{{5}}.half_interval()), 0);
}

}  // namespace
}  // namespace throng::validation
