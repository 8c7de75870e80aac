// Rules about the figures and fields of a run, made by hand so that they follow from each other,
// then damaged one by one.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "checks/run_checks.h"
#include "tests/checks/found_by.h"
#include "tests/formats/hand_made.h"

namespace throng::checks {
namespace {

using formats::hand_made::any_with;
using nlohmann::json;
using ::testing::IsEmpty;

/// A dataset with figures of its run.
class Figures {
 public:
  Figures() : info_(formats::hand_made::info(folder_.path())) { info_.runs = {"run000"}; }

  json run = {
      {"run", "run000"},
      {"seed", 5},
      {"people", 2},
      {"duration_s", 10},
      {"by_person", {{"agent", {0, 1}}, {"out_s", {3.0, nullptr}}}},
      {"escape_curve", {{"escaped_share", {0, 0.25, 0.5, 1}}}},
      {"escape_time_percentiles", {{"t25_s", 2}, {"t50_s", 3}, {"t100_s", 9.5}}},
      {"exits", json::array({{{"id", "north"},
                              {"time_in_state", {{"idle", 4}, {"flowing", 6}}},
                              {"gaps", {{"count", 2}, {"list_s", {1.5, 2.5}}, {"longest_s", 2.5}}},
                              {"mean_clogging_index", 0.25},
                              {"share_of_net_out", 1},
                              {"max_queue", 4}}})}};
  json copy_change = json::object();

  std::vector<std::string> faults(const json& manifest_run = {{"run", "run000"},
                                                              {"seed", 5}}) const {
    write_file_atomically(info_.root / "metrics.json", json{{"runs", json::array({run})}}.dump());
    json copy = run;
    copy.update(copy_change);
    write_file_atomically(info_.root / "metrics/run000.json", copy.dump());
    write_file_atomically(info_.root / "exits/run000.csv",
                          "exit,queue\nnorth,3\nnorth,4\nsouth,9\n");
    return found_by([&](Findings& findings) {
      check_metrics(info_, {{"runs", json::array({manifest_run})}}, findings);
    });
  }
  const formats::DatasetInfo& info() const { return info_; }

