// Lists of the job store: pages, filters, and the indexes that they use.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "jobs/queue/store/store_rows.h"
#include "tests/jobs/queue/store_fixture.h"

namespace throng::jobs {
namespace {

TEST_F(StoreTest, PagesListEveryJobOnceNewestFirst) {
  Store store(folder.path(), clock());
  std::vector<std::string> added(25);
  for (std::string& id : added) id = store.add({"n", "{}"}).row.id;
  std::vector<std::string> listed;
  std::string after;
  for (std::vector<JobRow> page; !(page = store.list({.after = after, .limit = 10})).empty();
       after = page.back().id) {
    for (const JobRow& row : page) listed.push_back(row.id);
  }
  std::reverse(added.begin(), added.end());
  EXPECT_EQ(listed, added);
}

TEST_F(StoreTest, ListsAreFiltered) {
  Store store(folder.path(), clock());
  const JobRow night = store.add({.name = "Night square", .labels = {"paper", "a'b"}}).row;
  const JobRow day = store.add({.name = "day", .labels = {"paper"}}).row;
  store.apply(day, JobEvent::cancel);
  const auto names = [&](const JobFilter& filter) {
    std::vector<std::string> found;
    for (const JobRow& row : store.list(filter)) found.push_back(row.name);
    return found;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names({.states = {JobState::queued}}), Names{"Night square"});
  EXPECT_EQ(names({.states = {JobState::queued, JobState::cancelled}}).size(), 2U);
  EXPECT_EQ(names({.label = "a'b"}), Names{"Night square"});
  EXPECT_EQ(names({.label = "pap"}), Names{});
  EXPECT_EQ(names({.name_part = "SQUARE"}), Names{"Night square"});
  EXPECT_EQ(names({.oldest_first = true}), (Names{"Night square", "day"}));
  EXPECT_EQ(names({.oldest_first = true, .after = night.id}), Names{"day"});
  EXPECT_EQ(store.count().at(JobState::cancelled), 1);
  EXPECT_EQ(store.count().at(JobState::running), 0);
}

TEST_F(StoreTest, PartsOfNamesAreFoundAsTheyStandThere) {
  Store store(folder.path(), clock());
  for (const char* name : {"a \"quoted\" name",
                           "Stra\xC3\x9F"
                           "e am See",
                           "AND OR NOT", "100%_"}) {
    store.add({.name = name});
  }
  const auto found = [&](const std::string& part) {
    std::vector<std::string> names;
    for (const JobRow& row : store.list({.name_part = part})) names.push_back(row.name);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(found("\"quo"), Names{"a \"quoted\" name"});
  EXPECT_EQ(found("ra\xC3\x9F"
                  "e"),
            Names{"Stra\xC3\x9F"
                  "e am See"});
  EXPECT_EQ(found("D or n"), Names{"AND OR NOT"});
  EXPECT_EQ(found("0%_"), Names{"100%_"});
  EXPECT_EQ(found("%%%"), Names{});
  EXPECT_EQ(found("***"), Names{});
  EXPECT_EQ(found("ee"), Names{"Stra\xC3\x9F"
                               "e am See"})
      << "too short for the index";
  EXPECT_EQ(found(std::string("na\0me", 5)), Names{});
  EXPECT_EQ(found("\xff\xfe\xfd\xfc"), Names{});
}

TEST_F(StoreTest, ListsOfLabelsAndNamesHavePagesInBothOrders) {
  Store store(folder.path(), clock());
  std::array<std::string, 7> ids;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = store.add({.name = i % 2 == 0 ? "even one" : "odd one", .labels = {"x"}}).row.id;
  }
  store.remove(ids[2]);
  const auto pages = [&](JobFilter filter) {
    filter.limit = 2;
    std::vector<std::string> found;
    for (auto rows = store.list(filter); !rows.empty(); rows = store.list(filter)) {
      for (const JobRow& row : rows) found.push_back(row.id);
      filter.after = rows.back().id;
    }
    return found;
  };
  using Ids = std::vector<std::string>;
  EXPECT_EQ(pages({.label = "x"}), (Ids{ids[6], ids[5], ids[4], ids[3], ids[1], ids[0]}));
  EXPECT_EQ(pages({.name_part = "even"}), (Ids{ids[6], ids[4], ids[0]}));
  EXPECT_EQ(pages({.name_part = "even", .oldest_first = true}), (Ids{ids[0], ids[4], ids[6]}));
  EXPECT_EQ(pages({.label = "x", .name_part = "one", .oldest_first = true}).size(), 6U);
  EXPECT_EQ(store.list({.name_part = "even", .after = ids[2]}).size(), 1U) << "which is removed";
  store.change(ids[4], {.labels = {"y", "y"}});
  EXPECT_EQ(store.list({.label = "y"}).size(), 1U);
  EXPECT_EQ(store.list({.label = "x"}).size(), 5U);
  EXPECT_EQ(store.list({.label = "x", .name_part = "even"}).size(), 2U);
}

TEST_F(StoreTest, LabelsAndNamesAreFoundByAnIndex) {
  const Store store(folder.path(), clock());
  SQLite::Database file(folder.path() / "jobs.sqlite");
  const auto plan_of = [&](const JobFilter& filter) {
    SQLite::Statement query(file, "EXPLAIN QUERY PLAN " + list_query(filter));
    std::string plan;
    while (query.executeStep()) plan += query.getColumn(3).getString() + "\n";
    return plan;
  };
  for (const JobFilter& filter :
       {JobFilter{.label = "x"}, JobFilter{.label = "x", .after = "j"},
        JobFilter{.states = {JobState::failed}, .label = "x", .oldest_first = true}}) {
    const std::string plan = plan_of(filter);
    EXPECT_NE(plan.find("SEARCH job_label USING PRIMARY KEY (label="), std::string::npos) << plan;
    EXPECT_EQ(plan.find("SCAN"), std::string::npos) << plan;
    EXPECT_EQ(plan.find("TEMP B-TREE"), std::string::npos) << plan;
  }
  for (const JobFilter& filter :
       {JobFilter{.name_part = "abc"}, JobFilter{.name_part = "abc", .after = "j"},
        JobFilter{.label = "x", .name_part = "abc", .oldest_first = true}}) {
    const std::string plan = plan_of(filter);
    EXPECT_NE(plan.find("SCAN job_name VIRTUAL TABLE INDEX"), std::string::npos) << plan;
    EXPECT_NE(plan.find("SEARCH job USING INDEX job_by_number (number=?)"), std::string::npos)
        << plan;
    EXPECT_EQ(plan.find("SCAN job\n"), std::string::npos) << plan;
    EXPECT_EQ(plan.find("TEMP B-TREE"), std::string::npos) << plan;
  }
}

TEST_F(StoreTest, StatesAndOwnersAreFoundByAnIndex) {
  const Store store(folder.path(), clock());
  SQLite::Database file(folder.path() / "jobs.sqlite");
  for (const JobFilter& filter :
       {JobFilter{.states = {JobState::failed}},
        JobFilter{.states = {JobState::queued, JobState::running}},
        JobFilter{.states = {JobState::queued, JobState::running}, .visible_to = "k"},
        JobFilter{.visible_to = "k"}}) {
    SQLite::Statement query(file, "EXPLAIN QUERY PLAN " + list_query(filter));
    std::string plan;
    while (query.executeStep()) plan += query.getColumn(3).getString() + "\n";
    EXPECT_EQ(plan.find("SCAN"), std::string::npos) << plan;
    EXPECT_EQ(plan.find("USE TEMP B-TREE FOR ORDER BY"), std::string::npos) << plan;
    EXPECT_EQ(plan.find("SEARCH job USING INDEX job_by_kind (kind=?)\n"), std::string::npos)
        << plan;
  }
}

}  // namespace
}  // namespace throng::jobs
