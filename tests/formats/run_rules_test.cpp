// Rules about files of a whole run: tables of exits, fields, figures and sensors, made by hand so
// that their columns follow from each other, then damaged one by one.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "formats/flight_checks.h"
#include "formats/run_checks.h"
#include "tests/formats/hand_made.h"

namespace throng::formats {
namespace {

using hand_made::any_with;
using hand_made::found_by;
using nlohmann::json;
using ::testing::IsEmpty;
using Values = std::map<std::string, double>;

constexpr std::array<const char*, 14> kExitColumns = {
    "in_zone",       "density",        "normalised_density", "flow",
    "specific_flow", "approach_speed", "clogging_index",     "demand",
    "queue",         "queue_length",   "predicted_wait",     "since_crossing",
    "crossed_out",   "crossed_in"};

struct ExitRow {
  std::string state = "flowing";
  std::string offline = "flowing";
  Values value;
};

/// A door 2 m wide with a zone of 10 m^2 at a rate of two frames a second: one person a second goes
/// out, five are in the zone and walk at 1.2 m/s. Its index: density 0.5 times 0.3 is 0.15 of 0.6,
/// so that a quarter of the zone is full; half of that is the lack of flow, 1 - 1 / 2.6, as nobody
/// is slower than 0.6 times a desired speed of 1.34 m/s.
std::vector<ExitRow> exit_rows() {
  std::vector<ExitRow> rows(14);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double out = std::floor(static_cast<double>(i) / 2);
    rows[i].value = {{"in_zone", 5},
                     {"density", 0.5},
                     {"normalised_density", 0.15},
                     {"flow", 1},
                     {"specific_flow", 0.5},
                     {"approach_speed", 1.2},
                     {"clogging_index", 0.5 * 0.25 * (1 - 1 / 2.6)},
                     {"demand", 3},
                     {"queue", 2},
                     {"queue_length", 1.5},
                     {"predicted_wait", 2},
                     {"since_crossing", i % 2 == 0 ? 0.0 : 0.5},
                     {"crossed_out", out},
                     {"crossed_in", 0}};
  }
  return rows;
}

class ExitTable {
 public:
  ExitTable() : info_(hand_made::info(folder_.path())) {
    info_.frames_per_camera = 14;
    info_.annotations = {"coco", "exits"};
  }

  std::vector<ExitRow> rows = exit_rows();
  std::int64_t first_frame = 0;
  double time_offset_s = 0;

  std::vector<std::string> faults(const Image& image = hand_made::image()) const {
    std::string text = "frame,time_s,exit,state,state_offline";
    for (const char* column : kExitColumns) text += std::string(",") + column;
    text += "\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto frame = first_frame + static_cast<std::int64_t>(i);
      text +=
          fmt::format("{},{},north,{},{}", frame, 0.5 * static_cast<double>(frame) + time_offset_s,
                      rows[i].state, rows[i].offline);
      for (const char* column : kExitColumns) text += fmt::format(",{}", rows[i].value.at(column));
      text += "\n";
    }
    write_file_atomically(info_.root / "exits/run002.csv", text);
    return found_by([&](Findings& findings) {
      ExitsCheck check;
      check.add(info_, image, findings);
    });
  }
  const DatasetInfo& info() const { return info_; }

 private:
  throng::testing::TemporaryFolder folder_;
  DatasetInfo info_;
};

void expect_exit(const std::string& words,
                 const std::function<void(std::vector<ExitRow>&)>& damage) {
  ExitTable table;
  damage(table.rows);
  const auto found = table.faults();
  EXPECT_TRUE(any_with(found, words)) << words << " in " << ::testing::PrintToString(found);
}

TEST(ExitTables, SoundOnesHaveNoFaults) { EXPECT_THAT(ExitTable().faults(), IsEmpty()); }

TEST(ExitTables, ColumnsFollowFromEachOther) {
  expect_exit("line 6 north: density 0.8 is not in_zone 5",
              [](auto& rows) { rows[4].value["density"] = 0.8; });
  expect_exit("line 5 north: density 0.5 is not in_zone 6",
              [](auto& rows) { rows[3].value["in_zone"] = 6; });
  expect_exit("normalised_density 0.16 is not density",
              [](auto& rows) { rows[4].value["normalised_density"] = 0.16; });
  expect_exit("specific_flow 0.6 is not flow",
              [](auto& rows) { rows[4].value["specific_flow"] = 0.6; });
}

