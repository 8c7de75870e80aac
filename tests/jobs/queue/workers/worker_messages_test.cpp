#include "jobs/queue/workers/worker_messages.h"

#include <gtest/gtest.h>

namespace throng::jobs {
namespace {

TEST(WorkerMessages, ReadBack) {
  const WorkerMessage step = read_worker_message(progress_line({3, 30}));
  ASSERT_TRUE(step.progress);
  EXPECT_EQ(step.progress->done, 3);
  EXPECT_EQ(step.progress->total, 30);
  EXPECT_FALSE(step.error);

  const WorkerMessage end =
      read_worker_message(error_line({"input", "two\nlines", {{"s", "/w", "f", "e"}}}));
  ASSERT_TRUE(end.error);
  EXPECT_EQ(end.error->kind, "input");
  EXPECT_EQ(end.error->message, "two\nlines");
  ASSERT_EQ(end.error->problems.size(), 1U);
  EXPECT_EQ(end.error->problems[0].source, "s");
  EXPECT_EQ(end.error->problems[0].where, "/w");
}

TEST(WorkerMessages, OneLineOfValidTextWhateverTheMessageHolds) {
  const std::string line = error_line({"bug", "a\nb \xff\xfe", {}});
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_TRUE(read_worker_message(line).error);
}

TEST(WorkerMessages, AnythingElseIsIgnored) {
  for (const char* line : {"", "{", "[]", "7", "null", "{}", R"({"done":"x","total":1})",
                           R"({"error":5})", "libEGL warning: x"}) {
    const WorkerMessage message = read_worker_message(line);
    EXPECT_FALSE(message.progress) << line;
    EXPECT_FALSE(message.error) << line;
  }
}

}  // namespace
}  // namespace throng::jobs
