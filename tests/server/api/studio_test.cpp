// Studio, the web page of the service: its files, their caching and their security headers.
#include <gmock/gmock.h>
#include <zlib.h>

#include <regex>
#include <set>

#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Inflates a gzip file of less than 4 MB; "" when it is damaged.
std::string inflated(const std::string& bytes) {
  std::string text(4 << 20, '\0');
  z_stream stream{};
  inflateInit2(&stream, 16 + MAX_WBITS);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  const int result = inflate(&stream, Z_FINISH);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return result == Z_STREAM_END ? text : "";
}

class StudioTest : public ApiTest {
 protected:
  /// Addresses that a page or script names.
  static std::set<std::string> assets_in(const std::string& text) {
    static const std::regex kAddress(R"(\.?/(?:\.\./)*(assets/[A-Za-z0-9._-]+))");
    std::set<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), kAddress), end; at != end; ++at) {
      found.insert("/" + at->str(1));
    }
    return found;
  }

  httplib::Result get_raw(const std::string& path, const httplib::Headers& headers) const {
    HttpClient plain = client();
    plain.set_decompress(false);
    return plain.Get(path, headers);
  }
};

TEST_F(StudioTest, PageAllowsOnlyItsOwnScripts) {
  for (const char* path : {"/", "/new", "/jobs", "/jobs/j1m8285x0nqpdhrd/images"}) {
    SCOPED_TRACE(path);
    const auto page = get(path);
    ASSERT_EQ(page->status, 200);
    EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(page->get_header_value("Cache-Control"), "no-cache");
    EXPECT_EQ(page->get_header_value("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(page->get_header_value("Referrer-Policy"), "no-referrer");
    const std::string policy = page->get_header_value("Content-Security-Policy");
    EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
    EXPECT_THAT(policy, HasSubstr("script-src 'self';"));
    EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'"));
    EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
    EXPECT_THAT(policy, Not(HasSubstr("http")));
    EXPECT_THAT(page->body, Not(HasSubstr("style=")));
    EXPECT_FALSE(std::regex_search(page->body, std::regex("<script(?![^>]* src=)|<style|https?:")));
  }
}

TEST_F(StudioTest, AssetsAreImmutableAndCompressed) {
  const auto assets = assets_in(get("/")->body);
  ASSERT_GE(assets.size(), 3U);  // icon, style, script
  for (const std::string& address : assets) {
    SCOPED_TRACE(address);
    const auto plain = get_raw(address, {});
    ASSERT_EQ(plain->status, 200);
    EXPECT_EQ(plain->get_header_value("Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(plain->get_header_value("Vary"), "Accept-Encoding");
    EXPECT_FALSE(plain->has_header("Content-Encoding"));
    const std::string type = plain->get_header_value("Content-Type");
    EXPECT_TRUE(type.starts_with(address.ends_with(".js")    ? "text/javascript"
                                 : address.ends_with(".css") ? "text/css"
                                                             : "image/svg+xml"))
        << type;
    const auto packed = get_raw(address, {{"Accept-Encoding", "br, GZIP;q=0.8"}});
    EXPECT_EQ(packed->get_header_value("Content-Encoding"), "gzip");
    EXPECT_EQ(inflated(packed->body), plain->body);
    const auto refused = get_raw(address, {{"Accept-Encoding", "gzip;q=0, br"}});
    EXPECT_FALSE(refused->has_header("Content-Encoding"));
    EXPECT_EQ(refused->body, plain->body);
  }
}

TEST_F(StudioTest, KnownFilesAreNotSentAgain) {
  const auto page = get("/");
  const std::string etag = page->get_header_value("ETag");
  EXPECT_TRUE(std::regex_match(etag, std::regex(R"("[0-9a-f]{16}")"))) << etag;
  const auto again = get("/", {{"If-None-Match", etag}});
  EXPECT_EQ(again->status, 304);
  EXPECT_EQ(again->body, "");
  EXPECT_EQ(get("/", {{"If-None-Match", "\"0123456789abcdef\""}})->status, 200);
}

TEST_F(StudioTest, FirstLoadIsSmall) {
  constexpr std::size_t kBudget = 100 << 10;
  std::size_t bytes = 0;
  for (const std::string& address : assets_in(get("/")->body)) {
    bytes += get_raw(address, {{"Accept-Encoding", "gzip"}})->body.size();
  }
  EXPECT_GT(bytes, 10'000U);
  EXPECT_LT(bytes, kBudget);
}

TEST_F(StudioTest, ApiKeepsItsProblemDocuments) {
  const httplib::Headers browser = {{"Accept", "text/html,application/xhtml+xml;q=0.9,*/*;q=0.8"}};
  expect_problem(get("/v1/nothing", browser), 404);
  expect_problem(get("/v1/jobs/j0000000000000000", browser), 404);
  expect_problem(get("/assets/main-00000000.js", browser), 404);
  expect_problem(get("/assets/index.0.html", browser), 404);
  expect_problem(get("/nothing"), 404);
  const auto page = get("/nothing", browser);
  EXPECT_EQ(page->status, 404);
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'none'"));
  const auto posted = client().Post("/jobs", "{}", "application/json");
  expect_problem(posted, 405);
  EXPECT_EQ(posted->get_header_value("Allow"), "GET, HEAD");
}

TEST_F(StudioTest, PageNeedsNoKeyAndItsDataDo) {
  const std::string key = keys.create("someone", Scope::read);
  EXPECT_EQ(get("/")->status, 200);
  EXPECT_EQ(get(*assets_in(get("/")->body).begin())->status, 200);
  expect_problem(get("/v1/jobs"), 401);
  EXPECT_EQ(get("/v1/jobs", {{"Authorization", "Bearer " + key}})->status, 200);
}

TEST_F(StudioTest, OtherNamesOfThisMachineAreRefused) {
  expect_problem(get("/", {{"Host", "attacker.example"}}), 421);
}

TEST_F(StudioTest, LicensesComeWithThePage) {
  const auto notice = get("/assets/notice.txt");
  ASSERT_EQ(notice->status, 200);
  for (const char* package : {"preact ", "@codemirror/view ", "@lezer/common "}) {
    EXPECT_THAT(notice->body, HasSubstr(package));
  }
  EXPECT_THAT(notice->body, HasSubstr("MIT"));
}

}  // namespace
}  // namespace throng::server
