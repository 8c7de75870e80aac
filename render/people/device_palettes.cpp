#include "render/people/device_palettes.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace throng::render {

std::span<const skinning::PackedBone> device_palettes(const skinning::Population& population,
                                                      std::uint64_t max_bytes) {
  const std::span<const skinning::PackedBone> bones = population.palettes.bones();
  if (bones.size_bytes() > max_bytes) {
    constexpr std::uint64_t kPaletteBytes = skinning::kBoneCount * sizeof(skinning::PackedBone);
    const std::uint64_t max_people =
        max_bytes / (kPaletteBytes * std::max(population.palettes_per_character, 1U));
    throw InputError({"", "people", fmt::format("{} of them", population.characters.size()),
                      fmt::format("at most {}, whose motion fits the {} MiB that this graphics "
                                  "device gives (run `throng people build --count {}`)",
                                  max_people, max_bytes >> 20U, max_people)});
  }
  return bones;
}

}  // namespace throng::render
