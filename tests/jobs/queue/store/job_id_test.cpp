#include "jobs/queue/store/job_id.h"

#include <gtest/gtest.h>

namespace throng::jobs {
namespace {

TEST(JobId, LaterJobsSortAfterEarlierOnes) {
  EXPECT_LT(make_job_id(1000, "", 9), make_job_id(1001, "", 3));
  EXPECT_LT(make_job_id(1'700'000'000'000, "", 9), make_job_id(1'900'000'000'000, "", 3));
}

TEST(JobId, NeverGoesBackWithTheClock) {
  std::string previous;
  for (const std::int64_t now_ms : {5000, 5000, 4000, 1, 5001, 9000}) {
    const std::string id = make_job_id(now_ms, previous, 7);
    EXPECT_GT(id, previous);
    EXPECT_TRUE(is_job_id(id));
    previous = id;
  }
}

TEST(JobId, OtherTextsAreNoIds) {
  const std::string id = make_job_id(1, "", 1);
  std::string upper = id;
  upper[0] = 'J';
  std::string zeros = id;
  zeros[5] = '\0';
  const std::string texts[] = {"",    "j",   id.substr(1),      id.substr(0, 15),
                               upper, zeros, "j../../../etc/pa"};
  for (const std::string& text : texts) EXPECT_FALSE(is_job_id(text)) << text;
}

}  // namespace
}  // namespace throng::jobs