TEST(ExitTables, StatesFitDemandAndEachOther) {
  expect_exit("state idle with demand 3", [](auto& rows) { rows[2].state = "idle"; });
  expect_exit("state flowing with demand 0", [](auto& rows) { rows[2].value["demand"] = 0; });
  expect_exit("state_offline closed where state is flowing",
              [](auto& rows) { rows[2].offline = "closed"; });
  expect_exit("state_offline idle where state is flowing",
              [](auto& rows) { rows[2].offline = "idle"; });
  expect_exit("state_offline flowing where state is clogged",
              [](auto& rows) { rows[2].state = "clogged"; });
  expect_exit("a closed exit that opens",
              [](auto& rows) { rows[2].state = rows[2].offline = "closed"; });
  ExitTable closing;
  closing.rows[13].state = closing.rows[13].offline = "closed";
  EXPECT_THAT(closing.faults(), IsEmpty()) << "it may close and stay so";
}

TEST(ExitTables, CloggingFollowsFromDensityFlowAndSpeed) {
  expect_exit("clogging_index 0.5, but", [](auto& rows) { rows[4].value["clogging_index"] = 0.5; });
  expect_exit("clogging_index 0.01, but",
              [](auto& rows) { rows[4].value["clogging_index"] = 0.01; });
  expect_exit("clogging_index 0.0769", [](auto& rows) { rows[4].value["approach_speed"] = -0.5; });
  expect_exit("clogging_index 0.2 without demand", [](auto& rows) {
    rows[4].value["demand"] = 0;
    rows[4].state = rows[4].offline = "idle";
    rows[4].value["clogging_index"] = 0.2;
  });
}

TEST(ExitTables, QueuesOfNobodyHaveNoLength) {
  expect_exit("a queue of nobody with a length", [](auto& rows) { rows[4].value["queue"] = 0; });
  ExitTable empty;
  for (const char* column : {"queue", "queue_length", "predicted_wait"}) {
    empty.rows[4].value[column] = 0;
  }
  EXPECT_THAT(empty.faults(), IsEmpty());
  // Two people at a tenth of the capacity of 2.6 per second: at most 7.7 s.
  expect_exit("predicted_wait 8 s for a queue of 2",
              [](auto& rows) { rows[4].value["predicted_wait"] = 8; });
}

TEST(ExitTables, CrossingsGrowAndAreTheFlow) {
  expect_exit("fewer crossings than before", [](auto& rows) { rows[5].value["crossed_out"] = 1; });
  expect_exit("fewer crossings than before", [](auto& rows) {
    for (std::size_t i = 0; i < 5; ++i) rows[i].value["crossed_in"] = 1;
  });
  expect_exit("crossed_out grows, but since_crossing is 1.5",
              [](auto& rows) { rows[4].value["since_crossing"] = 1.5; });
  expect_exit("since_crossing 2.5 s, 0.5 s before it was 0 s",
              [](auto& rows) { rows[5].value["since_crossing"] = 2.5; });
  // Over 4 s, 8 frames: 4 people are 1 per second, 8 would be 2.
  expect_exit("flow 1 /s, but crossings changed by 2 /s", [](auto& rows) {
    for (std::size_t i = 12; i < rows.size(); ++i) rows[i].value["crossed_out"] += 4;
  });
  expect_exit("flow 1 /s, but crossings changed by 0.5 /s", [](auto& rows) {
    for (std::size_t i = 12; i < rows.size(); ++i) rows[i].value["crossed_in"] += 2;
  });
}

TEST(ExitTables, HaveEveryFrameOnceAtItsTime) {
  ExitTable late;
  late.time_offset_s = 0.25;
  EXPECT_TRUE(any_with(late.faults(), "line 2 time_s 0.25, but frame 0 is of 0 s"));
  ExitTable fewer;
  fewer.rows.pop_back();
  EXPECT_TRUE(any_with(fewer.faults(), "north 13 rows, but there are 14 frames"));
}

json exit_record(const char* key = "", const json& value = {}) {
  json record = {{"id", "north"},         {"in_zone", 5},         {"queue", 2},
                 {"queue_length_m", 1.5}, {"flow_per_s", 1},      {"state", "flowing"},
                 {"door", json::array()}, {"zone", json::array()}};
  if (*key != '\0') record[key] = value;
  return record;
}