 private:
  throng::testing::TemporaryFolder folder_;
  formats::DatasetInfo info_;
};

void expect_figure(const std::string& words, const std::function<void(json&)>& damage) {
  Figures figures;
  damage(figures.run);
  const auto found = figures.faults();
  EXPECT_TRUE(any_with(found, words)) << words << " in " << ::testing::PrintToString(found);
}

TEST(FigureRules, SoundFiguresHaveNoFaults) { EXPECT_THAT(Figures().faults(), IsEmpty()); }

TEST(FigureRules, AreOfTheManifestsRunsAndSeeds) {
  EXPECT_TRUE(any_with(Figures().faults({{"run", "run000"}, {"seed", 6}}),
                       "metrics run000 not the manifest's run and seed"));
  expect_figure("not the manifest's run", [](json& run) { run["run"] = "run001"; });
  Figures other;
  other.copy_change = {{"people", 1}};
  EXPECT_TRUE(any_with(other.faults(), "metrics /people not what metrics.json says"));
}

TEST(FigureRules, EscapesGrowToOne) {
  expect_figure("escape_curve goes from 0.5 to 0.4",
                [](json& run) { run["escape_curve"]["escaped_share"][3] = 0.4; });
  expect_figure("escape_curve goes from 0.5 to 1.1",
                [](json& run) { run["escape_curve"]["escaped_share"][3] = 1.1; });
  expect_figure("t100_s 2.5 is below an earlier percentile",
                [](json& run) { run["escape_time_percentiles"]["t100_s"] = 2.5; });
  expect_figure("people 3, but by_person has 2", [](json& run) { run["people"] = 3; });
  expect_figure("by_person.out_s has 3 entries",
                [](json& run) { run["by_person"]["out_s"].push_back(4); });
}

TEST(FigureRules, ExitsSumUp) {
  expect_figure("time_in_state of north sums to 11.00 s of 10 s",
                [](json& run) { run["exits"][0]["time_in_state"]["idle"] = 5; });
  expect_figure("gaps of north", [](json& run) { run["exits"][0]["gaps"]["count"] = 3; });
  expect_figure("gaps of north", [](json& run) { run["exits"][0]["gaps"]["longest_s"] = 2; });
  expect_figure("mean_clogging_index of north is 1.5",
                [](json& run) { run["exits"][0]["mean_clogging_index"] = 1.5; });
  expect_figure("share_of_net_out of north is -0.5",
                [](json& run) { run["exits"][0]["share_of_net_out"] = -0.5; });
  expect_figure("max_queue of north is 3, but exits/run000.csv line 3 has 4",
                [](json& run) { run["exits"][0]["max_queue"] = 3; });
}

TEST(FigureRules, AreTheJsonOfAllRuns) {
  Figures figures;
  figures.faults();
  const auto faults = [&](const std::string& text) {
    write_file_atomically(figures.info().root / "metrics.json", text);
    return found_by([&](Findings& findings) {
      check_metrics(figures.info(), {{"runs", json::array()}}, findings);
    });
  };
  EXPECT_TRUE(any_with(faults("{"), "not the JSON that throng wrote"));
  EXPECT_TRUE(any_with(faults("[]"), "not the JSON that throng wrote"));
  EXPECT_TRUE(any_with(faults(R"({"runs":[]})"), "0 runs, but the manifest has 1"));
  std::filesystem::remove(figures.info().root / "metrics.json");
  EXPECT_THAT(found_by([&](Findings& findings) {
                check_metrics(figures.info(), {{"runs", json::array()}}, findings);
              }),
              IsEmpty());
}

/// Four planes of 10 x 12 cells of 0.5 m: one person at (3, 2.5), everything in their cell.
class FieldsOfRun {
 public:
  FieldsOfRun() : info_(formats::hand_made::info(folder_.path())) {
    info_.runs = {"run002"};
    info_.frames_per_camera = 1;
    values.assign(4 * 120, 0);
    // A Gaussian of kernel 0.5 m that sums to one person over cells of 0.25 m^2.
    double sum = 0;
    for (int i = 0; i < 120; ++i) sum += weight(i);
    for (int i = 0; i < 120; ++i) {
      const auto at = static_cast<std::size_t>(i);
      values[at] = static_cast<float>(weight(i) / sum / 0.25);
      values[120 + at] = weight(i) > 0 ? 0.6F : 0;
      values[360 + at] = i == 5 * 12 + 6 ? 4 : 0;
    }
  }
  static double weight(int cell) {
    const int row = cell / 12;
    const double x = 0.5 * (cell % 12 + 0.5) - 3;
    const double y = 0.5 * (row + 0.5) - 2.5;
    const double r = std::hypot(x, y);
    return r > 1.5 ? 0 : std::exp(-r * r / 0.25);
  }

  std::vector<float> values;
  double people = 1;
  std::string shape = "(4, 10, 12)";

  std::vector<std::string> faults() const {
    const json record = {{"origin_m", {0, 0}}, {"cell_m", 0.5}, {"kernel_m", 0.5},
                         {"rows", 10},         {"columns", 12}, {"people", json::array({people})}};
    write_file_atomically(info_.root / "fields/run002.json", record.dump());
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': " + shape + ", }";
    header.resize(118, ' ');
    std::string bytes =
        std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    write_file_atomically(info_.root / "fields/run002/000000.npy", bytes);
    return found_by([&](Findings& findings) {
      FieldsCheck check;
      formats::Image image = formats::hand_made::image();
      image.frame = 0;
      formats::Person walker = formats::hand_made::person(3, {1, 1, 1, 1}, {1, 1, 1, 1}, 1);
      walker.position = {3, 2.5, 0};
      walker.velocity = {0.6, 0};
      image.people = {walker};
      check.add(info_, image, findings);
      check.finish(info_, findings);
    });
  }

