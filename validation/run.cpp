#include "validation/run.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace throng::validation {

std::size_t count_present(const crowd::Simulation& crowd) {
  const auto present = crowd.present();
  return static_cast<std::size_t>(std::count(present.begin(), present.end(), std::uint8_t{1}));
}

double deepest_overlap_m(const crowd::Simulation& crowd) {
  const auto p = crowd.positions();
  const auto r = crowd.body_radii_m();
  double deepest = -std::numeric_limits<double>::infinity();
  std::vector<std::size_t> present;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (crowd.present()[i] != 0) present.push_back(i);
  }
  // In the order of x, so that only those near each other are compared.
  std::sort(present.begin(), present.end(),
            [&](std::size_t a, std::size_t b) { return p[a].x() < p[b].x(); });
  const float largest = r.empty() ? 0 : *std::max_element(r.begin(), r.end());
  for (std::size_t a = 0; a < present.size(); ++a) {
    const std::size_t i = present[a];
    for (std::size_t b = a + 1; b < present.size(); ++b) {
      const std::size_t j = present[b];
      if (p[j].x() - p[i].x() > r[i] + largest) break;
      deepest = std::max(deepest, static_cast<double>(r[i] + r[j] - (p[i] - p[j]).norm()));
    }
  }
  return deepest;
}

std::optional<double> until_all_left(crowd::Simulation& crowd, double max_s, const Look& look) {
  constexpr double kPatience = 60;  // s
  std::size_t left = count_present(crowd);
  double last_s = 0;
  while (crowd.time_s() < max_s) {
    crowd.step();
    if (look) look(crowd);
    const std::size_t now = count_present(crowd);
    if (now == 0) return crowd.time_s();
    if (now < left) {
      left = now;
      last_s = crowd.time_s();
    }
    if (crowd.time_s() - last_s > kPatience + (last_s == 0 ? kPatience : 0)) break;
  }
  return std::nullopt;
}

}  // namespace throng::validation
