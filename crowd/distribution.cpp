#include "crowd/distribution.h"

#include <algorithm>
#include <cmath>

namespace throng::crowd {

double Distribution::sample(Random random) const {
  switch (kind) {
    case Kind::constant:
      return first;
    case Kind::uniform:
      return random.uniform(first, second);
    case Kind::normal:
      break;
  }
  return std::clamp(random.normal(first, second), first - 3 * second, first + 3 * second);
}

int Distribution::sample_integer(Random random) const {
  if (kind != Kind::uniform) return static_cast<int>(std::lround(sample(random)));
  const auto count = static_cast<std::uint32_t>(std::lround(second - first)) + 1;
  return static_cast<int>(std::lround(first)) + static_cast<int>(random.below(count));
}

Eigen::Vector2f Distribution2::sample(Random random) const {
  const auto x = static_cast<float>(random.uniform(low.x(), high.x()));
  const auto y = static_cast<float>(random.uniform(low.y(), high.y()));
  return {x, y};
}

Random Draws::at(std::size_t agent, std::uint32_t entry) const {
  return Random(seed_, Stream::crowd_behavior, (static_cast<std::uint64_t>(agent) << 32) | entry);
}

}  // namespace throng::crowd
