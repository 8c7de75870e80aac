#include "crowd/distribution.h"

#include <algorithm>
#include <cmath>

namespace throng::crowd {

namespace {

double cut_off(double value, double mean, double stddev) {
  return std::clamp(value, mean - 3 * stddev, mean + 3 * stddev);
}

}  // namespace

double Distribution::sample(Random random) const {
  switch (kind) {
    case Kind::constant:
      return first;
    case Kind::uniform:
      return random.uniform(first, second);
    case Kind::normal:
      break;
  }
  return cut_off(random.normal(first, second), first, second);
}

double Distribution::sample(MengeRandom& random) const {
  switch (kind) {
    case Kind::constant:
      return first;
    case Kind::uniform:
      return first + (second - first) * random.uniform();
    case Kind::normal:
      break;
  }
  return cut_off(first + second * random.normal(), first, second);
}

int Distribution::sample_integer(Random random) const {
  if (kind != Kind::uniform) return static_cast<int>(std::lround(sample(random)));
  const auto count = static_cast<std::uint32_t>(std::lround(second - first)) + 1;
  return static_cast<int>(std::lround(first)) + static_cast<int>(random.below(count));
}

int Distribution::sample_integer(MengeRandom& random) const {
  if (kind != Kind::uniform) return static_cast<int>(std::lround(sample(random)));
  const double count = second - first + 1;
  return static_cast<int>(std::lround(first)) + static_cast<int>(count * random.uniform());
}

Eigen::Vector2f Distribution2::sample(Random random) const {
  const auto x = static_cast<float>(random.uniform(low.x(), high.x()));
  const auto y = static_cast<float>(random.uniform(low.y(), high.y()));
  return {x, y};
}

Eigen::Vector2f Distribution2::sample(MengeRandom& x, MengeRandom& y) const {
  const double width = high.x() - low.x();
  const double height = high.y() - low.y();
  return {low.x() + static_cast<float>(width * x.uniform()),
          low.y() + static_cast<float>(height * y.uniform())};
}

Random Draws::at(std::size_t agent, std::uint32_t entry) const {
  return Random(seed_, Stream::crowd_behavior, (static_cast<std::uint64_t>(agent) << 32) | entry);
}

}  // namespace throng::crowd
