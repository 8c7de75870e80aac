// Rules about places: surfaces by where they are, doors, and people whom no image shows.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/files/files.h"
#include "checks/door_checks.h"
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
using world::SemanticClass;

/// The hand-made camera above flat ground that ends 40 m ahead, with a class for each pixel by its
/// place, and the top of a building where `is_top` says so.
template <typename ClassOf>
std::vector<std::string> place_faults(const ClassOf& class_of, bool is_top = false) {
  const throng::testing::TemporaryFolder folder;
  formats::DatasetInfo info = formats::hand_made::info(folder.path());
  info.annotations.emplace_back("counts");
  write_file_atomically(
      folder.path() / "counts/run002.json",
      json{{"zones",
            {{{"id", "ground"}, {"corners", {{-99, -99}, {99, -99}, {99, 40}, {-99, 40}}}}}},
           {"lines", json::array()}}
          .dump());
  Shot shot;
  shot.image = formats::hand_made::image();
  shot.camera = formats::image_camera(shot.image);
  Pixels& pixels = shot.pixels;
  pixels.width = formats::hand_made::kWidth;
  pixels.height = formats::hand_made::kHeight;
  for (int y = 0; y < formats::hand_made::kHeight; ++y) {
    for (int x = 0; x < formats::hand_made::kWidth; ++x) {
      const bool is_ground = y > 42;  // the horizon is at 39.5
      const double ahead_m = 500 / (y - 39.5);
      pixels.ids.push_back(!is_ground ? 0
                           : is_top   ? formats::kFirstBuilding + 3
                                      : formats::kGround);
      pixels.depth_cm.push_back(is_ground ? static_cast<std::uint16_t>(std::lround(100 * ahead_m))
                                          : 0);
      for (const std::uint16_t n : {128, 128, 255}) pixels.normals.push_back(is_ground ? n : 0);
      pixels.semantic.push_back(
          static_cast<std::uint16_t>(is_ground ? class_of(ahead_m) : SemanticClass::sky));
    }
  }
  return found_by([&](Findings& findings) {
    PlaceCheck check;
    check.add(info, shot, findings);
    check.finish(findings);
  });
}

TEST(PlaceRules, LandIsAroundTheGround) {
  EXPECT_THAT(place_faults([](double ahead_m) {
                return ahead_m < 40 ? SemanticClass::grass : SemanticClass::terrain;
              }),
              IsEmpty());
  EXPECT_TRUE(any_with(place_faults([](double) { return SemanticClass::pavement; }),
                       "around the scenario's ground are not terrain"));
  EXPECT_TRUE(any_with(place_faults([](double) { return SemanticClass::terrain; }),
                       "on the scenario's ground are terrain"));
}

TEST(PlaceRules, TopsAreNoFacades) {
  EXPECT_THAT(place_faults([](double) { return SemanticClass::wall; }, true), IsEmpty());
  EXPECT_TRUE(any_with(place_faults([](double) { return SemanticClass::building; }, true),
                       "of building 3 that face up are a facade"));
}

/// Faults where a wall 20 m ahead, with an exit of 16 m in it, has this class; `width_m` of it is
/// there.
std::vector<std::string> wall_faults(SemanticClass surface, double width_m = 40) {
  const throng::testing::TemporaryFolder folder;
  formats::DatasetInfo info = formats::hand_made::info(folder.path());
  info.annotations.emplace_back("counts");
  write_file_atomically(folder.path() / "counts/run002.json",
                        json{{"zones", json::array()},
                             {"lines", {{{"id", "north"}, {"start", {-8, 20}}, {"end", {8, 20}}}}}}
                            .dump());
  Shot shot;
  shot.image = formats::hand_made::image();
  shot.camera = formats::image_camera(shot.image);
  Pixels& pixels = shot.pixels;
  pixels.width = formats::hand_made::kWidth;
  pixels.height = formats::hand_made::kHeight;
  for (std::size_t i = 0; i < pixels.count(); ++i) {
    const double x_m = (static_cast<double>(i % formats::hand_made::kWidth) - 49.5) / 50 * 20;
    const bool is_wall = std::abs(x_m) < width_m / 2;
    pixels.ids.push_back(is_wall ? formats::kFirstBuilding : 0);
    pixels.depth_cm.push_back(is_wall ? 2000 : 0);
    for (const std::uint16_t n : {128, 1, 128}) pixels.normals.push_back(n);
    pixels.semantic.push_back(static_cast<std::uint16_t>(surface));
  }
  return found_by([&](Findings& findings) { PlaceCheck().add(info, shot, findings); });
}

