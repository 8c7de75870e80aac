#include "server/catalog/retention.h"

#include <gtest/gtest.h>

namespace throng::server {
namespace {

using Ids = std::vector<std::string>;

jobs::JobRow ended(const std::string& id, std::int64_t ended_ms, std::int64_t bytes = 0) {
  jobs::JobRow row;
  row.id = id;
  row.kept_from_ms = ended_ms;
  row.bytes = bytes;
  return row;
}

TEST(Retention, ByDefaultEverythingIsKept) {
  EXPECT_EQ(expired({ended("a", 1, 1 << 30)}, 1 << 30, 1'000'000'000, {}), Ids{});
  EXPECT_FALSE(expiry_ms(ended("a", 1), {}));
}

TEST(Retention, AJobExpiresSoLongAfterItsEnd) {
  const Retention retention{.max_wait_ms = 1000};
  EXPECT_EQ(expiry_ms(ended("a", 500), retention), 1500);
  EXPECT_FALSE(expiry_ms(ended("a", 0), retention)) << "it has not ended";
  jobs::JobRow kept = ended("a", 500);
  kept.keep = true;
  EXPECT_FALSE(expiry_ms(kept, retention));
  EXPECT_EQ(expired({ended("a", 500), ended("b", 501)}, 0, 1500, retention), Ids{"a"});
}

TEST(Retention, TheOldestMakeRoomForTheOthers) {
  const Retention retention{.max_bytes = 1000};
  const std::vector<jobs::JobRow> rows = {ended("a", 1, 300), ended("b", 2, 300), ended("c", 3, 1)};
  EXPECT_EQ(expired(rows, 1000, 9, retention), Ids{});
  EXPECT_EQ(expired(rows, 1001, 9, retention), Ids{"a"});
  EXPECT_EQ(expired(rows, 1301, 9, retention), (Ids{"a", "b"}));
}

}  // namespace
}  // namespace throng::server
