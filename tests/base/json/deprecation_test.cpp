// Warnings about deprecated names.
#include "base/json/deprecation.h"

#include <gtest/gtest.h>

#include <string>

namespace throng {
namespace {

std::string deprecation_warning(std::string_view source, std::string_view where,
                                std::string_view name) {
  testing::internal::CaptureStderr();
  warn_deprecated(source, where, name);
  return testing::internal::GetCapturedStderr();
}

TEST(Deprecation, EachFieldOfADocumentIsReportedOnce) {
  EXPECT_EQ(deprecation_warning("a.json", "/exits/0/old_s", "new_s"),
            "throng: warning: a.json: /exits/0/old_s is deprecated, use \"new_s\"\n");
  EXPECT_EQ(deprecation_warning("a.json", "/exits/1/old_s", "new_s"), "");
  EXPECT_NE(deprecation_warning("b.json", "/exits/1/old_s", "new_s"), "");
  EXPECT_NE(deprecation_warning("a.json", "/exits/1/older_s", "newer_s"), "");
  EXPECT_EQ(deprecation_warning("", "/old_s", "new_s"),
            "throng: warning: /old_s is deprecated, use \"new_s\"\n");
}

}  // namespace
}  // namespace throng