TEST(PlaceRules, WallsWithAnExitAreItsDoor) {
  EXPECT_THAT(wall_faults(SemanticClass::door), IsEmpty());
  EXPECT_TRUE(any_with(wall_faults(SemanticClass::building), "exit north lies in are no door"));
  EXPECT_THAT(wall_faults(SemanticClass::building, 10), IsEmpty()) << "beside a gap";
}

/// Rows of exits/run000.csv, one a second, in which the exit closes at 3 s.
constexpr const char* kStates =
    "time_s,exit,state\n1,north,idle\n2,north,flowing\n3,north,closed\n4,north,closed\n"
    "1,south,idle\n2,south,idle\n3,south,idle\n4,south,idle\n";

std::vector<std::string> closure_faults(const std::vector<formats::RunEvent>& events) {
  const throng::testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "exits/run000.csv", kStates);
  const json figures = {
      {"duration_s", 5},
      {"exits",
       {{{"id", "north"}, {"time_in_state", {{"idle_s", 2.6}, {"closed_s", 2.4}}}},
        {{"id", "south"}, {"time_in_state", {{"idle_s", 5.0}, {"closed_s", 0.0}}}}}}};
  std::vector<std::string> faults;
  check_closures(folder.path(), "run000", events, figures,
                 [&](std::size_t, const std::string& what) { faults.push_back(what); });
  return faults;
}

TEST(DoorRules, CloseWhenTheirTableAndFiguresSay) {
  const auto closes = [](double time_s, const char* exit) {
    return formats::RunEvent{time_s, "exit_closes", {{"exit", exit}}};
  };
  EXPECT_THAT(closure_faults({closes(2.6, "north")}), IsEmpty());
  EXPECT_TRUE(any_with(closure_faults({}), "no exit_closes of north"));
  EXPECT_TRUE(any_with(closure_faults({closes(1.2, "north")}), "it is open at 2 s"));
  EXPECT_TRUE(any_with(closure_faults({closes(2.6, "south")}), "south closes, but it is open"));
  EXPECT_TRUE(any_with(closure_faults({closes(2.6, "west")}), "no exit of the run"));
}

std::vector<std::string> escape_faults(const std::string& of_event, const std::string& of_metrics,
                                       const std::string& line) {
  const throng::testing::TemporaryFolder folder;
  write_file_atomically(
      folder.path() / "counts/run000.csv",
      "frame,time_s,kind,id,inside,inflow,outflow,entered,left\n3,3,line," + line + ",,0,1,,7\n");
  const json figures = {
      {"exits", {{{"id", "north"}}, {{"id", "south"}}}},
      {"by_person", {{"agent", {6}}, {"escaped_s", {3.5}}, {"exit", {of_metrics}}}}};
  std::vector<std::string> faults;
  check_escape_exits(folder.path(), "run000",
                     {{3.5, "escapes", {{"track_id", 7}, {"exit", of_event}}}}, figures, 1,
                     [&](std::size_t, const std::string& what) { faults.push_back(what); });
  return faults;
}

TEST(DoorRules, PeopleEscapeWhereTheyCrossTheLine) {
  EXPECT_THAT(escape_faults("north", "north", "north"), IsEmpty());
  EXPECT_THAT(escape_faults("north", "north", "middle"), IsEmpty()) << "a line of the job";
  EXPECT_TRUE(any_with(escape_faults("south", "north", "north"), "by metrics by north"));
  EXPECT_TRUE(any_with(escape_faults("south", "south", "north"), "cross north only"));
}

