#include "spec/live/messages.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace throng::live {
namespace {

TEST(Messages, AreReadAsTheyWereWrittenHoweverTheyArrive) {
  std::string text = framed({MessageType::hello, "{}"});
  text += framed({MessageType::alive, ""});
  text += framed({MessageType::image, std::string(300, '\0') + "end"});
  EXPECT_EQ(text.substr(0, 5), std::string("H\2\0\0\0", 5));
  for (const std::size_t part : {std::size_t{1}, std::size_t{7}, text.size()}) {
    MessageReader reader;
    std::string types;
    std::size_t bytes = 0;
    for (std::size_t at = 0; at < text.size(); at += part) {
      reader.add(std::string_view(text).substr(at, part));
      while (const auto message = reader.next()) {
        types += static_cast<char>(message->type);
        bytes += message->bytes.size();
      }
    }
    EXPECT_EQ(types, "HAP") << part;
    EXPECT_EQ(bytes, 305U) << part;
  }
}

TEST(Messages, OtherBytesAreRefused) {
  for (const std::string& text : {std::string("hello"), std::string("H\xff\xff\xff\xff", 5)}) {
    MessageReader reader;
    reader.add(text);
    EXPECT_THROW(reader.next(), EnvironmentError);
  }
}

TEST(Messages, NumbersAreLittleEndian) {
  std::string bytes;
  append_value(bytes, std::uint16_t{0x0102});
  append_value(bytes, std::uint8_t{3});
  EXPECT_EQ(bytes, "\2\1\3");
}

}  // namespace
}  // namespace throng::live
