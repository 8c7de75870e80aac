// Sign-in of browsers: the cookie, whose pages it serves, and its end.
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <vector>

#include "server/access/sessions.h"
#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Sessions, HoldTheirKeysUntilTheyAreClosed) {
  Sessions sessions;
  const std::string a = sessions.open("key a");
  const std::string b = sessions.open("key b");
  EXPECT_NE(a, b);
  EXPECT_GE(a.size(), 26U);  // 128 bits and more
  EXPECT_EQ(sessions.key_of(a), "key a");
  sessions.close(a);
  EXPECT_EQ(sessions.key_of(a), "");
  EXPECT_EQ(sessions.key_of(b), "key b");
  for (const char* unknown : {"", "x", "key b"}) EXPECT_EQ(sessions.key_of(unknown), "");
}

TEST(Sessions, EndUnusedAndAreLimited) {
  auto now = std::chrono::steady_clock::time_point{};
  Sessions sessions([&now] { return now; });
  const std::string first = sessions.open("first");
  const std::string second = sessions.open("second");
  now += std::chrono::hours(7 * 24);
  EXPECT_EQ(sessions.key_of(first), "first");
  now += std::chrono::seconds(1);
  EXPECT_EQ(sessions.key_of(second), "");
  EXPECT_EQ(sessions.key_of(first), "first") << "each use counts";
  std::vector<std::string> tokens;
  for (int i = 0; i < 1040; ++i) {
    now += std::chrono::seconds(1);
    tokens.push_back(sessions.open("more"));
  }
  EXPECT_EQ(sessions.key_of(first), "first") << "one key signs out no other";
  const auto is_open = [&](const std::string& token) { return sessions.key_of(token) == "more"; };
  EXPECT_EQ(std::count_if(tokens.begin(), tokens.end(), is_open), 20);
  EXPECT_TRUE(is_open(tokens.back()));
  for (int i = 0; i < 10'000; ++i) {
    now += std::chrono::seconds(1);
    static_cast<void>(sessions.open(fmt::format("key {}", i)));
  }
  EXPECT_EQ(sessions.key_of(first), "") << "there are 10 000 at most";
}

class SessionTest : public ApiTest {
 protected:
  std::string origin() const { return fmt::format("http://127.0.0.1:{}", api.port()); }

  httplib::Result sign_in(const std::string& key, httplib::Headers headers = {}) const {
    return client().Post("/v1/session", headers, json{{"key", key}}.dump(), "application/json");
  }

  /// "name=token" of a new session.
  std::string cookie_of(const std::string& key) const {
    const std::string header = sign_in(key)->get_header_value("Set-Cookie");
    return header.substr(0, header.find(';'));
  }

  int status(const std::string& path, httplib::Headers headers) const {
    return get(path, headers)->status;
  }
};

TEST_F(SessionTest, AKeyBecomesACookieThatScriptsCannotRead) {
  const std::string key = keys.create("me", Scope::submit);
  const httplib::Result answer = sign_in(key);
  ASSERT_EQ(answer->status, 200);
  const std::string header = answer->get_header_value("Set-Cookie");
  const std::regex expected(fmt::format(
      "throng_session_{}=[a-z0-9]{{32}}; Path=/; HttpOnly; SameSite=Strict", api.port()));
  EXPECT_TRUE(std::regex_match(header, expected)) << header;
  EXPECT_EQ(answer->get_header_value("Cache-Control"), "no-store");
  EXPECT_EQ(json::parse(answer->body), (json{{"needs_key", true}, {"scope", "submit"}}));
  const std::string cookie = header.substr(0, header.find(';'));
  EXPECT_EQ(status("/v1/jobs", {{"Cookie", cookie}}), 200);
  EXPECT_EQ(status("/v1/jobs", {{"Cookie", "a=b; " + cookie + "; c=d"}}), 200);
  EXPECT_EQ(status("/v1/jobs", {{"Cookie", "x" + cookie}}), 401);
  EXPECT_EQ(status("/v1/jobs", {{"Cookie", cookie + "x"}}), 401);
  EXPECT_EQ(status("/v1/webhooks", {{"Cookie", cookie}}), 403) << "the scope is the key's";
  // The service is behind a proxy with TLS.
  const std::string secure = sign_in(key, {{"Host", "localhost"}, {"Origin", "https://localhost"}})
                                 ->get_header_value("Set-Cookie");
  EXPECT_THAT(secure, StartsWith("__Host-throng_session="));
  EXPECT_THAT(secure, HasSubstr("; Path=/;"));
  EXPECT_THAT(secure, HasSubstr("; Secure"));
  const std::string host_cookie = secure.substr(0, secure.find(';'));
  const httplib::Headers behind_tls = {
      {"Host", "localhost"}, {"X-Forwarded-Proto", "https"}, {"Cookie", host_cookie}};
  EXPECT_EQ(status("/v1/jobs", behind_tls), 200);
  // A cookie without the prefix may have been set by a page of another host of the domain.
  const httplib::Headers planted = {
      {"Host", "localhost"}, {"X-Forwarded-Proto", "https"}, {"Cookie", host_cookie.substr(7)}};
  EXPECT_EQ(status("/v1/jobs", planted), 401);
}

