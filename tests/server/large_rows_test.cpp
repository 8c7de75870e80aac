// Lists of what clients have stored take bounded memory, whatever it is.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "base/error.h"
#include "server/http/answer_budget.h"
#include "tests/server/api_fixture.h"
#include "tests/server/bundles.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;
using throng::testing::packed;
using throng::testing::Packing;

constexpr int kNoteBytes = 700'000;

class LargeRows : public ApiTest {
 protected:
  /// Submits jobs, newest first, of which one runs. The texts of the others become as large as
  /// clients could make them, and they become of this kind.
  std::vector<std::string> submit_large(const std::string& kind) const {
    std::vector<std::string> ids(20);
    for (std::string& id : ids) id = submit();
    std::reverse(ids.begin(), ids.end());
    EXPECT_TRUE(wait_until([&] { return get_json("/v1/jobs?state=running")["jobs"].size() == 1; }));
    SQLite::Database database(data.path() / "jobs.sqlite", SQLite::OPEN_READWRITE, 60'000);
    database.exec(fmt::format(
        "UPDATE job SET kind = '{0}', spec = json_object('note', replace(hex(zeroblob({1} / 2)), "
        "'0', 'x')), progress = json_object('note', replace(hex(zeroblob({1} / 2)), '0', 'y')) "
        "WHERE state = 'queued'",
        kind, kNoteBytes));
    return ids;
  }

  /// Ids of all rows of a list, and the size of its largest page.
  std::pair<std::vector<std::string>, std::size_t> all_pages(const std::string& path,
                                                             const char* name) const {
    std::vector<std::string> ids;
    std::size_t largest = 0;
    std::string after;
    do {
      const httplib::Result answer = get(path + (after.empty() ? "" : "&after=" + after));
      EXPECT_EQ(answer->status, 200);
      largest = std::max(largest, answer->body.size());
      const json page = json::parse(answer->body);
      for (const json& row : page.at(name)) ids.push_back(row.at("id"));
      after = page.at("next").is_null() ? "" : page.at("next").get<std::string>();
    } while (!after.empty());
    return {ids, largest};
  }
};

TEST_F(LargeRows, ListsHoldNoJobsAndPagesEndByTheirSize) {
  Gate gate(executor);
  const std::vector<std::string> ids = submit_large("dataset");
  const auto [listed, largest] = all_pages("/v1/jobs?limit=500", "jobs");
  EXPECT_EQ(listed, ids);
  EXPECT_LT(largest, 6U << 20U);
  EXPECT_FALSE(get_json("/v1/jobs?limit=1")["jobs"][0].contains("job"));
  EXPECT_EQ(get_json("/v1/jobs/" + ids[0])["job"]["note"], std::string(kNoteBytes, 'x'));
}

TEST_F(LargeRows, CalibrationsAreListedByTheirSizeToo) {
  Gate gate(executor);
  std::vector<std::string> ids = submit_large("calibration");
  const auto [listed, largest] = all_pages("/v1/calibrations?limit=500", "calibrations");
  ids.pop_back();  // the one that runs is still a job
  EXPECT_EQ(listed, ids);
  EXPECT_LT(largest, 6U << 20U);
}

TEST_F(LargeRows, TextsOfScenariosAreBounded) {
  SKIP_WITHOUT_PROGRAM();
  testing::Yard yard;
  yard.scenario["description"] = std::string(40 << 10, 'x');
  const auto upload = [&] {
    return client().Post("/v1/scenarios?name=mine", packed(Packing::zip, yard_files(yard)),
                         "application/zip");
  };
  const httplib::Result refused = upload();
  expect_problem(refused, 400);
  EXPECT_THAT(refused->body, HasSubstr("at most 32768"));
  yard.scenario["description"] = std::string(8 << 10, 'x');
  EXPECT_EQ(upload()->status, 201);
  const json list = get_json("/v1/scenarios");
  EXPECT_EQ(list["scenarios"].size(), 2U);
  EXPECT_EQ(list["next"], nullptr);
  EXPECT_EQ(get_json("/v1/scenarios?after=mine/yard")["scenarios"].size(), 1U);
}

TEST(AnswerBudget, AnswersWaitForEachOtherAndAreRefusedInTheEnd) {
  AnswerBudget budget(100, std::chrono::milliseconds(1));
  auto first = budget.reserve(80);
  EXPECT_THROW(budget.reserve(30), HttpError);
  first->shrink(60);
  const auto second = budget.reserve(30);
  EXPECT_THROW(budget.reserve(30), HttpError);
  first.reset();
  EXPECT_NE(budget.reserve(70), nullptr);
}

}  // namespace
}  // namespace throng::server
