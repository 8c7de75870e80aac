#include "base/compute/random.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace throng {

Random::Random(std::uint64_t seed, Stream stream, std::uint64_t index)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32),
               static_cast<std::uint32_t>(stream), 0} {}

std::uint32_t Random::bits() {
  if (used_ == 4) {
    const r123::Philox4x32::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
    const r123::Philox4x32::key_type key{{key_[0], key_[1]}};
    const auto out = r123::Philox4x32{}(counter, key);
    block_ = {out[0], out[1], out[2], out[3]};
    ++counter_[3];
    used_ = 0;
  }
  return block_[used_++];
}

double Random::uniform() {
  const std::uint64_t high = bits() >> 5;
  const std::uint64_t low = bits() >> 6;
  return static_cast<double>((high << 26) | low) * 0x1p-53;
}

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

double Random::normal(double mean, double sd) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return mean + sd * radius * std::cos(2.0 * std::numbers::pi * uniform());
}

std::uint32_t Random::below(std::uint32_t count) {
  // Lemire 2019: multiply-shift; the bias of at most 2^-32 * count is far below any use here.
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(bits()) * count) >> 32);
}

std::uint64_t derive_seed(std::uint64_t seed, Stream stream, std::uint64_t index) {
  Random random(seed, stream, index);
  const std::uint64_t high = random.bits();
  return (high << 32) | random.bits();
}

}  // namespace throng
