// Mappings from semantic classes to the classes of Cityscapes (Cordts et al. 2016) and UAVid (Lyu
// et al. 2020).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "world/semantic_class.h"

namespace throng::formats {

/// A label of Cityscapes.
struct CityscapesClass {
  std::uint8_t id;
  std::string_view name;
  std::uint8_t train_id;  ///< 255: not trained
  std::array<std::uint8_t, 3> color;
};

/// A class of UAVid and its color in label images.
struct UavidClass {
  std::string_view name;
  std::array<std::uint8_t, 3> color;
};

const CityscapesClass& cityscapes_class(world::SemanticClass value);
const UavidClass& uavid_class(world::SemanticClass value);

}  // namespace throng::formats
