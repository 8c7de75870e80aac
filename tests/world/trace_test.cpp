#include "world/trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "tests/world/temporary_folder.h"

namespace throng::world {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using throng::testing::TemporaryFolder;

constexpr std::size_t kAgents = 7;
// More than two chunks, and not a whole number of them.
constexpr std::size_t kSteps = 150;

TraceHeader make_header(std::size_t agents) {
  TraceHeader header;
  header.scenario_id = "town/yard";
  header.generator = "throng test";
  header.seed = 0xfedcba9876543210U;
  header.dt_s = 0.1;
  header.state_names = {"Walk", "Läuft zum Ausgang", "Done"};
  header.exit_ids = {"a", "b"};
  header.drone_ids = {"d1", "second"};
  for (std::size_t i = 0; i < agents; ++i) {
    header.role.push_back(static_cast<AgentRole>(i % 3));
    header.radius_m.push_back(0.2F + 0.01F * static_cast<float>(i));
    header.pref_speed_mps.push_back(1.0F + 0.1F * static_cast<float>(i));
    header.group.push_back(static_cast<std::int32_t>(i / 2) - 1);
  }
  return header;
}

CrowdStep make_step(std::size_t step, std::size_t agents) {
  CrowdStep crowd;
  crowd.time_s = 0.1 * static_cast<double>(step);
  for (std::size_t i = 0; i < agents; ++i) {
    const auto phase = static_cast<float>(step * agents + i);
    crowd.position.emplace_back(std::sin(phase), phase);
    crowd.velocity.emplace_back(-phase, std::cos(phase));
    crowd.yaw_rad.push_back(0.1F * phase);
    crowd.desired_speed_mps.push_back(phase / 7);
    crowd.state.push_back(static_cast<std::uint8_t>((step + i) % 3));
    crowd.exit_intent.push_back(static_cast<std::int8_t>((step + i) % 3) - 1);
    crowd.flags.push_back(static_cast<std::uint8_t>((step + i) % 4));
  }
  return crowd;
}

DroneSample drone_sample_at(double time_s) {
  return {time_s,
          {time_s, 2 * time_s, 10},
          {1, 2, 0},
          Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * time_s, Eigen::Vector3d::UnitZ())),
          {0, 0, 0.125},
          {0.5, 0, 9.75},
          {-2, time_s, 0},
          100 * time_s};
}

void write_trace(const fs::path& path, std::size_t agents = kAgents, std::size_t steps = kSteps) {
  TraceWriter writer(path, make_header(agents));
  for (std::size_t step = 0; step < steps; ++step) {
    writer.add(make_step(step, agents));
    for (int i = 0; i < 8; ++i) {
      writer.add_drone(0, drone_sample_at(0.1 * static_cast<double>(step) + i / 80.0));
    }
    if (step % 10 == 0 && agents > 5) {
      writer.add_event({0.1 * static_cast<double>(step), AgentEscaped{5, 1}});
    }
  }
  if (agents > 5)
    // Earlier than the last one.
    writer.add_event({0, Collision{0, Partner::person, 3, 4.5, 0.25}});
  writer.add_event({99, TiltSaturated{1, 2}});
  writer.finish();
}

