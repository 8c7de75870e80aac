#include "crowd/validation/run.h"

#include <algorithm>

namespace throng::validation {

std::size_t count_present(const crowd::Simulation& crowd) {
  const auto present = crowd.present();
  return static_cast<std::size_t>(std::count(present.begin(), present.end(), std::uint8_t{1}));
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
