// Warnings about deprecated names.
#include "base/json/deprecation.h"

#include <gtest/gtest.h>

#include <string>

namespace throng {
namespace {

std::string warning_of(std::string_view source, std::string_view where, std::string_view name) {
  testing::internal::CaptureStderr();
  warn_deprecated(source, where, name);
  return testing::internal::GetCapturedStderr();
}

TEST(Deprecation, EachFieldOfADocumentIsReportedOnce) {
  EXPECT_EQ(warning_of("a.json", "/exits/0/old_s", "new_s"),
            "throng: warning: a.json: /exits/0/old_s is deprecated, use \"new_s\"\n");
  EXPECT_EQ(warning_of("a.json", "/exits/1/old_s", "new_s"), "");
  EXPECT_NE(warning_of("b.json", "/exits/1/old_s", "new_s"), "");
  EXPECT_NE(warning_of("a.json", "/exits/1/older_s", "newer_s"), "");
  EXPECT_EQ(warning_of("", "/old_s", "new_s"),
            "throng: warning: /old_s is deprecated, use \"new_s\"\n");
}

}  // namespace
}  // namespace throng
