// Trajectory files byte by byte, read here without the code that writes them.
#include "crowd/output/scb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <ostream>

#include "base/error.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;

constexpr std::size_t kFrames = 5;

/// Two agents of class 7: one walks east, one stands.
Simulation two_agents() {
  return test::load(
      test::scene_with(agent_at(1, 2) + agent_at(-3, 40), R"(class="7" pref_speed="1")"), R"(<BFSM>
  <State name="Idle" final="0"/>
  <State name="Start" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/>
    <VelComponent type="goal"/></State>
  <GoalSet id="0"><Goal type="point" id="0" x="50" y="2"/></GoalSet>
</BFSM>)");
}

std::string record_bytes(std::string_view version) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("old.scb", "an older file");
  Simulation crowd = two_agents();
  ScbWriter writer(path, version, crowd);
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    if (frame > 0) crowd.step();
    writer.record(crowd);
  }
  EXPECT_EQ(read_file(path), "an older file");
  writer.finish(crowd);
  return read_file(path);
}

template <typename T>
T at(const std::string& bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);  // this machine is little-endian
  return value;
}

struct Layout {
  std::string_view version;
  std::size_t header;
  std::size_t floats;
};

void PrintTo(const Layout& layout, std::ostream* out) { *out << layout.version; }

class Scb : public testing::TestWithParam<Layout> {};

TEST_P(Scb, HasItsHeaderAndEveryFrame) {
  const auto [version, header, floats] = GetParam();
  const std::string bytes = record_bytes(version);
  ASSERT_EQ(bytes.size(), header + kFrames * 2 * floats * sizeof(float));
  EXPECT_EQ(bytes.substr(0, 3), version);
  EXPECT_EQ(bytes[3], '\0');
  EXPECT_EQ(at<std::int32_t>(bytes, 4), 2);
  if (version != "1.0") {
    EXPECT_FLOAT_EQ(at<float>(bytes, 8), 0.1F);
    EXPECT_EQ(at<std::uint32_t>(bytes, 12), 7U);
    EXPECT_EQ(at<std::uint32_t>(bytes, 16), 7U);
  }
  // The first frame is the world before the first step.
  EXPECT_EQ(at<float>(bytes, header), 1.0F);
  const std::size_t second_agent = header + floats * sizeof(float);
  EXPECT_EQ(at<float>(bytes, second_agent), -3.0F);
}

TEST_P(Scb, IsReadBack) {
  const auto [version, header, floats] = GetParam();
  const std::string bytes = record_bytes(version);
  const test::TemporaryFolder folder;
  ScbReader reader(folder.write("a.scb", bytes));
  EXPECT_EQ(reader.version(), version);
  EXPECT_EQ(reader.agent_count(), 2U);
  EXPECT_EQ(reader.floats_per_agent(), floats);
  EXPECT_EQ(reader.frame_count(), kFrames);
  const std::vector<float> last = reader.frame(kFrames - 1);
  ASSERT_EQ(last.size(), 2 * floats);
  const std::size_t offset = header + (kFrames - 1) * 2 * floats * sizeof(float);
  EXPECT_EQ(std::memcmp(last.data(), bytes.data() + offset, last.size() * sizeof(float)), 0);
  EXPECT_EQ(reader.frame(0)[0], 1.0F);
}

INSTANTIATE_TEST_SUITE_P(Versions, Scb,
                         testing::Values(Layout{"1.0", 8, 3}, Layout{"2.0", 20, 3},
                                         Layout{"2.1", 20, 4}, Layout{"2.2", 20, 8},
                                         Layout{"2.3", 20, 4}, Layout{"2.4", 20, 4}));