TEST(ExitRecords, SayWhatTheTableSays) {
  const auto faults = [](const json& exits) {
    Image image = hand_made::image();
    image.record["exits"] = exits;
    return ExitTable().faults(image);
  };
  EXPECT_THAT(faults(json::array({exit_record()})), IsEmpty());
  for (const auto& [key, value] : std::vector<std::pair<const char*, json>>{
           {"in_zone", 6}, {"queue", 3}, {"queue_length_m", 1.6}, {"flow_per_s", 1.25}}) {
    EXPECT_TRUE(any_with(faults(json::array({exit_record(key, value)})),
                         fmt::format("image 7 {} of north is", key)))
        << key;
  }
  EXPECT_TRUE(any_with(faults(json::array({exit_record("state", "idle")})), "state of north"));
  EXPECT_TRUE(any_with(faults(json::array({exit_record("id", "south")})),
                       "exit south is not in exits/run002.csv for frame 4"));
  EXPECT_TRUE(any_with(faults(json::array()), "0 exits, but exits/run002.csv has 1"));
}

TEST(ExitRecords, PolygonsFitTheDoorAndOtherPictures) {
  // Seen from 10 m above: a point (x, y) of the ground is at (50 + 50 x / y, 40 + 500 / y) in box
  // coordinates.
  const auto seen = [](const std::vector<std::pair<double, double>>& ground) {
    json polygon = json::array();
    for (const auto& [x, y] : ground) polygon.push_back({50 + 50 * x / y, 40 + 500 / y});
    return polygon;
  };
  const json door = seen({{-1, 20}, {1, 20}, {1, 20.5}, {-1, 20.5}});
  const auto half_disc = [](double radius) {
    std::vector<std::pair<double, double>> corners;
    for (int i = 0; i <= 8; ++i) {
      const double angle = std::acos(-1) * (1 + i / 8.0);
      corners.emplace_back(radius * std::cos(angle), 20 + radius * std::sin(angle));
    }
    return corners;
  };
  const auto faults = [&](const std::vector<json>& zones) {
    ExitTable table;
    table.faults();
    return found_by([&](Findings& findings) {
      ExitsCheck check;
      for (const json& zone : zones) {
        Image image = hand_made::image();
        json record = exit_record("door", door);
        record["zone"] = zone;
        image.record["exits"] = json::array({record});
        check.add(table.info(), image, findings);
      }
    });
  };
  // A door of 2 m has a zone of 3 m about its middle.
  EXPECT_THAT(faults({seen(half_disc(3))}), IsEmpty());
  EXPECT_TRUE(any_with(faults({seen(half_disc(5))}), "exit-polygons image 7 the zone of north"));
  std::vector<std::pair<double, double>> shifted = half_disc(3);
  for (auto& corner : shifted) corner.first += 0.5;  // 1.25 px
  EXPECT_TRUE(any_with(faults({seen(half_disc(3)), seen(shifted)}),
                       "px from where other pictures have it"));
}

/// A dataset with figures of its run.
class Figures {
 public:
  Figures() : info_(hand_made::info(folder_.path())) { info_.runs = {"run000"}; }

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
  const DatasetInfo& info() const { return info_; }

 private:
  throng::testing::TemporaryFolder folder_;
  DatasetInfo info_;
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
  FieldsOfRun() : info_(hand_made::info(folder_.path())) {
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
      Image image = hand_made::image();
      image.frame = 0;
      Person walker = hand_made::person(3, {1, 1, 1, 1}, {1, 1, 1, 1}, 1);
      walker.position = {3, 2.5, 0};
      walker.velocity = {0.6, 0};
      image.people = {walker};
      check.add(info_, image, findings);
      check.finish(info_, findings);
    });
  }

 private:
  throng::testing::TemporaryFolder folder_;
  DatasetInfo info_;
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

/// A drone that hovers 30 m above the ground, level, heading along x, as its sensors say at 45
/// degrees of latitude: 30 uT cos(45) to the north (+y) and 60 uT sin(45) down.
SensorSample hovering() {
  SensorSample sample;
  sample.position = sample.gps_position = {5, 6, 30};
  sample.velocity = sample.gps_velocity = Eigen::Vector3d::Zero();
  sample.orientation = Eigen::Quaterniond::Identity();
  sample.body_rates = sample.gyro = Eigen::Vector3d::Zero();
  sample.specific_force = sample.accelerometer = {0, 0, 9.81};
  sample.magnetometer = {0, 21.2132, -42.4264};
  sample.pressure_pa = 100'965.1;  // ISO 2533 at 30 m
  sample.height_m = 30;
  return sample;
}