 private:
  throng::testing::TemporaryFolder folder_;
  formats::DatasetInfo info_;
};

TEST(FieldRules, SumToThePeople) {
  EXPECT_THAT(FieldsOfRun().faults(), IsEmpty());
  FieldsOfRun more;
  more.people = 3;
  EXPECT_TRUE(any_with(more.faults(), "fields"));
  FieldsOfRun doubled;
  for (std::size_t i = 0; i < 120; ++i) doubled.values[i] *= 2;
  EXPECT_TRUE(any_with(doubled.faults(), "fields"));
  FieldsOfRun infinite;
  infinite.values[17] = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(any_with(infinite.faults(), "fields"));
}

TEST(FieldRules, HaveTheirShape) {
  FieldsOfRun turned;
  turned.shape = "(4, 12, 10)";
  EXPECT_TRUE(any_with(turned.faults(), "another shape or type"));
  FieldsOfRun shorter;
  shorter.values.pop_back();
  EXPECT_TRUE(any_with(shorter.faults(), "another shape or type"));
}

/// Two frames of three people, of whom an image shows the second; the third comes late.
class TrajectoriesOfRun {
 public:
  TrajectoriesOfRun() : info_(formats::hand_made::info(folder_.path())) {
    info_.runs = {"run002"};
    info_.frames_per_camera = 2;
    info_.from_s = 1;
    info_.rate_hz = 1;
  }

  std::vector<float> values = {0, 0, 0, 0, 3,    2.5F, 1, 1, kNaN, kNaN, kNaN, kNaN,
                               1, 0, 0, 0, 3.5F, 2.5F, 1, 1, 9,    9,    0,    0};
  json description = {{"times_s", {1, 2}}, {"track_ids", {2, 3, 7}}, {"states", {"Walk", "Wait"}}};
  std::int64_t shown_track = 3;
  double shown_s = 2;
  double shown_heading_rad = 1 - 2 * std::numbers::pi;

  std::vector<std::string> faults() const {
    write_file_atomically(info_.root / "trajectories/run002.json", description.dump());
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3, 4), }";
    header.resize(118, ' ');
    std::string bytes =
        std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    write_file_atomically(info_.root / "trajectories/run002.npy", bytes);
    return found_by([&](Findings& findings) {
      TrajectoriesCheck check;
      formats::Image image = formats::hand_made::image();
      image.frame = 1;
      image.time_s = shown_s;
      formats::Person person = formats::hand_made::person(3, {1, 1, 1, 1}, {1, 1, 1, 1}, 1);
      person.track_id = shown_track;
      person.position = {3.502, 2.5, 0};
      person.heading_rad = shown_heading_rad;
      person.record["behaviour"] = "Wait";
      image.people = {person};
      check.add(info_, image, findings);
      check.finish(info_, findings);
    });
  }

 private:
  static constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  throng::testing::TemporaryFolder folder_;
  formats::DatasetInfo info_;
};

TEST(TrajectoryRules, AreThoseOfThePeopleInImages) {
  EXPECT_THAT(TrajectoriesOfRun().faults(), IsEmpty());
  TrajectoriesOfRun off;
  off.values[16] += 0.05F;
  EXPECT_TRUE(any_with(off.faults(), "0.05 m from the position"));
  TrajectoriesOfRun turned;
  turned.shown_heading_rad = 2;
  EXPECT_TRUE(any_with(turned.faults(), "heading 1.00, in an image 2.00"));
  TrajectoriesOfRun other;
  other.values[19] = 0;
  EXPECT_TRUE(any_with(other.faults(), "state \"Walk\", in an image \"Wait\""));
  TrajectoriesOfRun unknown;
  unknown.shown_track = 4;
  EXPECT_TRUE(any_with(unknown.faults(), "no track 4"));
  TrajectoriesOfRun late;
  late.shown_s = 2.5;
  EXPECT_TRUE(any_with(late.faults(), "in an image at 2.5 s"));
}

TEST(TrajectoryRules, HoldOfPeopleWhomNoCameraSees) {
  TrajectoriesOfRun fast;
  fast.values[12] = 20;
  EXPECT_TRUE(any_with(fast.faults(), "20.00 m in 1 s"));
  TrajectoriesOfRun partly;
  partly.values[9] = 3;
  EXPECT_TRUE(any_with(partly.faults(), "no numbers"));
  TrajectoriesOfRun state;
  state.values[23] = 2;
  EXPECT_TRUE(any_with(state.faults(), "state 2"));
  TrajectoriesOfRun unordered;
  unordered.description["track_ids"] = {3, 2, 7};
  EXPECT_TRUE(any_with(unordered.faults(), "another order"));
  TrajectoriesOfRun shorter;
  shorter.values.pop_back();
  EXPECT_TRUE(any_with(shorter.faults(), "another shape or type"));
  TrajectoriesOfRun wrong;
  wrong.description = json::array();
  EXPECT_FALSE(wrong.faults().empty());
}

}  // namespace
}  // namespace throng::checks
