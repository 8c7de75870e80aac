// Names of colors against those of CSS, whose names people gave.
#include "annotate/people/color_name.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <string_view>

namespace throng::annotate {
namespace {

/// A color of CSS, and what it may be called with the twelve names.
struct NamedColor {
  const char* css;
  std::array<std::uint8_t, 3> rgb;
  std::set<std::string_view> names;
};

TEST(ColorName, IsTheNameInCss) {
  const NamedColor colors[] = {
      {"black", {0, 0, 0}, {"black"}},
      {"white", {255, 255, 255}, {"white"}},
      {"gray", {128, 128, 128}, {"gray"}},
      {"red", {255, 0, 0}, {"red"}},
      {"orange", {255, 165, 0}, {"orange"}},
      {"yellow", {255, 255, 0}, {"yellow"}},
      {"green", {0, 128, 0}, {"green"}},
      {"blue", {0, 0, 255}, {"blue"}},
      {"purple", {128, 0, 128}, {"purple"}},
      {"pink", {255, 192, 203}, {"pink"}},
      {"brown", {165, 42, 42}, {"brown", "red"}},
      {"beige", {245, 245, 220}, {"beige"}},
      {"navy", {0, 0, 128}, {"blue"}},
      {"midnightblue", {25, 25, 112}, {"blue"}},
      {"royalblue", {65, 105, 225}, {"blue"}},
      {"skyblue", {135, 206, 235}, {"blue"}},
      {"crimson", {220, 20, 60}, {"red"}},
      {"firebrick", {178, 34, 34}, {"red"}},
      {"maroon", {128, 0, 0}, {"red", "brown"}},
      {"salmon", {250, 128, 114}, {"pink", "orange"}},
      {"hotpink", {255, 105, 180}, {"pink"}},
      {"deeppink", {255, 20, 147}, {"pink"}},
      {"gold", {255, 215, 0}, {"yellow"}},
      {"khaki", {240, 230, 140}, {"yellow", "beige"}},
      {"tan", {210, 180, 140}, {"beige", "brown"}},
      {"wheat", {245, 222, 179}, {"beige"}},
      {"chocolate", {210, 105, 30}, {"brown", "orange"}},
      {"saddlebrown", {139, 69, 19}, {"brown"}},
      {"sienna", {160, 82, 45}, {"brown"}},
      {"olive", {128, 128, 0}, {"green", "brown"}},
      {"darkolivegreen", {85, 107, 47}, {"green"}},
      {"forestgreen", {34, 139, 34}, {"green"}},
      {"lime", {0, 255, 0}, {"green"}},
      {"teal", {0, 128, 128}, {"green", "blue"}},
      {"indigo", {75, 0, 130}, {"purple", "blue"}},
      {"violet", {238, 130, 238}, {"pink", "purple"}},
      {"orchid", {218, 112, 214}, {"pink", "purple"}},
      {"silver", {192, 192, 192}, {"gray"}},
      {"whitesmoke", {245, 245, 245}, {"white"}},
      {"darkorange", {255, 140, 0}, {"orange"}},
      {"dimgray", {105, 105, 105}, {"gray"}},
  };
  for (const NamedColor& color : colors) {
    const std::string_view name = color_name(color.rgb.data());
    EXPECT_TRUE(color.names.contains(name)) << color.css << " is called " << name;
  }
}

TEST(ColorName, IsOneOfTwelveForEveryColor) {
  std::set<std::string_view> names;
  for (int r = 0; r < 256; r += 5) {
    for (int g = 0; g < 256; g += 5) {
      for (int b = 0; b < 256; b += 5) {
        const std::array<std::uint8_t, 3> rgb = {static_cast<std::uint8_t>(r),
                                                 static_cast<std::uint8_t>(g),
                                                 static_cast<std::uint8_t>(b)};
        names.insert(color_name(rgb.data()));
      }
    }
  }
  EXPECT_EQ(names,
            (std::set<std::string_view>{"beige", "black", "blue", "brown", "gray", "green",
                                        "orange", "pink", "purple", "red", "white", "yellow"}));
}

}  // namespace
}  // namespace throng::annotate
