#include "jobs/queue/store/group_commit.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

class GroupCommitTest : public testing::Test {
 protected:
  GroupCommitTest()
      : database(folder.path() / "a.sqlite", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE) {
    database.exec("CREATE TABLE t (n INTEGER UNIQUE)");
  }

  void insert(int n) { database.exec("INSERT INTO t VALUES (" + std::to_string(n) + ")"); }
  int rows() { return database.execAndGet("SELECT count(*) FROM t"); }

  TemporaryFolder folder;
  SQLite::Database database;
};

TEST_F(GroupCommitTest, AChangeThatFailsLeavesTheOthersAlone) {
  GroupCommit commits(database);
  constexpr int kThreads = 8;
  std::atomic<int> failed = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < kThreads; ++i) {
      threads.emplace_back([&, i] {
        for (int n = 0; n < 20; ++n) {
          try {
            commits.run([&] {
              insert(100 * i + n);
              if (n % 4 == 3) throw std::runtime_error("after it has written");
            });
          } catch (const std::runtime_error&) {
            ++failed;
          }
        }
      });
    }
  }
  EXPECT_EQ(failed, kThreads * 5);
  EXPECT_EQ(rows(), kThreads * 15);
}

TEST_F(GroupCommitTest, DatabaseErrorsReachTheirCaller) {
  GroupCommit commits(database);
  commits.run([&] { insert(1); });
  EXPECT_THROW(commits.run([&] { insert(1); }), SQLite::Exception);
  commits.run([&] { insert(2); });
  EXPECT_EQ(rows(), 2);
}

}  // namespace
}  // namespace throng::jobs
