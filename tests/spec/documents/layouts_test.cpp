// Layouts that Studio and the Python package read.
#include "spec/documents/layouts.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/files/files.h"
#include "base/files/resources.h"
#include "spec/annotate/table_columns.h"

namespace throng::layouts {
namespace {

TEST(Layouts, TheFileOfOtherLanguagesIsThatOfTheTables) {
  EXPECT_TRUE(read_file(source_folder() / "python/throng/layouts.json") == layouts_text())
      << "run: build/release/spec/job_schema .";
}

// A change of these breaks clients that were written before: raise the version then.
TEST(Layouts, RecordsOfThisVersionAreThoseThatClientsKnow) {
  const auto document = nlohmann::json::parse(layouts_text());
  EXPECT_EQ(document.at("live").at("version"), 2);
  EXPECT_EQ(document.at("live").at("person").dump(),
            R"([["position","<f4",2],["yaw","<i2",1],["state","|u1",1],["flags","|u1",1]])");
  EXPECT_EQ(document.at("trajectories").at("version"), 1);
  EXPECT_EQ(document.at("trajectories").at("agent").dump(),
            R"([["position","<u2",2],["state","|u1",1],["flags","|u1",1]])");
  EXPECT_EQ(document.at("agent_flags").dump(),
            R"({"fallen":4,"following":8,"panicked":2,"present":1})");
}

TEST(Layouts, ColumnsAreFoundByName) {
  EXPECT_EQ(annotate::column_count("a,bc,d"), 3U);
  static_assert(annotate::column_index("a,bc,d", "a") == 0);
  static_assert(annotate::column_index("a,bc,d", "d") == 2);
  static_assert(annotate::column_index(annotate::kSensorColumns, "gyro_x_rad_s") == 21);
}

}  // namespace
}  // namespace throng::layouts
