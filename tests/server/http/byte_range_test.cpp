#include "server/http/byte_range.h"

#include <gtest/gtest.h>

namespace throng::server {
namespace {

using enum RangeAnswer::Kind;

RangeAnswer answer(const std::string& range, const std::string& if_range = "") {
  return range_answer(range, if_range, "\"tag\"", 1000);
}

RangeAnswer range_answer(std::int64_t first, std::int64_t last) { return {part, {first, last}}; }

TEST(ByteRange, PartsAreCutToTheFile) {
  EXPECT_EQ(answer("bytes=0-0"), range_answer(0, 0));
  EXPECT_EQ(answer("bytes=10-19"), range_answer(10, 19));
  EXPECT_EQ(answer("bytes=10-"), range_answer(10, 999));
  EXPECT_EQ(answer("bytes=990-5000"), range_answer(990, 999));
  EXPECT_EQ(answer("bytes=-10"), range_answer(990, 999));
  EXPECT_EQ(answer("bytes=-99999999999999999999"), range_answer(0, 999));
}

TEST(ByteRange, NothingPastTheEnd) {
  for (const char* range :
       {"bytes=1000-", "bytes=1000-2000", "bytes=99999999999999999999-", "bytes=-0"}) {
    EXPECT_EQ(answer(range).kind, unsatisfiable) << range;
  }
}

TEST(ByteRange, AnythingButASingleRangeOfBytesMeansTheWhole) {
  for (const char* range :
       {"", "bytes", "bytes=", "bytes=-", "bytes=5", "bytes=a-b", "bytes=1-a", "bytes=20-10",
        "lines=1-2", "bytes=0-1,5-6", "bytes=--1", "bytes= 1-2"}) {
    EXPECT_EQ(answer(range).kind, whole) << range;
  }
}

TEST(ByteRange, APartOfAnotherVersionIsNotGiven) {
  EXPECT_EQ(answer("bytes=10-19", "\"tag\""), range_answer(10, 19));
  EXPECT_EQ(answer("bytes=10-19", "\"other\"").kind, whole);
}

}  // namespace
}  // namespace throng::server
