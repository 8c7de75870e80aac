#include "crowd/elements/menge_random.h"

#include <cmath>
#include <numbers>

namespace throng::crowd {

namespace {

constexpr std::uint64_t kMultiplier = 16807;
constexpr std::uint64_t kModulus = 2147483647;
constexpr double kScale = 4.656612875e-10;  // 1 / modulus, as Park and Miller print it

}  // namespace

MengeRandom::MengeRandom(std::uint64_t seed)
    : seed_(seed), state_(static_cast<std::uint32_t>(seed % kModulus)) {
  if (state_ == 0) state_ = 1;  // the one that it would never leave
}

double MengeRandom::uniform() {
  state_ = static_cast<std::uint32_t>(state_ * kMultiplier % kModulus);
  return static_cast<double>(state_) * kScale;
}

double MengeRandom::normal() {
  has_spare_ = !has_spare_;
  if (!has_spare_) return spare_;
  const double radius = std::sqrt(-2 * std::log(uniform()));
  const double angle = 2 * std::numbers::pi * uniform();
  spare_ = radius * std::sin(angle);
  return radius * std::cos(angle);
}

}  // namespace throng::crowd