std::string implausible(const std::function<void(SensorSample&)>& change, double gps_age_s = 0) {
  SensorSample sample = hovering();
  change(sample);
  return implausible_reading(sample, 45, 0, gps_age_s);
}

TEST(SensorErrors, AreWithinSixDeviations) {
  EXPECT_EQ(implausible([](SensorSample&) {}), "");
  // 6 x 0.5 degrees per second and 0.02 rad/s are 0.072 rad/s.
  EXPECT_EQ(implausible([](SensorSample& s) { s.gyro.x() = 0.07; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.gyro.x() = 0.08; }),
              ::testing::HasSubstr("gyro"));
  // 6 x 0.196 + 0.2 = 1.376 m/s^2.
  EXPECT_EQ(implausible([](SensorSample& s) { s.accelerometer.y() = -1.3; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.accelerometer.y() = -1.4; }),
              ::testing::HasSubstr("accelerometer"));
  // 6 x 1.3 % of 47.4 uT + 0.5 = 4.2 uT.
  EXPECT_EQ(implausible([](SensorSample& s) { s.magnetometer.x() = 4.0; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.magnetometer.x() = 4.5; }),
              ::testing::HasSubstr("magnetometer"));
  EXPECT_THAT(implausible([](SensorSample& s) { s.height_m = 30.5; }),
              ::testing::HasSubstr("height_m is 30.50, but the pressure is that of 30.0"));
  EXPECT_EQ(implausible([](SensorSample& s) { s.gps_position.x() += 5.9; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.gps_position.x() += 6.1; }),
              ::testing::HasSubstr("GPS"));
  EXPECT_EQ(implausible([](SensorSample& s) { s.gps_position.z() += 11.9; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.gps_velocity.x() = 1.1; }),
              ::testing::HasSubstr("velocity"));
  EXPECT_EQ(implausible([](SensorSample& s) { s.gps_velocity.x() = 1.1; }, 0.2), "")
      << "an old fix may be off by what the drone did";
}

TEST(SensorErrors, SeeTheFieldInTheBodysFrame) {
  // Turned by 90 degrees to the left, the nose is north: the field is ahead.
  const Eigen::Quaterniond left(Eigen::AngleAxisd(std::acos(-1) / 2, Eigen::Vector3d::UnitZ()));
  EXPECT_EQ(implausible([&](SensorSample& s) {
              s.orientation = left;
              s.magnetometer = {21.2132, 0, -42.4264};
            }),
            "");
  EXPECT_THAT(implausible([&](SensorSample& s) { s.orientation = left; }),
              ::testing::HasSubstr("magnetometer"));
}

/// A picture with the flight record of hovering(): the camera looks along +y, level.
Image with_flight() {
  Image image = hand_made::image();
  const SensorSample s = hovering();
  image.t = -image.R * s.position;
  const auto list = [](const Eigen::Vector3d& v) { return json{v.x(), v.y(), v.z()}; };
  const Eigen::Quaterniond camera(Eigen::Matrix3d(image.R.transpose()));
  const json gimbal = {{"yaw_deg", 90}, {"pitch_deg", 0}, {"roll_deg", 0}};
  image.record["flight"] = {
      {"true",
       {{"position", list(s.position)},
        {"velocity", {0, 0, 0}},
        {"height_m", 30},
        {"time_s", 2},
        {"orientation_wxyz", {1, 0, 0, 0}},
        {"camera_orientation_wxyz", {camera.w(), camera.x(), camera.y(), camera.z()}},
        {"gimbal", gimbal},
        {"body_rates", {0, 0, 0}},
        {"specific_force", {0, 0, 9.81}},
        {"horizon_rows", {39.5, 39.5}},
        {"energy_wh", 1}}},
      {"measured",
       {{"time_s", 1.99},
        {"gimbal", gimbal},
        {"gyro", {0, 0, 0}},
        {"accelerometer", {0, 0, 9.81}},
        {"magnetometer_ut", list(s.magnetometer)},
        {"pressure_pa", s.pressure_pa},
        {"height_m", 30},
        {"gps", {{"time_s", 1.8}, {"position", list(s.position)}, {"velocity", {0, 0, 0}}}}}}};
  return image;
}

