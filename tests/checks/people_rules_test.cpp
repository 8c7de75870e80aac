// Rules about people: parts of whole bodies, groups, and clothes.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>

#include "base/files/files.h"
#include "checks/ground_truth_checks.h"
#include "checks/pixels.h"
#include "checks/run_checks.h"
#include "formats/dataset/instances.h"
#include "spec/annotate/table_columns.h"
#include "tests/checks/found_by.h"
#include "tests/formats/hand_made.h"

namespace throng::checks {
namespace {

using formats::hand_made::any_with;
using nlohmann::json;
using ::testing::IsEmpty;

/// Faults in the parts of a person of 10 x 20 pixels, of whom `part_of` says the part by the row.
std::vector<std::string> parts_faults(const std::function<std::uint16_t(int)>& part_of) {
  formats::Image image = formats::hand_made::image();
  image.people = {formats::hand_made::person(3, {20, 30, 10, 20}, {20, 30, 10, 20}, 1)};
  Pixels pixels;
  pixels.width = formats::hand_made::kWidth;
  pixels.height = formats::hand_made::kHeight;
  pixels.ids.assign(pixels.count(), formats::kGround);
  pixels.parts.assign(pixels.count(), 0);
  for (int y = 30; y < 50; ++y) {
    for (int x = 20; x < 30; ++x) {
      pixels.ids[pixels.at(x, y)] = 3;
      pixels.parts[pixels.at(x, y)] = part_of(y - 30);
    }
  }
  return found_by([&](Findings& findings) {
    check_parts(formats::hand_made::info(""), image, pixels, findings);
  });
}

TEST(PeopleRules, WholeBodiesHaveSeveralParts) {
  EXPECT_THAT(parts_faults([](int row) { return row < 3 ? 1 : row < 12 ? 2 : 5; }), IsEmpty());
  EXPECT_TRUE(any_with(parts_faults([](int) { return 1; }), "200 of 200 pixels of a whole body"));
}

/// Faults where the table has two people together, of these groups.
std::vector<std::string> group_faults(const json& own, const json& other) {
  const throng::testing::TemporaryFolder folder;
  formats::DatasetInfo info = formats::hand_made::info(folder.path());
  info.runs = {"run002"};
  write_file_atomically(
      folder.path() / "actions/run002.csv",
      fmt::format("{}\n2000003,together,2000004,0,9\n", annotate::kActionColumns));
  formats::Image image = formats::hand_made::image();
  for (const auto& [number, group] : {std::pair(3, own), std::pair(4, other)}) {
    formats::Person person = formats::hand_made::person(number, {1, 1, 1, 1}, {1, 1, 1, 1}, 1);
    json track = *person.track;
    track["group"] = group;
    person.track = std::make_shared<const json>(track);
    image.people.push_back(person);
  }
  return found_by([&](Findings& findings) {
    ActionsCheck check;
    check.add(info, image, findings);
    check.finish(info, findings);
  });
}

TEST(PeopleRules, TheTogetherAreOfOneGroup) {
  EXPECT_THAT(group_faults(4, 4), IsEmpty());
  EXPECT_TRUE(any_with(group_faults(4, 5), "their groups are 4 and 5"));
  EXPECT_TRUE(any_with(group_faults(nullptr, nullptr), "their groups are null and null"));
}

/// Faults of somebody in a state, with these actions, in a dataset with a version of labels.
std::vector<std::string> posture_faults(const std::string& state, const json& actions,
                                        const char* version = annotate::kLabelVersion,
                                        double speed_mps = 0) {
  const throng::testing::TemporaryFolder folder;
  formats::DatasetInfo info = formats::hand_made::info(folder.path());
  info.annotations.emplace_back("actions");
  write_file_atomically(
      folder.path() / formats::kCocoFile,
      fmt::format("{{\"info\":{{\"version\":\"{}\"}},\n\"images\":[]}}\n", version));
  formats::Image image = formats::hand_made::image();
  formats::Person person = formats::hand_made::person(3, {1, 1, 1, 1}, {1, 1, 1, 1}, 1);
  person.state = state;
  person.velocity = {speed_mps, 0};
  person.record["actions"] = actions;
  person.record["together_with"] = json::array();
  json track = *person.track;
  track["group"] = nullptr;
  person.track = std::make_shared<const json>(track);
  image.people = {person};
  return found_by([&](Findings& findings) {
    ActionsCheck check;
    check.add(info, image, findings);
  });
}

TEST(PeopleRules, StatesAreThoseOfPostures) {
  EXPECT_THAT(posture_faults("sitting", {"sit", "drink"}), IsEmpty());
  EXPECT_THAT(posture_faults("squatting", {"squat", "use_phone"}), IsEmpty());
  EXPECT_THAT(posture_faults("squatting", {"cower"}), IsEmpty());
  EXPECT_THAT(posture_faults("waiting", {"stand", "talk"}), IsEmpty());
  EXPECT_TRUE(any_with(posture_faults("waiting", {"sit"}), "but the state is waiting"));
  EXPECT_TRUE(any_with(posture_faults("sitting", {"stand"}), "but the state is sitting"));
  EXPECT_TRUE(any_with(posture_faults("sitting", {"squat"}), "but the state is sitting"));
  EXPECT_TRUE(any_with(posture_faults("panicking", {"cower"}), "but the state is panicking"));
  EXPECT_TRUE(any_with(posture_faults("sitting", {"sit"}, annotate::kLabelVersion, 1.5),
                       "action sit at 1.50 m/s"));
  EXPECT_TRUE(any_with(posture_faults("sitting", {"sit", "squat"}), "2 of"));
  EXPECT_TRUE(any_with(posture_faults("sitting", {"sit", "yawn"}), "is no action"));
  EXPECT_THAT(posture_faults("waiting", {"sit"}, "3"), IsEmpty()) << "as of former versions";
}

/// Faults in the sexes of eight characters, of whom the first `dresses` wear dresses.
std::vector<std::string> sex_faults(int dresses, const std::function<bool(int)>& is_male) {
  json manifest = {{"runs", json::array()}};
  ConstancyCheck check(manifest);
  formats::DatasetInfo info = formats::hand_made::info("");
  return found_by([&](Findings& findings) {
    formats::Image image = formats::hand_made::image();
    for (int i = 0; i < 8; ++i) {
      const bool has_dress = i < dresses;
      formats::Person person = formats::hand_made::person(i + 1, {1, 1, 1, 1}, {1, 1, 1, 1}, 1);
      person.box_size = {0.5, 0.5, 1.7};
      json track = *person.track;
      track["run"] = image.run;
      track["attributes"] = {{"character", fmt::format("person_{:03}", i)},
                             {"sex", is_male(i) ? "male" : "female"},
                             {"age_years", 31},
                             {"age_band", "adult"},
                             {"stature_m", 1.7},
                             {"carries", "nothing"},
                             {"wears", has_dress ? "dress" : "t-shirt, jeans"},
                             {"clothes", has_dress ? json{{{"slot", "whole"}, {"type", "dress"}}}
                                                   : json{{{"slot", "upper"}, {"type", "t-shirt"}},
                                                          {{"slot", "lower"}, {"type", "jeans"}}}}};
      person.track = std::make_shared<const json>(track);
      image.people.push_back(person);
    }
    check.add(info, image, findings);
    check.finish(info, findings);
  });
}

TEST(PeopleRules, WomenWearDresses) {
  const std::string fault = "sex is male of";
  EXPECT_FALSE(any_with(sex_faults(3, [](int i) { return i > 3; }), fault));
  EXPECT_FALSE(any_with(sex_faults(0, [](int) { return true; }), fault)) << "nobody wears one";
  EXPECT_TRUE(any_with(sex_faults(4, [](int i) { return i < 3; }), fault));
  EXPECT_TRUE(any_with(sex_faults(1, [](int) { return true; }), fault));
}

}  // namespace
}  // namespace throng::checks
