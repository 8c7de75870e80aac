// Options of a simulation that jobs and commands set, without a dependency on the engine.
#pragma once

#include <array>
#include <string_view>

namespace throng::crowd {

/// Program with which results agree.
enum class Compat {
  none,      ///< none: semantics as documented
  menge,     ///< Menge, with its quirks and random numbers
  huang2016  ///< the engine of Huang et al. 2016: Menge with the elements that its authors added
};

/// Words for Compat, in the order of its values.
inline constexpr std::array<std::string_view, 3> kCompatWords = {"none", "menge", "huang2016"};

/// Words for LoadOptions::hard_separation: false, true.
inline constexpr std::array<std::string_view, 2> kSeparationWords = {"soft", "hard"};

/// Options of bodies that are pushed and fall (crowd/motion/bodies.h).
struct Physical {
  bool on = false;
  float fall_impulse_ns = 20;  ///< min impulse of an impact that makes a person fall (N s)
};

}  // namespace throng::crowd
