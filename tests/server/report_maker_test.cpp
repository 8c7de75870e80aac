#include "server/report_maker.h"

#include <gtest/gtest.h>

#include <atomic>

#include "base/error.h"
#include "base/files.h"
#include "tests/server/service_fixture.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

TEST(ReportMaker, PatienceEndsBeforeTheWork) {
  const jobs::TemporaryFolder job;
  std::atomic<bool> may_go_on = false;
  ReportMaker reports([&](const fs::path&, const fs::path& file, const std::stop_token&) {
    while (!may_go_on) std::this_thread::sleep_for(1ms);
    write_file_atomically(file, "page");
  });
  EXPECT_FALSE(reports.report_of(job.path(), 1ms));
  EXPECT_FALSE(reports.report_of(job.path(), 1ms));
  may_go_on = true;
  const auto file = reports.report_of(job.path(), 10s);
  ASSERT_TRUE(file);
  EXPECT_EQ(read_file(*file), "page");
  ReportMaker::forget(job.path());
  EXPECT_FALSE(fs::exists(*file));
}

TEST(ReportMaker, EndsWhileItIsAtWork) {
  const jobs::TemporaryFolder job;
  std::atomic<bool> has_begun = false;
  {
    ReportMaker reports([&](const fs::path&, const fs::path&, const std::stop_token& stop) {
      has_begun = true;
      while (!stop.stop_requested()) std::this_thread::sleep_for(1ms);
      throw Cancelled();
    });
    EXPECT_FALSE(reports.report_of(job.path(), 1ms));
    EXPECT_TRUE(wait_until([&] { return has_begun.load(); }));
  }
  EXPECT_TRUE(fs::is_empty(job.path()));
}

TEST(ReportMaker, ChildrenThatFailAreNoticed) {
  const jobs::TemporaryFolder job;
  fs::create_directories(job.path() / "logs");
  ReportMaker failing(reporter_in_child({"false"}));
  EXPECT_THROW(failing.report_of(job.path(), 10s), EnvironmentError);
  ReportMaker copying(reporter_in_child({"sh", "-c", "echo page > $2"}));
  // sh takes the job's folder for $0.
  const auto file = copying.report_of(job.path(), 10s);
  ASSERT_TRUE(file);
  EXPECT_EQ(read_file(*file), "page\n");
}

}  // namespace
}  // namespace throng::server
