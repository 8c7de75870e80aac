#include "server/webhooks/webhooks.h"

#include <gmock/gmock.h>

#include <mutex>

#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

/// An address that takes what it is sent, or not.
class Receiver {
 public:
  Receiver() {
    server_.Post("/hook", [this](const httplib::Request& request, httplib::Response& response) {
      const std::lock_guard lock(mutex_);
      requests_.push_back(request);
      response.status = answers_.empty() ? 200 : answers_.front();
      if (!answers_.empty()) answers_.erase(answers_.begin());
    });
    port_ = server_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::sleep_for(1ms);
  }
  ~Receiver() {
    server_.stop();
    thread_.join();
  }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/hook"; }
  void answer_with(std::vector<int> answers) {
    const std::lock_guard lock(mutex_);
    answers_ = std::move(answers);
  }
  std::vector<httplib::Request> requests() const {
    const std::lock_guard lock(mutex_);
    return requests_;
  }

 private:
  httplib::Server server_;
  mutable std::mutex mutex_;
  std::vector<httplib::Request> requests_;
  std::vector<int> answers_;
  int port_ = 0;
  std::thread thread_;
};

std::vector<std::string> event_types(const std::vector<httplib::Request>& requests) {
  std::vector<std::string> types;
  for (const httplib::Request& request : requests) {
    types.push_back(request.get_header_value("Throng-Event"));
  }
  return types;
}

class WebhooksTest : public ApiTest {
 protected:
  json create(const json& body) const {
    const auto answer = client().Post("/v1/webhooks", body.dump(), "application/json");
    EXPECT_EQ(answer->status, 201) << answer->body;
    return json::parse(answer->body);
  }

  Receiver receiver;
};

TEST_F(WebhooksTest, TellHowJobsEndSignedAndInOrder) {
  const json hook = create({{"url", receiver.url()}, {"secret", "s3cret"}});
  const std::string id = submit_and_wait();
  submit_and_wait();
  ASSERT_TRUE(wait_until([&] { return receiver.requests().size() == 2; }));
  const httplib::Request first = receiver.requests()[0];
  const json body = json::parse(first.body);
  EXPECT_EQ(body["type"], "succeeded");
  EXPECT_EQ(body["job"], id);
  EXPECT_EQ(body["links"]["job"], "/v1/jobs/" + id);
  const std::string signature = first.get_header_value("Throng-Signature");
  const std::int64_t unix_s = std::stoll(signature.substr(2));
  EXPECT_EQ(signature, sign_body("s3cret", unix_s, first.body));
  EXPECT_NE(signature, sign_body("other", unix_s, first.body));
  EXPECT_LT(body["seq"], json::parse(receiver.requests()[1].body)["seq"]);
  const std::string self = hook["links"]["self"];
  ASSERT_TRUE(wait_until([&] { return get_json(self + "/deliveries")["deliveries"].size() == 2; }));
  const json delivery = get_json(self + "/deliveries")["deliveries"][1];
  EXPECT_EQ(delivery["event"], body["seq"]);
  EXPECT_EQ(delivery["status"], 200);
  EXPECT_TRUE(delivery["succeeded"]);
  EXPECT_FALSE(get_json(self).contains("secret")) << "told once";
}

TEST_F(WebhooksTest, TheSignatureIsThatOfRfc2104) {
  // Computed with: printf 1700000000.{} | openssl dgst -sha256 -hmac key
  EXPECT_EQ(sign_body("key", 1700000000, "{}"),
            "t=1700000000,v1="
            "9d713ed406bb7076d4123f0dc2c39d2df5c654ed4b0cd56b52c8b4c940bd63ae");
}

TEST_F(WebhooksTest, ChosenEventsOnly) {
  create({{"url", receiver.url()}, {"events", {"submitted", "removed"}}});
  const std::string id = submit_and_wait();
  client().Delete("/v1/jobs/" + id);
  ASSERT_TRUE(wait_until([&] { return receiver.requests().size() == 2; }));
  EXPECT_THAT(event_types(receiver.requests()), ElementsAre("submitted", "removed"));
}