std::string caught_problem(const fs::path& path) {
  try {
    read_trace(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Trace, ReadsBackTheWrittenValues) {
  const TemporaryFolder folder;
  write_trace(folder.path() / "run.h5");
  const Trace trace = read_trace(folder.path() / "run.h5");

  const TraceHeader expected = make_header(kAgents);
  EXPECT_EQ(trace.header.scenario_id, expected.scenario_id);
  EXPECT_EQ(trace.header.generator, expected.generator);
  EXPECT_EQ(trace.header.seed, expected.seed);
  EXPECT_EQ(trace.header.dt_s, expected.dt_s);
  EXPECT_EQ(trace.header.state_names, expected.state_names);
  EXPECT_EQ(trace.header.exit_ids, expected.exit_ids);
  EXPECT_EQ(trace.header.drone_ids, expected.drone_ids);
  EXPECT_EQ(trace.header.role, expected.role);
  EXPECT_EQ(trace.header.radius_m, expected.radius_m);
  EXPECT_EQ(trace.header.pref_speed_mps, expected.pref_speed_mps);
  EXPECT_EQ(trace.header.group, expected.group);

  ASSERT_EQ(trace.steps(), kSteps);
  ASSERT_EQ(trace.position.size(), kSteps * kAgents);
  for (std::size_t step = 0; step < kSteps; ++step) {
    const CrowdStep crowd = make_step(step, kAgents);
    EXPECT_DOUBLE_EQ(trace.time_s[step], crowd.time_s);
    for (std::size_t i = 0; i < kAgents; ++i) {
      const std::size_t at = trace.at(step, i);
      EXPECT_EQ(trace.position[at], crowd.position[i]);
      EXPECT_EQ(trace.velocity[at], crowd.velocity[i]);
      EXPECT_EQ(trace.yaw_rad[at], crowd.yaw_rad[i]);
      EXPECT_EQ(trace.desired_speed_mps[at], crowd.desired_speed_mps[i]);
      EXPECT_EQ(trace.state[at], crowd.state[i]);
      EXPECT_EQ(trace.exit_intent[at], crowd.exit_intent[i]);
      EXPECT_EQ(trace.flags[at], crowd.flags[i]);
      EXPECT_EQ(trace.present(step, i), (crowd.flags[i] & kPresent) != 0);
    }
  }

  ASSERT_EQ(trace.drones.size(), 2U);
  ASSERT_EQ(trace.drones[0].size(), 8 * kSteps);
  EXPECT_TRUE(trace.drones[1].empty());
  const DroneSample& sample = trace.drones[0][1000];
  const DroneSample written = drone_sample_at(sample.time_s);
  EXPECT_LT((sample.position - written.position).norm(), 1e-6);
  EXPECT_LT((sample.velocity - written.velocity).norm(), 1e-6);
  EXPECT_LT((sample.orientation.coeffs() - written.orientation.coeffs()).norm(), 2e-9);

  EXPECT_EQ(sample.body_rates.z(), 0.125);
  EXPECT_EQ(sample.specific_force, drone_sample_at(0).specific_force);
  EXPECT_NEAR(sample.air_velocity.y(), sample.time_s, 1e-4);
  EXPECT_NEAR(sample.energy_j, 100 * sample.time_s, 1e-6);

  ASSERT_EQ(trace.events.size(), kSteps / 10 + 2);
  EXPECT_TRUE(
      std::is_sorted(trace.events.begin(), trace.events.end(),
                     [](const TraceEvent& a, const TraceEvent& b) { return a.time_s < b.time_s; }));
  EXPECT_EQ(std::get<AgentEscaped>(trace.events[3].kind).agent, 5);
  EXPECT_EQ(std::get<AgentEscaped>(trace.events[3].kind).exit, 1);
  const Collision& collision = std::get<Collision>(trace.events[1].kind);
  EXPECT_EQ(collision.partner, Partner::person);
  EXPECT_EQ(collision.index, 3);
  EXPECT_EQ(collision.impulse_ns, 0.25);
  EXPECT_EQ(std::get<TiltSaturated>(trace.events.back().kind).drone, 1);
  EXPECT_EQ(std::get<TiltSaturated>(trace.events.back().kind).off_m, 2);
}

TEST(Trace, EqualRunsGiveEqualBytes) {
  const TemporaryFolder folder;
  write_trace(folder.path() / "one.h5");
  write_trace(folder.path() / "two.h5");
  EXPECT_EQ(sha256_hex_of_file(folder.path() / "one.h5"),
            sha256_hex_of_file(folder.path() / "two.h5"));
}

TEST(Trace, MayHaveNoAgentsNoStepsOrVeryMany) {
  const TemporaryFolder folder;
  for (const auto& [agents, steps] :
       {std::pair{0, 3}, std::pair{3, 0}, std::pair{0, 0}, std::pair{200'000, 3}}) {
    const fs::path path = folder.path() / "run.h5";
    write_trace(path, static_cast<std::size_t>(agents), static_cast<std::size_t>(steps));
    const Trace trace = read_trace(path);
    EXPECT_EQ(trace.agents(), static_cast<std::size_t>(agents));
    EXPECT_EQ(trace.steps(), static_cast<std::size_t>(steps));
  }
}

TEST(Trace, AppearsOnlyWhenFinished) {
  const TemporaryFolder folder;
  {
    TraceWriter writer(folder.path() / "run.h5", make_header(3));
    writer.add(make_step(0, 3));
    EXPECT_FALSE(fs::exists(folder.path() / "run.h5"));
  }
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Trace, FolderThatIsNotThereIsTheEnvironmentsFault) {
  const TemporaryFolder folder;
  EXPECT_THROW(TraceWriter(folder.path() / "nowhere" / "run.h5", make_header(3)), EnvironmentError);
  EXPECT_THROW(read_trace(folder.path() / "nowhere.h5"), EnvironmentError);
}

TEST(Trace, CutShortAnywhereIsAnInputError) {
  const TemporaryFolder folder;
  write_trace(folder.path() / "run.h5");
  const std::string bytes = read_file(folder.path() / "run.h5");
  const fs::path cut = folder.path() / "cut.h5";
  for (std::size_t length = 0; length < bytes.size(); length += 997) {
    folder.write("cut.h5", bytes.substr(0, length));
    EXPECT_THAT(caught_problem(cut), HasSubstr("cut.h5")) << length;
  }
}

TEST(Trace, DamagedDataNeverCrashes) {
  const TemporaryFolder folder;
  write_trace(folder.path() / "run.h5");
  const std::string bytes = read_file(folder.path() / "run.h5");
  for (std::size_t at = 0; at < bytes.size(); at += 1009) {
    std::string damaged = bytes;
    for (std::size_t i = at; i < std::min(at + 16, bytes.size()); ++i) damaged[i] ^= 0x5a;
    folder.write("damaged.h5", damaged);
    caught_problem(folder.path() / "damaged.h5");  // either read or refused
  }
}

TEST(Trace, ForeignFilesAreNamedAsSuch) {
  const TemporaryFolder folder;
  EXPECT_THAT(caught_problem(folder.write("text.h5", "not HDF5 at all")), HasSubstr("not HDF5"));
  const std::string foreign = (folder.path() / "foreign.h5").string();
  H5Fclose(H5Fcreate(foreign.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_THAT(caught_problem(foreign), HasSubstr("another kind"));
}

// Opens a good trace for writing and lets `change` spoil it.
template <typename Change>
std::string problem_after(const Change& change) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "run.h5";
  write_trace(path);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  change(file);
  H5Fclose(file);
  return caught_problem(path);
}

TEST(Trace, AMissingDatasetIsNamed) {
  const std::string problem =
      problem_after([](hid_t file) { H5Ldelete(file, "/crowd/velocity", H5P_DEFAULT); });
  EXPECT_THAT(problem, HasSubstr("velocity"));
}

TEST(Trace, AnotherVersionIsRefused) {
  const std::string problem = problem_after([](hid_t file) {
    const hid_t attribute = H5Aopen(file, "version", H5P_DEFAULT);
    const int version = 1000;
    H5Awrite(attribute, H5T_NATIVE_INT, &version);
    H5Aclose(attribute);
  });
  EXPECT_THAT(problem, HasSubstr("version: found 1000"));
}

TEST(Trace, ADatasetOfAnotherLengthIsNamed) {
  const std::string problem = problem_after([](hid_t file) {
    const hid_t dataset = H5Dopen2(file, "/crowd/yaw_rad", H5P_DEFAULT);
    const std::array<hsize_t, 2> shorter{kSteps - 1, kAgents};
    H5Dset_extent(dataset, shorter.data());
    H5Dclose(dataset);
  });
  EXPECT_THAT(problem, HasSubstr("yaw_rad"));
}

TEST(Trace, TextThatIsNotUtf8IsRefused) {
  const std::string problem = problem_after([](hid_t file) {
    const hid_t attribute = H5Aopen(file, "scenario_id", H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    std::string text(H5Tget_size(type), 'a');
    text[1] = '\xdc';
    H5Awrite(attribute, type, text.data());
    H5Tclose(type);
    H5Aclose(attribute);
  });
  EXPECT_THAT(problem, HasSubstr("scenario_id: found bytes that are not UTF-8"));
}

// No more memory than the file's size can account for is asked for.
TEST(Trace, AShapeThatTheFileCannotHoldIsRefused) {
  const std::string problem = problem_after([](hid_t file) {
    const hid_t dataset = H5Dopen2(file, "/crowd/time_s", H5P_DEFAULT);
    const hsize_t longer = 3'000'000'000;
    H5Dset_extent(dataset, &longer);
    H5Dclose(dataset);
  });
  EXPECT_THAT(problem, HasSubstr("time_s"));
}

TEST(Trace, AnIndexOutOfRangeIsRefused) {
  const std::string problem = problem_after([](hid_t file) {
    const hid_t dataset = H5Dopen2(file, "/crowd/state", H5P_DEFAULT);
    const std::vector<std::uint8_t> states(kSteps * kAgents, 3);
    H5Dwrite(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, states.data());
    H5Dclose(dataset);
  });
  EXPECT_THAT(problem, HasSubstr("crowd/state"));
}

TEST(Trace, DroneMovesSmoothlyBetweenItsSamples) {
  Trace trace;
  trace.drones = {{drone_sample_at(1), drone_sample_at(2), drone_sample_at(4)}};
  const DroneSample between = trace.drone_at(0, 2.5);
  EXPECT_DOUBLE_EQ(between.time_s, 2.5);
  EXPECT_TRUE(between.position.isApprox(drone_sample_at(2.5).position));
  EXPECT_LT(between.orientation.angularDistance(drone_sample_at(2.5).orientation), 1e-9);
  EXPECT_TRUE(between.air_velocity.isApprox(drone_sample_at(2.5).air_velocity));
  EXPECT_DOUBLE_EQ(between.energy_j, 250);
  EXPECT_EQ(trace.drone_at(0, 2).position, drone_sample_at(2).position);
  EXPECT_EQ(trace.drone_at(0, -5).position, drone_sample_at(1).position);
  EXPECT_EQ(trace.drone_at(0, 50).position, drone_sample_at(4).position);
}

TEST(TraceDeathTest, StepsOutOfOrderAreABug) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const TemporaryFolder folder;
  TraceWriter writer(folder.path() / "run.h5", make_header(3));
  EXPECT_DEATH(writer.add(make_step(1, 3)), "dt apart");
}

TEST(Trace, OlderFilesGetTheFlagOfThoseWhoseStateSaysThatTheyLie) {
  const TemporaryFolder folder;
  TraceHeader header = make_header(3);
  header.state_names = {"Walk", "Casualty", "Done"};
  {
    TraceWriter writer(folder.path() / "run.h5", header);
    CrowdStep step = make_step(0, 3);
    step.state = {0, 1, 2};
    step.flags = {kPresent | kFallen, kPresent, kPresent};
    writer.add(step);
    writer.finish();
  }
  const Trace trace = read_trace(folder.path() / "run.h5");
  EXPECT_EQ(trace.flags,
            (std::vector<std::uint8_t>{kPresent | kFallen, kPresent | kFallen, kPresent}));
}

TEST(TraceFile, SaysInWhichStatesPeopleLieWhateverTheirNames) {
  const TemporaryFolder folder;
  TraceHeader header = make_header(3);
  header.state_names = {"Walk", "Dead_end", "Nap"};
  header.state_lying = {0, 0, 1};
  {
    TraceWriter writer(folder.path() / "run.h5", header);
    CrowdStep step = make_step(0, 3);
    step.state = {0, 1, 2};
    step.flags = {kPresent, kPresent, kPresent};
    writer.add(step);
    writer.finish();
  }
  const Trace trace = read_trace(folder.path() / "run.h5");
  EXPECT_EQ(trace.header.state_lying, header.state_lying);
  EXPECT_EQ(trace.header.lying_states(), (std::vector<bool>{false, false, true}));
  EXPECT_EQ(trace.flags, (std::vector<std::uint8_t>{kPresent, kPresent, kPresent | kFallen}));
}

TEST(TraceFile, RecordsTheModelOfThePeople) {
  const TemporaryFolder folder;
  const auto read_back = [&](const TraceHeader& header) {
    TraceWriter writer(folder.path() / "run.h5", header);
    writer.add(make_step(0, 3));
    writer.finish();
    return read_trace(folder.path() / "run.h5").header.crowd;
  };
  TraceHeader header = make_header(3);
  EXPECT_EQ(read_back(header), CrowdOrigin{}) << "files of earlier versions do not say it";
  header.crowd = {"helbing", "menge", true, "posterior", 0.25, true, 35};
  EXPECT_EQ(read_back(header), header.crowd);
  header.crowd = {};
  header.crowd.model = kRecordedCrowd;
  EXPECT_EQ(read_back(header), header.crowd);
}

TEST(ImpliesLying, KnowsTheWordsOfStatesInWhichNobodyStands) {
  for (const char* name : {"Fallen", "incapacitated", "is_dead", "Collapsed2", "CASUALTY"}) {
    EXPECT_TRUE(implies_lying(name)) << name;
  }
  for (const char* name : {"walk", "Wait", "flee", "GoToExit", ""}) {
    EXPECT_FALSE(implies_lying(name)) << name;
  }
}

}  // namespace
}  // namespace throng::world
