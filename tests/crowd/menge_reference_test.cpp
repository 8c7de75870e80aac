// Against series recorded with Menge itself, where they are at hand (they are not in the
// repository).
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "crowd_files.h"

namespace throng::crowd {
namespace {

const std::filesystem::path kExamples =
    std::filesystem::path(THRONG_SOURCE_DIR) / "../shared/data/menge_examples";

struct Row {
  double time_s = 0;
  double in_final_state = 0;
  double mean_speed = 0;
};

std::vector<Row> read_series(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    Row row;
    double terminal = 0;
    fields >> row.time_s >> row.in_final_state >> terminal >> row.mean_speed;
    rows.push_back(row);
  }
  return rows;
}

double share_in(const Simulation& crowd, const std::string& state) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    if (test::state_of(crowd, i) == state) ++count;
  }
  return static_cast<double>(count) / static_cast<double>(crowd.agent_count());
}

class MengeReference : public testing::TestWithParam<std::string> {};

TEST_P(MengeReference, ArrivalsAndSpeedsAgree) {
  const std::string name = GetParam();
  const auto series_file = kExamples / "reference" / ("core_" + name + ".csv");
  if (!std::filesystem::exists(series_file)) GTEST_SKIP() << "no reference series here";
  Simulation crowd(kExamples / name / (name + "S.xml"), kExamples / name / (name + "B.xml"), {});
  double speed_difference = 0;
  std::size_t seconds = 0;
  double menge_half_s = 0;
  double half_s = 0;
  for (const Row& row : read_series(series_file)) {
    while (crowd.time_s() < row.time_s - 1e-6) crowd.step();
    double speed = 0;
    for (const Eigen::Vector2f& v : crowd.velocities()) speed += v.norm();
    speed /= static_cast<double>(crowd.agent_count());
    if (menge_half_s == 0 && row.in_final_state >= 0.5) menge_half_s = row.time_s;
    if (half_s == 0 && share_in(crowd, "Stop") >= 0.5) half_s = row.time_s;
    speed_difference += std::abs(speed - row.mean_speed);
    ++seconds;
  }
  // The agents' noise differs, and the middle of such a crowd is chaotic.
  EXPECT_LT(speed_difference / static_cast<double>(seconds), 0.12);
  EXPECT_NEAR(half_s, menge_half_s, 0.15 * menge_half_s);
  RecordProperty("half_arrived_s", std::to_string(half_s));
  RecordProperty("half_arrived_menge_s", std::to_string(menge_half_s));
}

INSTANTIATE_TEST_SUITE_P(Core, MengeReference, testing::Values("circle", "4square"));

}  // namespace
}  // namespace throng::crowd