TEST_F(SessionTest, WrongKeysGetNone) {
  static_cast<void>(keys.create("me", Scope::read));
  for (const char* key : {"", "throng_wrong", "x"}) {
    const httplib::Result answer = sign_in(key);
    expect_problem(answer, 401);
    EXPECT_FALSE(answer->has_header("Set-Cookie"));
  }
  for (const char* body : {"{}", "[]", R"({"key": 1})", "x"}) {
    expect_problem(client().Post("/v1/session", body, "application/json"), 400);
  }
  expect_problem(client().Post("/v1/session", R"({"key": "x"})", "text/plain"), 415);
}

TEST_F(SessionTest, ServesPagesOfTheServiceOnly) {
  const std::string cookie = cookie_of(keys.create("me", Scope::admin));
  const auto site = [&](const char* name) {
    return httplib::Headers{{"Cookie", cookie}, {"Sec-Fetch-Site", name}};
  };
  EXPECT_EQ(status("/v1/jobs", site("same-origin")), 200);
  EXPECT_EQ(status("/v1/jobs", site("none")), 200);
  EXPECT_EQ(status("/v1/jobs", site("same-site")), 401) << "another port of this host";
  EXPECT_EQ(status("/v1/jobs", site("cross-site")), 401);
  const auto posted = [&](const httplib::Headers& more) {
    httplib::Headers headers = more;
    headers.emplace("Cookie", cookie);
    return client().Post("/v1/jobs", headers, kJob, "application/json")->status;
  };
  EXPECT_EQ(posted({{"Origin", origin()}}), 201);
  EXPECT_EQ(posted({}), 401);
  EXPECT_EQ(posted({{"Origin", "http://127.0.0.1:1"}}), 403);
  EXPECT_EQ(posted({{"Origin", "null"}}), 403);
  EXPECT_EQ(sign_in("x", {{"Origin", "http://other.test"}})->status, 403);
}

TEST_F(SessionTest, EndsWithSigningOutAndWithItsKey) {
  const std::string key = keys.create("me", Scope::read);
  const std::string cookie = cookie_of(key);
  const std::string other = cookie_of(key);
  EXPECT_EQ(json::parse(get("/v1/session", {{"Cookie", cookie}})->body)["scope"], "read");
  const httplib::Result answer = client().Delete("/v1/session", {{"Cookie", cookie}});
  EXPECT_EQ(answer->status, 204);
  EXPECT_THAT(answer->get_header_value("Set-Cookie"), HasSubstr("; Max-Age=0"));
  EXPECT_THAT(answer->get_header_value("Set-Cookie"), Not(HasSubstr(cookie)));
  EXPECT_EQ(status("/v1/jobs", {{"Cookie", cookie}}), 401);
  EXPECT_EQ(status("/v1/jobs", {{"Cookie", other}}), 200);
  EXPECT_TRUE(keys.revoke(keys.list()[0].id));
  EXPECT_EQ(status("/v1/jobs", {{"Cookie", other}}), 401);
  EXPECT_EQ(json::parse(get("/v1/session", {{"Cookie", other}})->body),
            (json{{"needs_key", true}, {"scope", nullptr}}));
}

TEST_F(SessionTest, AnAuthorizationHeaderGoesFirst) {
  const std::string cookie = cookie_of(keys.create("me", Scope::admin));
  const std::string reader = keys.create("reader", Scope::read);
  EXPECT_EQ(status("/v1/webhooks", {{"Cookie", cookie}}), 200);
  EXPECT_EQ(status("/v1/webhooks", {{"Cookie", cookie}, {"Authorization", "Bearer " + reader}}),
            403);
  EXPECT_EQ(status("/v1/jobs", {{"Cookie", cookie}, {"Authorization", "Bearer x"}}), 401);
}

TEST_F(SessionTest, WithoutKeysNoneIsNeeded) {
  EXPECT_EQ(json::parse(get("/v1/session")->body),
            (json{{"needs_key", false}, {"scope", "admin"}}));
}

}  // namespace
}  // namespace throng::server
