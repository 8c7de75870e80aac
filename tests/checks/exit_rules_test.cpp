// Rules about the tables and records of exits, made by hand so that their columns follow from each
// other, then damaged one by one.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/error.h"
#include "checks/run_checks.h"
#include "spec/annotate/table_columns.h"
#include "tests/checks/found_by.h"
#include "tests/formats/hand_made.h"

namespace throng::checks {
namespace {

using formats::hand_made::any_with;
using nlohmann::json;
using ::testing::IsEmpty;
using Values = std::map<std::string, double>;

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

/// A column that no rule reads is 0.
std::string cell_value(const ExitRow& row, const std::string& column) {
  const auto found = row.value.find(column);
  return fmt::format("{}", found == row.value.end() ? 0 : found->second);
}

class ExitTable {
 public:
  ExitTable() : info_(formats::hand_made::info(folder_.path())) {
    info_.frames_per_camera = 14;
    info_.annotations = {"coco", "exits"};
  }

  std::vector<ExitRow> rows = exit_rows();
  std::int64_t first_frame = 0;
  double time_offset_s = 0;

  std::vector<std::string> faults(const formats::Image& image = formats::hand_made::image()) const {
    std::string text = fmt::format("{}\n", annotate::kExitColumns);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto frame = first_frame + static_cast<std::int64_t>(i);
      std::istringstream columns{std::string(annotate::kExitColumns)};
      for (std::string column; std::getline(columns, column, ',');) {
        text += column == "frame" ? fmt::format("{}", frame)
                : column == "time_s"
                    ? fmt::format(",{}", 0.5 * static_cast<double>(frame) + time_offset_s)
                : column == "exit"          ? ",north"
                : column == "state"         ? "," + rows[i].state
                : column == "state_offline" ? "," + rows[i].offline
                                            : "," + cell_value(rows[i], column);
      }
      text += "\n";
    }
    write_file_atomically(info_.root / "exits/run002.csv", text);
    return found_by([&](Findings& findings) {
      ExitsCheck check;
      check.add(info_, image, findings);
    });
  }
  const formats::DatasetInfo& info() const { return info_; }

 private:
  throng::testing::TemporaryFolder folder_;
  formats::DatasetInfo info_;
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

TEST(ExitRecords, AgreeWithTheTable) {
  const auto faults = [](const json& exits) {
    formats::Image image = formats::hand_made::image();
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

TEST(ExitRecords, PolygonsFitTheDoorAndOtherImages) {
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
        formats::Image image = formats::hand_made::image();
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
  EXPECT_TRUE(
      any_with(faults({seen(half_disc(3)), seen(shifted)}), "px from where other images have it"));
}

}  // namespace
}  // namespace throng::checks