std::vector<std::string> flight_faults(const std::function<void(json&)>& damage) {
  Image image = with_flight();
  damage(image.record["flight"]);
  return found_by([&](Findings& findings) { check_flight(image, findings); });
}

TEST(FlightRecords, SoundOnesHaveNoFaults) {
  EXPECT_THAT(flight_faults([](json&) {}), IsEmpty());
  EXPECT_THAT(found_by([](Findings& findings) { check_flight(hand_made::image(), findings); }),
              IsEmpty())
      << "a picture without one";
}

TEST(FlightRecords, AreTheCameras) {
  const auto expect = [](const std::string& words, const std::function<void(json&)>& damage) {
    const auto found = flight_faults(damage);
    EXPECT_TRUE(any_with(found, words)) << words << " in " << ::testing::PrintToString(found);
  };
  expect("position is 1.000 m from", [](json& f) { f["true"]["position"][0] = 6; });
  expect("height_m is not the position's z", [](json& f) { f["true"]["height_m"] = 31; });
  expect("time_s is not time_s", [](json& f) { f["true"]["time_s"] = 2.1; });
  expect("has not length 1", [](json& f) { f["true"]["orientation_wxyz"][0] = 1.1; });
  expect("camera_orientation_wxyz", [](json& f) {
    f["true"]["camera_orientation_wxyz"] = {1, 0, 0, 0};
  });
  expect("horizon_rows[1] is 41.00, but the camera's horizon is at 39.50",
         [](json& f) { f["true"]["horizon_rows"][1] = 41; });
  expect("flight.true.gimbal is 1.000 degrees",
         [](json& f) { f["true"]["gimbal"]["pitch_deg"] = -1; });
  expect("flight.measured.gimbal is 13.00 degrees",
         [](json& f) { f["measured"]["gimbal"]["yaw_deg"] = 103; });
  expect("measured.time_s is 0.100 s before", [](json& f) { f["measured"]["time_s"] = 1.9; });
  expect("measured.time_s is -0.100 s before", [](json& f) { f["measured"]["time_s"] = 2.1; });
  expect("the GPS fix is 0.500 s old", [](json& f) { f["measured"]["gps"]["time_s"] = 1.5; });
  expect("flight.measured: gyro", [](json& f) { f["measured"]["gyro"][2] = 3; });
  EXPECT_THAT(flight_faults([](json& f) { f["measured"]["gimbal"]["yaw_deg"] = 101; }), IsEmpty())
      << "a gimbal may read some degrees wrong";
  EXPECT_THAT(flight_faults([](json& f) { f["true"]["gimbal"]["yaw_deg"] = -270; }), IsEmpty())
      << "a full turn";
}

TEST(FlightRecords, FollowFromTheFrameBefore) {
  const auto faults = [](double moved_x, double velocity_x, double energy_wh) {
    Image before = with_flight();
    Image after = with_flight();
    after.id = 8;
    after.time_s = 2.5;
    after.record["flight"]["true"]["position"][0] = 5 + moved_x;
    for (Image* image : {&before, &after}) {
      image->record["flight"]["true"]["velocity"][0] = velocity_x;
    }
    after.record["flight"]["true"]["energy_wh"] = energy_wh;
    return found_by([&](Findings& findings) { check_flight_between(before, after, findings); });
  };
  EXPECT_THAT(faults(1, 2, 1.05), IsEmpty()) << "0.5 s at 2 m/s, 360 W";
  EXPECT_TRUE(any_with(faults(2, 2, 1.05), "flight image 8 the drone moved (2.00"));
  EXPECT_TRUE(any_with(faults(1, 2, 0.9), "energy_wh grows by -720 W"));
  EXPECT_TRUE(any_with(faults(1, 2, 2), "energy_wh grows by 7200 W"));
}

