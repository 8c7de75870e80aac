#include "server/jobs/report_maker.h"

#include <gtest/gtest.h>

#include <atomic>

#include "base/error.h"
#include "base/files/files.h"
#include "tests/server/service_fixture.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Makes reports by a function.
class ReportExecutor : public jobs::FakeExecutor {
 public:
  using Make = std::function<jobs::TaskResult(const fs::path& file, const std::stop_token&)>;
  explicit ReportExecutor(Make make) {
    other = [make = std::move(make)](const jobs::JobFolder& folder, const jobs::Task& task,
                                     const auto&, const std::stop_token& stop) {
      return make(folder.output_of(task), stop);
    };
  }
};

TEST(ReportMaker, PatienceEndsBeforeTheWork) {
  const jobs::TemporaryFolder job;
  std::atomic<bool> may_go_on = false;
  ReportExecutor executor([&](const fs::path& file, const std::stop_token&) {
    while (!may_go_on) std::this_thread::sleep_for(1ms);
    write_file_atomically(file, "page");
    return jobs::TaskResult{};
  });
  ReportMaker reports(executor);
  EXPECT_FALSE(reports.report_of(job.path(), {}, 1ms));
  EXPECT_FALSE(reports.report_of(job.path(), {}, 1ms));
  may_go_on = true;
  const auto file = reports.report_of(job.path(), {}, 60s);
  ASSERT_TRUE(file);
  EXPECT_EQ(read_file(*file), "page");
  ReportMaker::forget(job.path());
  EXPECT_FALSE(fs::exists(*file));
}

TEST(ReportMaker, EndsWhileItIsAtWork) {
  const jobs::TemporaryFolder job;
  std::atomic<bool> has_begun = false;
  ReportExecutor executor([&](const fs::path&, const std::stop_token& stop) {
    has_begun = true;
    while (!stop.stop_requested()) std::this_thread::sleep_for(1ms);
    return jobs::TaskResult{jobs::Outcome::cancelled, 1, "", {}};
  });
  {
    ReportMaker reports(executor);
    EXPECT_FALSE(reports.report_of(job.path(), {}, 1ms));
    EXPECT_TRUE(wait_until([&] { return has_begun.load(); }));
  }
  EXPECT_TRUE(fs::is_empty(job.path()));
}

TEST(ReportMaker, OneThatHangsHoldsBackNoOther) {
  const jobs::TemporaryFolder hanging;
  const jobs::TemporaryFolder quick;
  ReportExecutor executor([&](const fs::path& file, const std::stop_token& stop) {
    while (file.parent_path() == hanging.path() && !stop.stop_requested()) {
      std::this_thread::sleep_for(1ms);
    }
    write_file_atomically(file, "page");
    return jobs::TaskResult{};
  });
  ReportMaker reports(executor);
  EXPECT_FALSE(reports.report_of(hanging.path(), {}, 1ms));
  EXPECT_TRUE(reports.report_of(quick.path(), {}, 60s));
}

TEST(ReportMaker, AFewWaitAndMoreAreRefused) {
  std::atomic<bool> may_go_on = false;
  ReportExecutor executor([&](const fs::path& file, const std::stop_token&) {
    while (!may_go_on) std::this_thread::sleep_for(1ms);
    write_file_atomically(file, "page");
    return jobs::TaskResult{};
  });
  const jobs::TemporaryFolder jobs;
  ReportMaker reports(executor, {.at_once = 1, .max_waiting = 3});
  for (const char* job : {"a", "b", "c"}) {
    EXPECT_FALSE(reports.report_of(jobs.path() / job, {}, 1ms));
  }
  EXPECT_THROW(reports.report_of(jobs.path() / "d", {}, 1ms), EnvironmentError);
  EXPECT_FALSE(reports.report_of(jobs.path() / "a", {}, 1ms)) << "it is in the queue already";
  may_go_on = true;
  for (const char* job : {"a", "b", "c", "d"}) {
    EXPECT_TRUE(wait_until([&] {
      return reports.report_of(jobs.path() / job, {}, 10ms).has_value();
    })) << job;
  }
}

TEST(ReportMaker, FailuresAreTold) {
  const jobs::TemporaryFolder job;
  ReportExecutor executor([&](const fs::path&, const std::stop_token&) {
    return jobs::TaskResult{jobs::Outcome::crashed, 3, "boom", {}};
  });
  ReportMaker reports(executor);
  EXPECT_THROW(reports.report_of(job.path(), {}, 60s), EnvironmentError);
}

}  // namespace
}  // namespace throng::server
