#include "server/jobs/drain.h"

#include <gmock/gmock.h>

#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;

TEST_F(ApiTest, ADrainingServiceTakesNoJobsAndBeginsNone) {
  Gate gate(executor);
  const std::string running = submit();
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  const std::string queued = submit();
  const httplib::Result begun = client().Post("/v1/service/drain", "", "");
  EXPECT_EQ(begun->status, 202);
  EXPECT_EQ(client().Post("/v1/service/drain", "", "")->status, 202) << "a second time";
  for (const std::string& path :
       {std::string("/v1/jobs"), "/v1/jobs/" + queued + "/clone", std::string("/v1/studies")}) {
    const httplib::Result refused = client().Post(path, kJob, "application/json");
    expect_problem(refused, 503);
    EXPECT_EQ(refused->get_header_value("Retry-After"), "60");
    EXPECT_THAT(refused->body, HasSubstr("about to end"));
  }
  expect_problem(get("/readyz"), 503);
  EXPECT_EQ(get("/healthz")->status, 200);
  EXPECT_THAT(get("/metrics")->body, HasSubstr("throng_draining 1"));
  EXPECT_EQ(get_json("/v1/jobs/" + queued)["waiting_for"], "the service is about to end");
  gate.open();
  EXPECT_TRUE(reaches(service, running, jobs::JobState::succeeded));
  EXPECT_EQ(get_json("/v1/jobs/" + queued)["state"], "queued");
}

TEST_F(ServiceFixture, TheServiceIsEndedOnceWhenItHasDrained) {
  std::atomic<int> ends = 0;
  ServiceOptions with = options();
  with.drain.on_end = [&] { ++ends; };
  Service service(with, executor);
  service.drain().begin();
  service.drain().begin();
  EXPECT_TRUE(wait_until([&] { return ends > 0; }));
  EXPECT_EQ(ends, 1);
}

}  // namespace
}  // namespace throng::server
