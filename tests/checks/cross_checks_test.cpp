// Checks of images against each other and against labels, on images made by hand.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/files/files.h"
#include "checks/run_checks.h"
#include "checks/shot.h"
#include "tests/checks/found_by.h"
#include "tests/formats/hand_made.h"
#include "world/semantic_class.h"

namespace throng::checks {
namespace {

using formats::hand_made::any_with;
using nlohmann::json;
using ::testing::IsEmpty;

/// The hand-made camera's image of its frame: gray ground, known depth.
Shot ground_shot(std::int64_t frame, double brightness) {
  Shot shot;
  shot.image = formats::hand_made::image();
  shot.image.frame = frame;
  shot.image.file = fmt::format("images/run002/d1/{:06}.jpg", frame);
  shot.camera = formats::image_camera(shot.image);
  Pixels& pixels = shot.pixels;
  pixels.width = formats::hand_made::kWidth;
  pixels.height = formats::hand_made::kHeight;
  for (int y = 0; y < formats::hand_made::kHeight; ++y) {
    for (int x = 0; x < formats::hand_made::kWidth; ++x) {
      const bool is_ground = y > 42;  // the horizon is at 39.5
      pixels.ids.push_back(is_ground ? formats::kGround : 0);
      pixels.depth_cm.push_back(
          is_ground ? static_cast<std::uint16_t>(std::lround(100 * 500 / (y - 39.5))) : 0);
      const double tone = brightness * (110 + (x * 5 + y * 3) % 11);
      for (int c = 0; c < 3; ++c) pixels.rgb.push_back(static_cast<std::uint8_t>(tone + 4 * c));
    }
  }
  return shot;
}

TEST(CrossChecks, StillPlacesKeepTheirBrightness) {
  const auto faults = [](double brightness, double ev) {
    const Shot before = ground_shot(3, 1);
    Shot after = ground_shot(4, brightness);
    after.image.record["sensor"] = {{"ev", ev}};
    return found_by([&](Findings& findings) { check_still_surfaces(before, after, findings); });
  };
  EXPECT_THAT(faults(1, 0), IsEmpty());
  EXPECT_THAT(faults(0.93, 0), IsEmpty()) << "a vignette or a cloud of dust";
  EXPECT_TRUE(any_with(faults(0.8, 0), "image-brightness"));
  EXPECT_TRUE(any_with(faults(1.3, 0), "image-brightness"));
  EXPECT_THAT(faults(0.8, -0.6), IsEmpty()) << "another exposure";
}

/// Stripes of paint on what is called pavement, in these shades of gray.
std::vector<std::string> marking_faults(std::uint8_t ground, std::uint8_t paint) {
  Shot shot = ground_shot(4, 1);
  for (std::size_t i = 0; i < shot.pixels.count(); ++i) {
    const std::size_t row = i / formats::hand_made::kWidth;
    const bool is_painted = row % 8 < 2;
    const auto on_ground =
        is_painted ? world::SemanticClass::marking : world::SemanticClass::pavement;
    const auto surface = row > 42 ? on_ground : world::SemanticClass::sky;
    shot.pixels.semantic.push_back(static_cast<std::uint16_t>(surface));
    std::fill_n(shot.pixels.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                is_painted ? paint : ground);
  }
  return found_by([&](Findings& findings) {
    PlaceCheck check;
    check.add(formats::hand_made::info(""), shot, findings);
    check.finish(findings);
  });
}

TEST(CrossChecks, PaintIsOnRoadsWhereTheGroundIsAsDark) {
  constexpr std::uint8_t kPaint = 202;
  EXPECT_TRUE(any_with(marking_faults(113, kPaint), "as dark as roads"));
  EXPECT_THAT(marking_faults(171, kPaint), IsEmpty()) << "the line of a platform of concrete";
}

/// Smoke in a box of the image, of a fire of 2 m ten meters below the camera and 60 m ahead of it,
/// in a wind along +x.
std::vector<std::string> smoke_faults(int x, double wind_mps) {
  Shot shot = ground_shot(4, 1);
  const nlohmann::json fire = {{"id", 0}, {"kind", "fire"}, {"position", {0, 60}}, {"radius_m", 2}};
  shot.image.record["hazards"] = nlohmann::json::array({fire});
  shot.image.record["environment"] = {
      {"wind", {{"speed_mps", wind_mps}, {"direction_deg", 0}, {"profile", "uniform"}}}};
  shot.pixels.hazard_opacity.assign(3 * shot.pixels.count(), 0);
  for (int row = 35; row < 45; ++row) {
    for (int column = x; column < x + 10; ++column) {
      shot.pixels.hazard_opacity[3 * shot.pixels.at(column, row) + 1] = 200;
    }
  }
  const formats::DatasetInfo info = formats::hand_made::info("");
  HazardOpacityCheck check;
  return found_by([&](Findings& findings) {
    check.add_pixels(info, shot.image, shot.pixels, findings);
    check.finish(info, findings);
  });
}

TEST(CrossChecks, SmokeIsWhereTheWindCarriesIt) {
  EXPECT_THAT(smoke_faults(45, 0), IsEmpty());
  EXPECT_TRUE(any_with(smoke_faults(70, 0), "hazard-opacity"));
  EXPECT_THAT(smoke_faults(70, 5), IsEmpty()) << "37 m in 15 s";
  EXPECT_TRUE(any_with(smoke_faults(15, 5), "hazard-opacity")) << "against the wind";
}

TEST(CrossChecks, NoiseIsNoColor) {
  const auto faults = [](double iso) {
    Shot before = ground_shot(3, 1);
    Shot after = ground_shot(4, 1);
    // Red and blue change from pixel to pixel, in each image otherwise.
    for (Shot* shot : {&before, &after}) {
      shot->image.record["sensor"] = {{"iso", iso}, {"full_well_e", 8000}, {"read_noise_e", 3}};
      for (std::size_t i = 0; i < shot->pixels.count(); ++i) {
        const std::size_t mixed = (i * 2654435761U + (shot == &after ? 977 : 0) * i * i) >> 7U;
        const int off = static_cast<int>(mixed % 41) - 20;
        shot->pixels.rgb[3 * i] = static_cast<std::uint8_t>(120 + off);
        shot->pixels.rgb[3 * i + 2] = static_cast<std::uint8_t>(120 - off);
      }
    }
    return found_by([&](Findings& findings) { check_still_surfaces(before, after, findings); });
  };
  EXPECT_TRUE(any_with(faults(0), "image-colors"));
  EXPECT_THAT(faults(6400), IsEmpty());
}

/// A hazard 30 m ahead, with this opacity of fire and smoke all around it.
std::vector<std::string> sight_faults(const std::string& kind, double age_s, int fire, int smoke,
                                      double share_of_smoke = 0.7) {
  Shot shot = ground_shot(4, 1);
  shot.image.time_s = 20;
  const nlohmann::json hazard = {
      {"id", 0}, {"kind", kind}, {"position", {0, 30}}, {"radius_m", 4}, {"start_s", 20 - age_s}};
  shot.image.record["hazards"] = nlohmann::json::array({hazard});
  shot.image.record["environment"] = {{"smoke", share_of_smoke}};
  shot.pixels.hazard_opacity.assign(3 * shot.pixels.count(), 0);
  for (std::size_t i = 0; i < shot.pixels.count(); ++i) {
    shot.pixels.hazard_opacity[3 * i] = static_cast<std::uint16_t>(fire);
    shot.pixels.hazard_opacity[3 * i + 1] = static_cast<std::uint16_t>(smoke);
  }
  return found_by([&](Findings& findings) {
    HazardSightCheck check;
    check.add_pixels(formats::hand_made::info(""), shot.image, shot.pixels, findings);
  });
}

TEST(CrossChecks, HazardsInTheOpenShowWhatTheyMake) {
  EXPECT_THAT(sight_faults("fire", 10, 250, 220), IsEmpty());
  EXPECT_THAT(sight_faults("explosion", 10, 0, 220), IsEmpty());
  EXPECT_THAT(sight_faults("explosion", 2, 250, 3), IsEmpty());
  EXPECT_THAT(sight_faults("fire", 10, 0, 0, 0), IsEmpty()) << "nothing is drawn without smoke";
  EXPECT_TRUE(any_with(sight_faults("fire", 10, 0, 220), "of kind fire")) << "an explosion";
  EXPECT_TRUE(any_with(sight_faults("explosion", 10, 250, 220), "no hazard burns any more"));
  EXPECT_TRUE(any_with(sight_faults("gas", 10, 0, 220), "of kind gas"));
  EXPECT_TRUE(any_with(sight_faults("fire", 10, 125, 220), "fire of 125")) << "halved";
  EXPECT_TRUE(any_with(sight_faults("collapse", 10, 0, 0), "smoke of 0"));
  EXPECT_TRUE(any_with(sight_faults("fire", 10, 250, 220, 0), "but smoke is 0"));
}

/// Twelve people who move by (2, -1) px, each with three keypoints, and flow that is off by
/// `bias_px`.
std::vector<std::string> keypoint_flow_faults(double bias_px) {
  Shot before = ground_shot(3, 1);
  Shot after = ground_shot(4, 1);
  before.pixels.ids.clear();
  before.pixels.depth_cm.clear();
  for (int i = 0; i < formats::hand_made::kWidth * formats::hand_made::kHeight; ++i) {
    before.pixels.flow.push_back(static_cast<std::uint16_t>(32768 + 64 * (2 + bias_px)));
    before.pixels.flow.push_back(static_cast<std::uint16_t>(32768 - 64));
    before.pixels.flow.push_back(1);
  }
  for (int i = 0; i < 12; ++i) {
    const double x = 6 + 7 * i;
    for (Shot* shot : {&before, &after}) {
      const double shift = shot == &after ? 1 : 0;
      const formats::Box box{x + 2 * shift, 50 - shift, 5, 12};
      formats::Person person = formats::hand_made::person(i + 1, box, box, 1);
      for (const double y : {52.0, 55.5, 60.0}) {
        person.keypoints.push_back({x + 2.5 + 2 * shift, y - shift, 2});
      }
      shot->image.people.push_back(person);
    }
  }
  return found_by([&](Findings& findings) { check_flow_between(before, after, findings); });
}

TEST(CrossChecks, FlowIsTheMotionOfKeypoints) {
  EXPECT_THAT(keypoint_flow_faults(0), IsEmpty());
  EXPECT_FALSE(any_with(keypoint_flow_faults(0.25), "flow-of-keypoints"));
  EXPECT_TRUE(any_with(keypoint_flow_faults(0.75), "flow-of-keypoints"));
  EXPECT_TRUE(any_with(keypoint_flow_faults(-1), "flow-of-keypoints"));
}

/// Sixteen people with tops of as many colors, of whom the image shows the torsos in half of the
/// light; the label of one of them may be another, and an item may be carried.
std::vector<std::string> clothes_faults(const std::string& first_label, bool shows_item = false,
                                        double sun_elevation_deg = 40) {
  constexpr std::array<const char*, 16> kColors = {
      "#a03030", "#30a030", "#3030a0", "#a0a030", "#a030a0", "#30a0a0", "#808080", "#c06040",
      "#4060c0", "#60c040", "#202020", "#e0e0e0", "#905030", "#305090", "#509030", "#b08060"};
  Shot shot = ground_shot(4, 1);
  shot.image.record["environment"] = {{"sun_elevation_deg", sun_elevation_deg}};
  shot.pixels.parts.assign(shot.pixels.count(), 0);
  for (std::size_t i = 0; i < kColors.size(); ++i) {
    const int x = 2 + 12 * static_cast<int>(i % 8);
    const int y = 2 + 36 * static_cast<int>(i / 8);
    const formats::Box box{static_cast<double>(x), static_cast<double>(y), 10, 20};
    formats::Person person =
        formats::hand_made::person(static_cast<std::int64_t>(i) + 1, box, box, 1);
    json track = *person.track;
    const std::string color = kColors.at(i);
    track["attributes"]["top_colour"] = i == 0 && !first_label.empty() ? first_label : color;
    track["attributes"]["carries"] = i == 0 ? "nothing" : "handbag";
    person.track = std::make_shared<const json>(track);
    for (int v = y; v < y + 20; ++v) {
      for (int u = x; u < x + 10; ++u) {
        const std::size_t pixel = shot.pixels.at(u, v);
        shot.pixels.ids[pixel] = instance_id(person);
        shot.pixels.parts[pixel] = v == y && (shows_item || i > 0) ? 9 : 2;
        for (std::size_t c = 0; c < 3; ++c) {
          // Half of the light is 0.73 of the sRGB value.
          shot.pixels.rgb[3 * pixel + c] =
              static_cast<std::uint8_t>(0.73 * std::stoi(color.substr(1 + 2 * c, 2), nullptr, 16));
        }
      }
    }
    shot.image.people.push_back(person);
  }
  return found_by([&](Findings& findings) {
    ClothesCheck check;
    check.add(shot);
    check.finish(findings);
  });
}

TEST(CrossChecks, EverybodysTopHasTheColorOfItsLabel) {
  EXPECT_THAT(clothes_faults(""), IsEmpty());
  EXPECT_THAT(clothes_faults("#902828"), IsEmpty()) << "nearly the same";
  EXPECT_TRUE(any_with(clothes_faults("#00ff00"), "colors-are-clothes track 2000001"));
  EXPECT_TRUE(any_with(clothes_faults("#3030a0"), "colors-are-clothes track 2000001"));
}

TEST(CrossChecks, ALowSunHidesTheColorsOfTops) {
  EXPECT_THAT(clothes_faults("#00ff00", false, 0.4), IsEmpty()) << "the light has two colors";
}

TEST(CrossChecks, PeopleWithoutLuggageShowNone) {
  EXPECT_TRUE(any_with(clothes_faults("", true), "attributes track 2000001 carries nothing, but"));
}

TEST(CrossChecks, CategoriesHaveTheirNames) {
  const throng::testing::TemporaryFolder folder;
  const auto faults = [&](const std::string& categories) {
    write_file_atomically(folder.path() / formats::kCocoFile,
                          "{\"info\":{},\n\"licenses\":[],\n\"categories\":" + categories +
                              ",\n\"tracks\":[\n],\n\"images\":[\n],\n\"annotations\":[\n]}\n");
    return found_by([&](Findings& findings) {
      check_categories(formats::hand_made::info(folder.path()), findings);
    });
  };
  EXPECT_THAT(faults(R"([{"id":1,"name":"person"},{"id":2,"name":"drone"}])"), IsEmpty());
  EXPECT_EQ(faults(R"([{"id":1,"name":"drone"},{"id":2,"name":"person"}])").size(), 2U);
  EXPECT_EQ(faults(R"([{"id":3,"name":"person"}])").size(), 1U);
}

/// A run of three crossings at 2.5, 4 and 6 s through a door of 1 m, with a row of the table.
std::vector<std::string> table_faults(const std::string& row) {
  const throng::testing::TemporaryFolder folder;
  formats::DatasetInfo info = formats::hand_made::info(folder.path());
  info.runs = {"run000"};
  const json run = {{"run", "run000"},
                    {"exits", json::array({{{"id", "north"},
                                            {"width_m", 1},
                                            {"crossings", {{"out", 3}, {"in", 0}}},
                                            {"gaps", {{"list_s", {1.5, 2}}}},
                                            {"last_crossing_s", 6}}})}};
  write_file_atomically(folder.path() / "metrics.json", json{{"runs", json::array({run})}}.dump());
  write_file_atomically(folder.path() / "exits/run000.csv",
                        "time_s,exit,queue,predicted_wait,crossed_out,crossed_in\n" + row + "\n");
  return found_by([&](Findings& findings) {
    check_metrics(info, {{"runs", json::array({{{"run", "run000"}}})}}, findings);
  });
}

TEST(CrossChecks, TablesOfExitsHaveTheCrossingsOfTheGaps) {
  EXPECT_THAT(table_faults("4.5,north,0,0,2,0"), IsEmpty());
  EXPECT_THAT(table_faults("4.1,north,0,0,1,0"), IsEmpty()) << "the second one is on the line yet";
  EXPECT_TRUE(any_with(table_faults("4.5,north,0,0,3,0"), "has 3 crossings in exits/run000.csv"));
  EXPECT_TRUE(any_with(table_faults("12,north,0,0,2,0"), "has 2 crossings in exits/run000.csv"));
  EXPECT_TRUE(any_with(table_faults("4.5,north,0,0,2,1"), "crossings.in of north is 0"));
}

TEST(CrossChecks, WaitsAreTheQueueOverAPossibleRate) {
  // Three crossings in 20 s at a capacity of 1.3 /s, of which a lane of 0.8 m has 1.04: up to 16 /
  // 10 a second and, after 9 s and 2 s of slack, down to 10.4 / 21.
  EXPECT_THAT(table_faults("9,north,13,10,3,0"), IsEmpty());
  EXPECT_THAT(table_faults("9,north,13,26.2,3,0"), IsEmpty());
  EXPECT_TRUE(any_with(table_faults("9,north,13,27,3,0"), "predicted_wait 27 s for a queue of 13"));
  // The queue began a second before, so that nobody can have waited for long.
  EXPECT_TRUE(any_with(table_faults("0,north,0,0,0,0\n1,north,1,2,0,0"), "predicted_wait 2 s"));
  EXPECT_THAT(table_faults("0,north,0,0,0,0\n1,north,1,1.05,0,0"), IsEmpty());
  EXPECT_TRUE(any_with(table_faults("9,north,13,7,3,0"), "predicted_wait 7 s for a queue of 13"));
}

}  // namespace
}  // namespace throng::checks
