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

/// Whether bodies may overlap.
enum class BodySeparation {
  automatic,  ///< hard if the model was fitted with it (ModelEntry::separates), else soft
  soft,       ///< as the model's forces leave them
  hard        ///< by at most 1 cm (crowd/motion/separation.h)
};

/// Words for BodySeparation, in the order of its values.
inline constexpr std::array<std::string_view, 3> kSeparationWords = {"auto", "soft", "hard"};

/// The values of a model's constants that the scene does not set.
enum class ConstantsChoice {
  best,          ///< those of the model's table
  posterior,     ///< a draw from the posterior of their fit, by the seed of the run
  conservative,  ///< those with which exits pass no more than standards allow
};

/// Words for ConstantsChoice, in the order of its values.
inline constexpr std::array<std::string_view, 3> kConstantsWords = {"best", "posterior",
                                                                    "conservative"};

/// Radius of the disc that an adult takes up in a crowd, m: that with which ttc fits recorded
/// people best, who turn their shoulders where it is tight.
inline constexpr double kAdultRadiusM = 0.17;

/// Options of bodies that are pushed and fall (crowd/motion/bodies.h).
struct Physical {
  bool on = false;
  float fall_impulse_ns = 20;  ///< min impulse of an impact that makes a person fall (N s)
};

}  // namespace throng::crowd