/// Forty people who go along +x at 6 m/s for five frames, in two states, of whom the image of the
/// hand-made camera shows those who are ahead of it.
class WalkersOfRun {
 public:
  static constexpr int kPeople = 40;
  static constexpr int kFrames = 5;

  WalkersOfRun() : info_(formats::hand_made::info(folder_.path())) {
    info_.runs = {"run002"};
    for (int frame = 0; frame < kFrames; ++frame) {
      for (int person = 0; person < kPeople; ++person) {
        const std::array<float, 4> value = {static_cast<float>(place(frame, person).x()),
                                            static_cast<float>(place(frame, person).y()), 0,
                                            static_cast<float>(person % 2)};
        values.insert(values.end(), value.begin(), value.end());
      }
    }
  }

  std::vector<float> values;
  std::int64_t left_out = -1;  ///< a track

  static Eigen::Vector2d place(int frame, int person) {
    return {-30 + 1.5 * person + 6 * frame, person % 4 == 3 ? -20 : 30};
  }
  static bool is_seen(int frame, int person) {
    return person % 4 != 3 && std::abs(place(frame, person).x()) < 28;  // of 30
  }
  float& value(int frame, int person, int which) {
    return values[static_cast<std::size_t>((frame * kPeople + person) * 4 + which)];
  }

  std::vector<std::string> faults() const {
    json description = {{"states", {"Walk", "Wait"}}};
    for (int frame = 0; frame < kFrames; ++frame) description["times_s"].push_back(frame);
    for (int person = 0; person < kPeople; ++person) description["track_ids"].push_back(person + 1);
    write_file_atomically(info_.root / "trajectories/run002.json", description.dump());
    std::string header = fmt::format(
        "{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, 4), }}", kFrames, kPeople);
    header.resize(118, ' ');
    std::string bytes =
        std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    write_file_atomically(info_.root / "trajectories/run002.npy", bytes);
    return found_by([&](Findings& findings) {
      UnseenCheck check;
      for (int frame = 0; frame < kFrames; ++frame) {
        formats::Image image = formats::hand_made::image();
        image.frame = frame;
        for (int person = 0; person < kPeople; ++person) {
          if (!is_seen(frame, person) || person + 1 == left_out) continue;
          formats::Person seen = formats::hand_made::person(3, {1, 1, 1, 1}, {1, 1, 1, 1}, 1);
          seen.track_id = person + 1;
          image.people.push_back(seen);
        }
        check.add(info_, image, findings);
      }
      check.finish(info_, findings);
    });
  }

 private:
  throng::testing::TemporaryFolder folder_;
  formats::DatasetInfo info_;
};

TEST(UnseenRules, EverybodyInViewHasARecord) {
  EXPECT_THAT(WalkersOfRun().faults(), IsEmpty());
  WalkersOfRun one;
  one.left_out = 21;
  EXPECT_TRUE(any_with(one.faults(), "track 21 is at"));
}

TEST(UnseenRules, HeadingsAndStatesAreLikeThoseOfTheSeen) {
  WalkersOfRun turned;
  WalkersOfRun other;
  for (int frame = 0; frame < WalkersOfRun::kFrames; ++frame) {
    for (int person = 0; person < WalkersOfRun::kPeople; ++person) {
      if (WalkersOfRun::is_seen(frame, person)) continue;
      turned.value(frame, person, 2) = 2;
      other.value(frame, person, 3) = 1 - other.value(frame, person, 3);
    }
  }
  EXPECT_TRUE(any_with(turned.faults(), "headings of people who walk unseen"));
  EXPECT_TRUE(any_with(other.faults(), "states change where people come into view"));
}

}  // namespace
}  // namespace throng::checks
