// Exports of everybody's trajectories as texts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

#include "annotate/rasters/density.h"
#include "base/files/files.h"
#include "tests/formats/dataset_fixture.h"

namespace throng::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Person 7 is there throughout 45 frames of run000, person 9 from frame 3 to 24; of run001 there
/// is one frame with nobody.
class TrajectoryTexts : public SmallDataset {
 protected:
  void SetUp() override {
    SmallDataset::SetUp();
    constexpr int kSampled = 45;
    std::vector<double> times_s;
    std::vector<float> values;
    const float absent = std::numeric_limits<float>::quiet_NaN();
    for (int frame = 0; frame < kSampled; ++frame) {
      times_s.push_back(2 + 0.4 * frame);
      const auto x = static_cast<float>(frame);
      values.insert(values.end(), {x, 0.25F, 0, 0});
      const bool is_here = frame >= 3 && frame <= 24;
      values.insert(values.end(), 4, absent);
      if (is_here) std::copy_n(std::array{-x, 1.5F, 1.0F, 0.0F}.begin(), 4, values.end() - 4);
    }
    write("run000", times_s, {7, 9}, annotate::npy_bytes(std::array{kSampled, 2, 4}, values));
    write("run001", {2}, {1000007},
          annotate::npy_bytes(std::array{1, 1, 4}, std::vector<float>(4, absent)));
    annotations_.emplace_back("trajectories");
    write_manifest();
  }

  void write(const std::string& run, const std::vector<double>& times_s,
             const std::vector<int>& tracks, const std::string& npy) const {
    const json description = {{"times_s", times_s}, {"track_ids", tracks}, {"states", {"Walk"}}};
    write_file_atomically(root_ / ("trajectories/" + run + ".json"), description.dump());
    write_file_atomically(root_ / ("trajectories/" + run + ".npy"), npy);
  }

  static std::vector<std::string> lines(const fs::path& file) {
    std::istringstream text(read_file(file));
    std::vector<std::string> found;
    for (std::string line; std::getline(text, line);) found.push_back(line);
    return found;
  }
};

TEST_F(TrajectoryTexts, JuPedSimHasRateUnitsAndEverybodyPresent) {
  const fs::path out = exported("jupedsim") / "train";
  const std::vector<std::string> text = lines(out / "run000.txt");
  ASSERT_EQ(text.size(), 3U + 45 + 22);
  EXPECT_EQ(text[1], "#framerate: 2.5");
  EXPECT_EQ(text[2], "#ID\tFR\tx/m\ty/m\tz/m");
  EXPECT_EQ(text[3], "7\t0\t0.0000\t0.2500\t0");
  EXPECT_EQ(text[7], "9\t3\t-3.0000\t1.5000\t0");
  EXPECT_EQ(lines(out / "run001.txt").size(), 3U);
}

TEST_F(TrajectoryTexts, EthUcyHasFramePersonAndPosition) {
  const std::vector<std::string> text = lines(exported("eth-ucy") / "train/run000.txt");
  ASSERT_EQ(text.size(), 45U + 22);
  EXPECT_EQ(text[0], "0\t7\t0.0000\t0.2500");
  EXPECT_EQ(text[4], "3\t9\t-3.0000\t1.5000");
}

TEST_F(TrajectoryTexts, TrajNetHasScenesOf21FramesOfAPresentPerson) {
  std::vector<json> scenes;
  std::size_t tracks = 0;
  for (const std::string& line : lines(exported("trajnet") / "train/run000.ndjson")) {
    const json row = json::parse(line);
    if (row.contains("scene")) {
      scenes.push_back(row.at("scene"));
    } else {
      ++tracks;
      EXPECT_EQ(row.at("track").at("y"), row.at("track").at("p") == 7 ? 0.25 : 1.5);
    }
  }
  EXPECT_EQ(tracks, 45U + 22);
  EXPECT_EQ(json(scenes), json::parse(R"([{"id": 0, "p": 7, "s": 0, "e": 20, "fps": 2.5},
                            {"id": 1, "p": 7, "s": 21, "e": 41, "fps": 2.5},
                            {"id": 2, "p": 9, "s": 3, "e": 23, "fps": 2.5}])"));
}

}  // namespace
}  // namespace throng::formats
