#include "server/serve.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "server/http/http_server.h"
#include "tests/jobs/yard.h"

namespace throng::server {
namespace {

TEST(Serve, RefusesAddressesThatOthersCanReachWhileThereAreNoKeys) {
  const jobs::TemporaryFolder data;
  for (const char* host : {"0.0.0.0", "::", "192.168.1.10", "example.com", "127.example.com", ""}) {
    EXPECT_FALSE(is_loopback(host)) << host;
    ServeOptions options;
    options.host = host;
    options.data = data.path();
    EXPECT_THROW(serve(options), InputError) << host;
  }
  for (const char* host : {"127.0.0.1", "127.0.0.53", "localhost", "::1"}) {
    EXPECT_TRUE(is_loopback(host)) << host;
  }
}

}  // namespace
}  // namespace throng::server
