// Options of a simulation that jobs and commands give, without the engine.
#pragma once

#include <array>
#include <string_view>

namespace throng::crowd {

/// Whose results are wanted where the files leave a choice.
enum class Compat {
  none,      ///< the sensible semantics that the documentation gives
  menge,     ///< Menge's own, with its quirks and random numbers
  huang2016  ///< also those of the elements that the paper's authors added to it
};

/// The words for Compat, in its order.
inline constexpr std::array<std::string_view, 3> kCompatWords = {"none", "menge", "huang2016"};

/// The words for LoadOptions::hard_separation, false first.
inline constexpr std::array<std::string_view, 2> kSeparationWords = {"soft", "hard"};

/// Whether people's bodies give way (crowd/motion/bodies.h).
struct Physical {
  bool on = false;
  float fall_impulse_ns = 20;  ///< a blow that throws somebody over
};

}  // namespace throng::crowd