/// Rows of a sensor table at 60 Hz of a drone that flies at 2 m/s along x at 30 m.
std::vector<std::vector<double>> sensor_rows() {
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < 180; ++i) {
    const double t = i / 60.0;
    const double fix = std::floor(t * 5) / 5;
    rows.push_back({t,         5 + 2 * t, 6,   30,          2, 0,  0,    1, 0,       0,
                    0,         0,         0,   0,           0, 0,  9.81, 0, 0,       0,
                    200 * t,   0,         0,   0,           0, 0,  9.81, 0, 21.2132, -42.4264,
                    100'965.1, 30,        fix, 5 + 2 * fix, 6, 30, 2,    0, 0});
  }
  return rows;
}

std::vector<std::string> sensor_faults(
    const std::function<void(std::vector<std::vector<double>>&)>& damage,
    const std::function<void(json&)>& flight = {}) {
  const throng::testing::TemporaryFolder folder;
  auto rows = sensor_rows();
  damage(rows);
  std::string text = "t";
  for (int i = 1; i < 39; ++i) text += fmt::format(",c{}", i);
  for (const auto& row : rows) {
    text += "\n";
    for (std::size_t i = 0; i < row.size(); ++i)
      text += fmt::format("{}{}", i == 0 ? "" : ",", row[i]);
  }
  write_file_atomically(folder.path() / "sensors/run002/d1.csv", text + "\n");
  Image image = with_flight();
  json& record = image.record["flight"];
  record["true"]["position"] = {9, 6, 30};
  record["true"]["velocity"] = {2, 0, 0};
  record["true"]["air_velocity"] = {0, 0, 0};
  record["true"]["energy_wh"] = 400.0 / 3600;
  record["measured"]["time_s"] = 2;
  record["measured"]["gps"] = {{"time_s", 2.0}, {"position", {9, 6, 30}}, {"velocity", {2, 0, 0}}};
  if (flight) flight(record);
  return found_by([&](Findings& findings) {
    SensorTableCheck check;
    check.add(hand_made::info(folder.path()), image, findings);
  });
}

TEST(SensorTables, SoundOnesHaveNoFaults) {
  EXPECT_THAT(sensor_faults([](auto&) {}), IsEmpty());
}

TEST(SensorTables, RowsFollowFromEachOther) {
  const auto expect = [](const std::string& words, std::size_t column, double value) {
    const auto found = sensor_faults([&](auto& rows) { rows[90][column] = value; });
    EXPECT_TRUE(any_with(found, "sensors line 92 " + words))
        << words << " in " << ::testing::PrintToString(found);
  };
  expect("time_s 1.4 after", 0, 1.4);
  expect("moved by", 1, 9);
  expect("velocity changes by", 5, 0.1);
  expect("turns by", 10, 0.1);
  expect("energy_j grows by", 20, 500);
  expect("gps_time_s", 32, 1.6);
  expect("another GPS position", 33, 7.7);
  expect("air velocity jumps", 17, 9);
  expect("gyro is", 21, 1);
  expect("height_m is 30.00, but", 30, 95'000);
}

TEST(SensorTables, AreNumbers) {
  EXPECT_TRUE(any_with(
      sensor_faults([](auto& rows) { rows[3][7] = std::numeric_limits<double>::quiet_NaN(); }),
      "line 5 not 39 numbers"));
}

TEST(SensorTables, SayWhatThePicturesSay) {
  const auto expect = [](const std::string& words, const std::function<void(json&)>& damage) {
    const auto found = sensor_faults([](auto&) {}, damage);
    EXPECT_TRUE(any_with(found, words)) << words << " in " << ::testing::PrintToString(found);
  };
  expect("line 122 gyro is not what flight.measured of image 7 says",
         [](json& f) { f["measured"]["gyro"][0] = 0.01; });
  expect("gps.position is not", [](json& f) { f["measured"]["gps"]["position"][1] = 6.1; });
  expect("pressure_pa is not", [](json& f) { f["measured"]["pressure_pa"] = 100'970; });
  expect("time_s is not", [](json& f) { f["measured"]["time_s"] = 1.99; });
  expect("position is not what flight.true of image 7 says",
         [](json& f) { f["true"]["position"][0] = 9.1; });
  expect("orientation_wxyz is not", [](json& f) {
    f["true"]["orientation_wxyz"] = {std::cos(0.01), 0, 0, std::sin(0.01)};
  });
  expect("energy_wh is not", [](json& f) { f["true"]["energy_wh"] = 0.12; });
  expect("air_velocity is not", [](json& f) { f["true"]["air_velocity"][2] = 1; });
}

}  // namespace
}  // namespace throng::formats
