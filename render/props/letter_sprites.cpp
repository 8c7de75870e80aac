#include "render/props/letter_sprites.h"

#include <utility>

#include "base/graphics/drawing/lettering.h"

namespace throng::render {

std::vector<std::vector<LeafTexel>> draw_letter_sheet(int sheet) {
  constexpr std::size_t kTexels = kLeafTexels;
  constexpr std::size_t kRowTexels = kTexels / kWordsPerSheet;
  std::vector<LeafTexel> level(kTexels * kTexels, LeafTexel{0, 128});
  for (std::size_t row = 0; row < kWordsPerSheet; ++row) {
    const std::size_t word = static_cast<std::size_t>(sheet) * kWordsPerSheet + row;
    if (word >= kShopWords.size()) break;
    const std::vector<std::uint8_t> letters =
        drawing::draw_word(kShopWords.at(word), kLeafTexels, kLeafTexels / kWordsPerSheet);
    for (std::size_t y = 0; y < kRowTexels; ++y) {
      for (std::size_t x = 0; x < kTexels; ++x) {
        // Rows of sprites begin at the bottom.
        const std::size_t to = (row * kRowTexels + y) * kTexels + x;
        const std::size_t from = (kRowTexels - 1 - y) * kTexels + x;
        level[to].cover = letters[from];
      }
    }
  }
  return sprite_levels(std::move(level));
}

}  // namespace throng::render
