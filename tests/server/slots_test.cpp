// One sender does not keep others from being served: connections, streams, checks and uploads.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <memory>
#include <vector>

#include "server/http/key_limit.h"
#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

constexpr int kThreads = 512;

class SlotsTest : public ApiTest {
 protected:
  // Both ends of each connection are in this process.
  SlotsTest() {
    rlimit files{};
    ::getrlimit(RLIMIT_NOFILE, &files);
    files.rlim_cur = files.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &files);
  }

  std::string request(const std::string& path, const std::string& key) const {
    const std::string authorization = key.empty() ? "" : "Authorization: Bearer " + key + "\r\n";
    return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + authorization + "\r\n";
  }

  /// Connections that have sent something and leave the rest to the server.
  std::vector<std::unique_ptr<RawConnection>> connections(int count,
                                                          const std::string& bytes) const {
    std::vector<std::unique_ptr<RawConnection>> opened;
    for (int i = 0; i < count; ++i) {
      opened.push_back(std::make_unique<RawConnection>(api.port()));
      opened.back()->send(bytes);
    }
    return opened;
  }

  int status_of(const std::string& answer) const { return std::stoi(answer.substr(9, 3)); }

  int status(const std::string& path, const std::string& key) const {
    const RawConnection connection(api.port());
    connection.send(request(path, key));
    return status_of(connection.read("\r\n"));
  }

  std::string reader = keys.create("reader", Scope::read);
  std::string other = keys.create("other", Scope::read);
  std::string admin = keys.create("admin", Scope::admin);
};

TEST_F(SlotsTest, LongPollsOfOneKeyLeaveRoomForOthers) {
  const auto polls = connections(270, request("/v1/events?wait_s=60&after=1000000", reader));
  ASSERT_TRUE(wait_until([&] { return service.queue().watchers() == kMaxWatchersOfKey; }));
  int refused = 0;
  for (std::size_t i = kMaxWatchersOfKey; i < polls.size(); ++i) {
    // Some of the first may have come later than others: each refused one has an answer.
    refused += status("/v1/events?wait_s=1&after=1000000", reader) == 429 ? 1 : 0;
  }
  EXPECT_EQ(refused, static_cast<int>(polls.size()) - kMaxWatchersOfKey);
  EXPECT_EQ(status("/v1/jobs", other), 200);
  EXPECT_EQ(status("/v1/events?wait_s=1&after=1000000", other), 200);
  EXPECT_EQ(status("/healthz", ""), 200);
}

TEST_F(SlotsTest, IdleConnectionsEndWhenTheirThreadsAreNeeded) {
  // The limits of this server's connections are ten minutes.
  const auto idle = connections(kThreads, request("/healthz", ""));
  for (const auto& connection : idle) EXPECT_EQ(status_of(connection->read("}")), 200);
  EXPECT_EQ(status("/v1/jobs", other), 200);
}

TEST_F(SlotsTest, HealthAndAdministratorsHaveAReserve) {
  const std::string half = "GET /healthz HTTP/1.1\r\nHost: loc";
  const auto slow = connections(kThreads, half);
  EXPECT_EQ(status("/healthz", ""), 200);
  EXPECT_EQ(status("/readyz", ""), 200);
  EXPECT_EQ(status("/v1/keys", admin), 200);
  // Others wait for a thread, but not too many of them.
  const auto waiting = connections(200, request("/v1/version", ""));
  const RawConnection late(api.port());
  late.send(request("/v1/jobs", other));
  EXPECT_EQ(status_of(late.read("\r\n")), 503);
}

TEST_F(SlotsTest, StreamsEndWithTheirKeyAndWithTheSharingOfTheirJob) {
  const std::string submitter = keys.create("submitter", Scope::submit);
  Gate gate(executor);
  const httplib::Headers mine = {{"Authorization", "Bearer " + submitter}};
  const httplib::Result job =
      client().Post("/v1/jobs?label=shared", mine, kJob, "application/json");
  ASSERT_EQ(job->status, 201);
  const std::string self = "/v1/jobs/" + json::parse(job->body)["id"].get<std::string>();
  const auto stream = [&](const std::string& path, const std::string& key) {
    auto connection = std::make_unique<RawConnection>(api.port());
    connection->send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" +
                     "Accept: text/event-stream\r\nAuthorization: Bearer " + key + "\r\n\r\n");
    connection->read("event: submitted");
    return connection;
  };
  const auto of_job = stream(self + "/events", other);
  const auto of_all = stream("/v1/events", reader);
  EXPECT_EQ(client().Patch(self, mine, R"({"labels": []})", "application/json")->status, 200);
  of_job->read();  // it ends although the job goes on
  EXPECT_EQ(status(self, other), 404);
  keys.revoke(keys.caller_of(reader)->key_id);
  of_all->read();
  gate.open();
}

TEST(KeyLimit, BoundsAllAndEachKey) {
  KeyLimit limit(2, 3);
  auto a = limit.hold("a");
  const auto b = limit.hold("a");
  EXPECT_NE(a, nullptr);
  EXPECT_EQ(limit.hold("a"), nullptr);
  const auto c = limit.hold("b");
  EXPECT_NE(c, nullptr);
  EXPECT_EQ(limit.hold("c"), nullptr) << "all together";
  a.reset();
  EXPECT_NE(limit.hold("a"), nullptr);
  EXPECT_EQ(limit.held(), 2);
}

TEST(KeyRate, AllowsABurstAndThenOneEachInterval) {
  SteadyTime now = {};
  KeyRate rate(3, std::chrono::milliseconds(1000), [&now] { return now; });
  const auto taken = [&](const std::string& key) {
    int count = 0;
    while (count < 10 && rate.take(key)) ++count;
    return count;
  };
  EXPECT_EQ(taken("a"), 3);
  EXPECT_EQ(taken("b"), 3);
  EXPECT_EQ(taken(""), 10) << "no keys are required";
  now += std::chrono::milliseconds(2000);
  EXPECT_EQ(taken("a"), 2);
  now += std::chrono::milliseconds(60'000);
  EXPECT_EQ(taken("a"), 3);
}

}  // namespace
}  // namespace throng::server
