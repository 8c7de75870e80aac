// Tables without names whose columns are not person, frame, x and y.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/files/files.h"
#include "metrics/trajectories/trajectory_file.h"
#include "tests/world/temporary_folder.h"

namespace throng::metrics {
namespace {

using ::testing::HasSubstr;

TrajectoryFormat in_pixels(double pixel_m = 0.05) {
  TrajectoryFormat format;
  format.frames_per_s = 30;
  format.unit_m = pixel_m;
  return format;
}

world::Trace tracks(const std::string& text, const TrajectoryFormat& format,
                    std::vector<Problem>* notes = nullptr) {
  const testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "annotations.txt", text);
  return read_trajectory(folder.path() / "annotations.txt", {}, format, notes);
}

std::string reason(const std::string& text, const TrajectoryFormat& format) {
  try {
    tracks(text, format);
  } catch (const InputError& error) {
    return error.problems().at(0).text();
  }
  return "accepted";
}

/// Boxes of 20 x 30 pixels of tracks that begin at frames of their own, each 12 frames long.
std::string boxes(const std::vector<std::string>& labels, int lost_from = 12) {
  std::string text;
  for (std::size_t track = 0; track < labels.size(); ++track) {
    for (int k = 0; k < 12; ++k) {
      const int x = 200 + 5 * k + k % 3;
      const int y = 300 + 90 * static_cast<int>(track) + 2 * k;
      text += fmt::format("{} {} {} {} {} {} {} 0 1 \"{}\"\n", track, x, y, x + 20, y + 30,
                          k + 4 * static_cast<int>(track), k >= lost_from ? 1 : 0, labels[track]);
    }
  }
  return text;
}

TEST(UnnamedColumns, BoxesOfTheStanfordDroneDataset) {
  std::vector<Problem> notes;
  const world::Trace trace = tracks(
      boxes({"Pedestrian", "Biker", "Pedestrian", "Cart", "Biker"}, 10), in_pixels(), &notes);
  ASSERT_EQ(trace.agents(), 2U);
  EXPECT_EQ(trace.steps(), 18U);
  EXPECT_NEAR(trace.header.dt_s, 1.0 / 30, 1e-9);
  EXPECT_NEAR(trace.position[0].x(), 0.05 * 210, 1e-5);
  EXPECT_NEAR(trace.position[0].y(), 0.05 * 315, 1e-5);
  EXPECT_TRUE(trace.present(8, 0));
  EXPECT_TRUE(trace.present(8, 1));
  EXPECT_FALSE(trace.present(10, 0)) << "lost";
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0].text(), HasSubstr("left out: tracks: 2 of Biker, 1 of Cart; 4 rows"));
  const std::string header = "track_id,xmin,ymin,xmax,ymax,frame,lost,occluded,generated,label\n";
  std::string with_commas = boxes({"Pedestrian", "Pedestrian"});
  std::replace(with_commas.begin(), with_commas.end(), ' ', ',');
  EXPECT_EQ(tracks(header + with_commas, in_pixels()).agents(), 2U);
  EXPECT_EQ(tracks("# framerate: 30\n# unit: 0.05 m\n" + with_commas, {}).steps(), 16U);
  EXPECT_THAT(reason(boxes({"Biker", "Skater"}), in_pixels()), HasSubstr("1 of Skater"));
  TrajectoryFormat without_unit;
  without_unit.frames_per_s = 30;
  EXPECT_THAT(reason(boxes({"Pedestrian"}), without_unit), HasSubstr("length of a pixel"));
}

TEST(UnnamedColumns, AnotherColumnThatMayBeTheFrameIsRefused) {
  std::string without_labels = boxes({"Pedestrian", "Pedestrian", "Pedestrian"});
  for (std::size_t at = 0; (at = without_labels.find(" \"", at)) != std::string::npos;) {
    without_labels.erase(at, without_labels.find('\n', at) - at);
  }
  EXPECT_THAT(reason(without_labels, in_pixels()),
              HasSubstr("9 columns without names, of which columns 2 and 6 may be the frame"));
  TrajectoryFormat format = in_pixels();
  format.columns = columns_in_order("id,x,y,-,-,frame");
  EXPECT_EQ(tracks(without_labels, format).steps(), 20U);
  EXPECT_THAT(reason("1 100 200 0\n1 103 201 1\n1 105 202 2\n1 108 204 3\n"
                     "2 300 200 0\n2 303 201 1\n2 305 202 2\n2 308 204 3\n",
                     in_pixels()),
              HasSubstr("columns 2 and 4"));
}

TEST(UnnamedColumns, OtherColumnsAreNoFrames) {
  std::string jupedsim;  // id frame x y z a b angle color
  std::string in_ms;     // id frame x y z and the frame's time
  std::string abreast;   // whole centimeters
  for (int k = 0; k < 20; ++k) {
    for (int person = 1; person <= 3; ++person) {
      jupedsim += fmt::format("{} {} {} {} 0 0.2 0.2 {} {}\n", person, k, person + 0.1 * k, person,
                              90, 200);
      in_ms += fmt::format("{} {} {} {} 170 {}\n", person, k, 100 + 5 * k, 90 * person, 40 * k);
      abreast += fmt::format("{} {} {} {}\n", person, k, 100 + 5 * k, 90 * person);
    }
  }
  for (const std::string& text : {jupedsim, in_ms, abreast}) {
    const world::Trace trace = tracks(text, in_pixels(0.01));
    EXPECT_EQ(trace.agents(), 3U) << text;
    EXPECT_EQ(trace.steps(), 20U) << text;
  }
}

}  // namespace
}  // namespace throng::metrics
