#include "base/text/utf8.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

TEST(Utf8, CountsCodePoints) {
  EXPECT_EQ(character_count(""), 0U);
  EXPECT_EQ(character_count("street"), 6U);
  EXPECT_EQ(character_count("Straße"), 6U);
  EXPECT_EQ(character_count("群集"), 2U);
  EXPECT_EQ(character_count("\xF0\x9F\x9A\x81"), 1U);  // four bytes
}

TEST(Utf8, CutsBetweenCodePoints) {
  EXPECT_EQ(first_characters("Straße", 5), "Straß");
  EXPECT_EQ(first_characters("Straße", 4), "Stra");
  EXPECT_EQ(first_characters("群集", 1), "群");
  EXPECT_EQ(first_characters("群集", 0), "");
  EXPECT_EQ(first_characters("群集", 7), "群集");
}

TEST(Utf8, TellsTextFromOtherBytes) {
  for (const char* text : {"", "street", "群集", "\xF0\x9F\x9A\x81", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
  }
  for (const char* bytes : {"\x80", "\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80",
                            "\xF4\x90\x80\x80", "\xFF", "a\xE7\xBE"}) {
    EXPECT_FALSE(is_utf8(bytes));
  }
}

TEST(Utf8, InvalidBytesAreFound) {
  EXPECT_EQ(find_invalid_utf8("plain and schön"), std::string_view::npos);
  EXPECT_EQ(find_invalid_utf8("ab\xFF"), 2U);
  EXPECT_EQ(find_invalid_utf8("\xC3"), 0U) << "cut off";
  EXPECT_EQ(find_invalid_utf8("x\xED\xA0\x80"), 1U) << "a surrogate";
}

TEST(Utf8, AByteOrderMarkIsLeftOutAtTheBeginning) {
  EXPECT_EQ(without_byte_order_mark("\xEF\xBB\xBF"
                                    "a\xEF\xBB\xBF"),
            "a\xEF\xBB\xBF");
  EXPECT_EQ(without_byte_order_mark("\xEF\xBB"), "\xEF\xBB");
  EXPECT_EQ(without_byte_order_mark(""), "");
}

TEST(Utf8, InvalidBytesAreReplacedOneByOne) {
  EXPECT_EQ(with_valid_utf8("schön"), "schön");
  EXPECT_EQ(with_valid_utf8("sch\xF6n"), "sch\uFFFDn");
  EXPECT_EQ(with_valid_utf8("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(with_valid_utf8(""), "");
}

}  // namespace
}  // namespace throng