TEST(Scb, WritesTheFieldsOfEachVersion) {
  constexpr std::size_t kHeader = 20;
  const auto value = [](const std::string& bytes, std::size_t floats, std::size_t frame,
                        std::size_t agent, std::size_t index) {
    return at<float>(bytes, kHeader + ((frame * 2 + agent) * floats + index) * sizeof(float));
  };
  // The second agent heads for (50, 2) from (-3, 40).
  const auto yaw_rad = static_cast<float>(std::atan2(-38.0, 53.0));
  const std::string v20 = record_bytes("2.0");
  EXPECT_NEAR(value(v20, 3, 0, 1, 2), yaw_rad, 1e-5);
  EXPECT_NEAR(value(v20, 3, 4, 0, 1), 2, 1e-4);
  const std::string v21 = record_bytes("2.1");
  EXPECT_NEAR(value(v21, 4, 0, 1, 2), yaw_rad, 1e-5);
  EXPECT_EQ(value(v21, 4, 0, 1, 3), 1.0F) << "the second state of the file";
  const std::string v22 = record_bytes("2.2");
  EXPECT_NEAR(value(v22, 8, 0, 0, 4), 1, 1e-5) << "preferred velocity";
  EXPECT_NEAR(value(v22, 8, 0, 0, 5), 0, 1e-5);
  EXPECT_EQ(value(v22, 8, 0, 0, 6), 0.0F) << "velocity at the beginning";
  EXPECT_GT(value(v22, 8, 4, 0, 6), 0.5F);
  const std::string v23 = record_bytes("2.3");
  EXPECT_NEAR(value(v23, 4, 0, 1, 2), std::cos(yaw_rad), 1e-5);
  EXPECT_NEAR(value(v23, 4, 0, 1, 3), std::sin(yaw_rad), 1e-5);
  const std::string v24 = record_bytes("2.4");
  EXPECT_EQ(value(v24, 4, 0, 1, 1), 0.0F) << "flat ground";
  EXPECT_EQ(value(v24, 4, 0, 1, 2), 40.0F);
  EXPECT_NEAR(value(v24, 4, 0, 1, 3), yaw_rad, 1e-5);
}

TEST(Scb, HasNaNForAbsentAgents) {
  const test::TemporaryFolder folder;
  Simulation crowd = two_agents();
  crowd.set_present(1, false);
  const auto path = folder.write("a.scb", "");
  ScbWriter writer(path, "2.1", crowd);
  writer.record(crowd);
  writer.finish(crowd);
  const std::vector<float> frame = ScbReader(path).frame(0);
  EXPECT_FALSE(std::isnan(frame[0]));
  EXPECT_TRUE(std::isnan(frame[4]));
  EXPECT_TRUE(std::isnan(frame[7]));
}

TEST(Scb, ThatIsNotFinishedLeavesNothing) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("x", "").parent_path() / "a.scb";
  {
    const Simulation crowd = two_agents();
    ScbWriter(path, "2.1", crowd).record(crowd);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

TEST(Scb, LeavesOutAFrameThatIsCutOff) {
  const test::TemporaryFolder folder;
  const std::string bytes = record_bytes("2.1");
  EXPECT_EQ(ScbReader(folder.write("a.scb", bytes.substr(0, bytes.size() - 1))).frame_count(),
            kFrames - 1);
}

TEST(Scb, ThatIsNoneIsRefused) {
  const test::TemporaryFolder folder;
  const auto problem = [&](const std::string& bytes) {
    EXPECT_THROW(ScbReader(folder.write("a.scb", bytes)), InputError) << bytes.size();
  };
  using namespace std::string_literals;
  problem("");
  problem("2.1");
  problem("2.9\0\1\0\0\0"s);
  problem("2.1\0\0\0\0\0aaaa"s);
  problem("2.1\0\xff\xff\xff\xff\0\0\0\0"s);
  problem("<Project/>");
  EXPECT_THROW(ScbReader(folder.write("x", "").parent_path()), EnvironmentError);
  EXPECT_THROW(ScbReader("/nowhere.scb"), EnvironmentError);
}

}  // namespace
}  // namespace throng::crowd