TEST_F(WebhooksTest, RefusedDeliveriesAreSentAgain) {
  WebhookSender quick(service.queue(), data.path(),
                      {.first_rest = 5ms,
                       .max_pause = 20ms,
                       .timeout = 60s,
                       .post = {.timeout = 60s, .allow_private = true}});
  const Webhook hook =
      quick.webhooks().create(receiver.url(), {"*"}, "", service.queue().last_event());
  receiver.answer_with({500, 302, 404});
  quick.refresh();
  submit();
  ASSERT_TRUE(wait_until([&] { return receiver.requests().size() >= 5; }));
  const auto requests = receiver.requests();
  for (int i = 1; i < 4; ++i) {
    EXPECT_EQ(requests[static_cast<std::size_t>(i)].get_header_value("Throng-Delivery"),
              requests[0].get_header_value("Throng-Delivery"));
  }
  EXPECT_NE(requests[4].get_header_value("Throng-Delivery"),
            requests[0].get_header_value("Throng-Delivery"));
  const auto deliveries = quick.webhooks().deliveries(hook.id, 100);
  const Delivery& first = deliveries.back();
  EXPECT_EQ(first.status, 500);
  EXPECT_EQ(first.attempt, 1);
  EXPECT_EQ(deliveries[deliveries.size() - 4].attempt, 4);
  EXPECT_EQ(quick.webhooks().get(hook.id)->failures, 0);
}

TEST_F(WebhooksTest, AnyStatusOf200To299TakesAnEvent) {
  const std::string self = create({{"url", receiver.url()}, {"events", {"*"}}})["links"]["self"];
  // 204 and 205 have no body; neither has this 202.
  receiver.answer_with({204, 202, 205, 201, 299, 204});
  submit_and_wait();
  const std::string id = submit_and_wait();
  client().Delete("/v1/jobs/" + id);
  ASSERT_TRUE(wait_until([&] {
    return !receiver.requests().empty() && event_types(receiver.requests()).back() == "removed";
  }));
  const json deliveries = get_json(self + "/deliveries")["deliveries"];
  for (const json& delivery : deliveries) {
    EXPECT_EQ(delivery["attempt"], 1);
    EXPECT_TRUE(delivery["succeeded"]) << delivery.dump();
    EXPECT_TRUE(delivery["error"].is_null());
  }
}

TEST_F(WebhooksTest, AnAddressThatFailsForTooLongIsLeftAloneUntilItIsEnabled) {
  WebhookSender quick(
      service.queue(), data.path(),
      {.first_rest = 1ms, .max_pause = 2ms, .timeout = 30ms, .post = {.allow_private = true}});
  // Nobody listens there.
  const Webhook hook =
      quick.webhooks().create("http://127.0.0.1:1/hook", {"*"}, "", service.queue().last_event());
  quick.refresh();
  submit_and_wait();
  ASSERT_TRUE(wait_until([&] { return !quick.webhooks().get(hook.id)->enabled; }));
  EXPECT_NE(quick.webhooks().deliveries(hook.id, 1)[0].error, "");
  EXPECT_EQ(quick.webhooks().deliveries(hook.id, 1)[0].status, 0);
  EXPECT_TRUE(quick.webhooks().enable(hook.id, true, service.queue().last_event()));
  EXPECT_EQ(quick.webhooks().get(hook.id)->failures, 0);
}

TEST_F(WebhooksTest, EventsOfADowntimeAreSentAfterwards) {
  const std::string id = create({{"url", receiver.url()}, {"events", {"submitted"}}})["id"];
  const std::int64_t after = hooks.webhooks().get(id)->after;
  submit();
  ASSERT_TRUE(wait_until([&] { return receiver.requests().size() == 1; }));
  ASSERT_TRUE(wait_until([&] { return hooks.webhooks().get(id)->after > after; }));
  // Another sender, as after a restart, goes on where the first stood.
  WebhookSender second(service.queue(), data.path(),
                       {.post = {.timeout = 60s, .allow_private = true}});
  submit();
  ASSERT_TRUE(wait_until([&] { return receiver.requests().size() >= 2; }));
}

