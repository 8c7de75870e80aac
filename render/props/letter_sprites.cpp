#include "render/props/letter_sprites.h"

#include "base/graphics/drawing/lettering.h"

namespace throng::render {

std::vector<std::vector<LeafTexel>> draw_letter_sheet(int sheet) {
  constexpr int kRowTexels = kLeafTexels / kWordsPerSheet;
  std::vector<LeafTexel> level(static_cast<std::size_t>(kLeafTexels) * kLeafTexels,
                               LeafTexel{0, 128});
  for (int row = 0; row < kWordsPerSheet; ++row) {
    const auto word = static_cast<std::size_t>(sheet * kWordsPerSheet + row);
    if (word >= kShopWords.size()) break;
    const std::vector<std::uint8_t> letters =
        drawing::draw_word(kShopWords.at(word), kLeafTexels, kRowTexels);
    for (int y = 0; y < kRowTexels; ++y) {
      for (int x = 0; x < kLeafTexels; ++x) {
        // Rows of sprites begin at the bottom.
        const auto to = static_cast<std::size_t>((row * kRowTexels + y) * kLeafTexels + x);
        const auto from = static_cast<std::size_t>((kRowTexels - 1 - y) * kLeafTexels + x);
        level[to].cover = letters[from];
      }
    }
  }
  return sprite_levels(std::move(level));
}

}  // namespace throng::render