TEST_F(WebhooksTest, PingSaysHowItWent) {
  const std::string self = create({{"url", receiver.url()}})["links"]["self"];
  receiver.answer_with({418});
  const auto answer = client().Post(self + "/ping", "", "application/json");
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(json::parse(answer->body)["status"], 418);
  EXPECT_FALSE(json::parse(answer->body)["succeeded"]);
  EXPECT_EQ(receiver.requests()[0].get_header_value("Throng-Event"), "ping");
}

TEST_F(WebhooksTest, AreManagedOverHttp) {
  const std::string self = create({{"url", receiver.url()}})["links"]["self"];
  EXPECT_EQ(get_json("/v1/webhooks")["webhooks"].size(), 1U);
  const auto disabled = client().Patch(self, R"({"enabled": false})", "application/json");
  EXPECT_FALSE(json::parse(disabled->body)["enabled"]);
  submit_and_wait();
  // Events come in their order: none of this job comes before the next one's.
  EXPECT_EQ(client().Patch(self, R"({"enabled": true})", "application/json")->status, 200);
  const std::string next = submit_and_wait();
  ASSERT_TRUE(wait_until([&] { return !receiver.requests().empty(); }));
  EXPECT_EQ(json::parse(receiver.requests()[0].body)["job"], next);
  EXPECT_EQ(client().Delete(self)->status, 204);
  expect_problem(get(self), 404);
  for (const char* body :
       {"[]", R"({"url": "ftp://x"})", R"({"url": "http://"})", R"({"url": "http://a b/"})",
        R"({"url": "http://u:p@host/"})", R"({"url": "http://x", "events": []})",
        R"({"url": "http://x", "events": [1]})", R"({"url": "http://x", "else": 1})", R"({})"}) {
    expect_problem(client().Post("/v1/webhooks", body, "application/json"), 400);
  }
}

TEST_F(WebhooksTest, PrivateAddressesAreRefusedUnlessAllowed) {
  WebhookSender careful(service.queue(), data.path(), {.first_rest = 5ms, .max_pause = 20ms});
  Api other(service, keys, careful, {});
  const std::jthread serving([&] { other.run(); });
  HttpClient asking(other.port());
  for (const char* url :
       {"http://127.0.0.1/hook", "http://127.1/hook", "http://2130706433/", "http://0x7f.1/",
        "http://017700000001/", "http://[::1]:80/", "http://[::ffff:10.0.0.1]/",
        "https://169.254.169.254/latest/meta-data", "http://0.0.0.0:8080/", "http://10.1.2.3/",
        "http://[fe80::1]/", "http://[64:ff9b::7f00:1]/", "http://[2002:a00:1::]/"}) {
    const httplib::Result answer =
        asking.Post("/v1/webhooks", json{{"url", url}}.dump(), "application/json");
    expect_problem(answer, 400);
    EXPECT_EQ(json::parse(answer->body)["errors"][0]["pointer"], "/url") << url;
  }
  // A name is looked up when it is called.
  std::string url = receiver.url();
  url.replace(url.find("127.0.0.1"), 9, "localhost");
  const httplib::Result named =
      asking.Post("/v1/webhooks", json{{"url", url}}.dump(), "application/json");
  ASSERT_EQ(named->status, 201);
  const std::string self = named->get_header_value("Location");
  const json pinged = json::parse(asking.Post(self + "/ping", "", "application/json")->body);
  EXPECT_FALSE(pinged["succeeded"]);
  EXPECT_THAT(pinged["error"].get<std::string>(), ::testing::HasSubstr("private"));
  EXPECT_TRUE(receiver.requests().empty());
  other.stop();
}

TEST_F(WebhooksTest, AreForAdministrators) {
  const std::string submitter = keys.create("me", Scope::submit);
  const httplib::Headers headers = {{"Authorization", "Bearer " + submitter}};
  expect_problem(client().Get("/v1/webhooks", headers), 403);
  expect_problem(
      client().Post("/v1/webhooks", headers, R"({"url": "http://x"})", "application/json"), 403);
}

}  // namespace
}  // namespace throng::server
