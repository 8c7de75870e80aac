#include "sim/contact_log.h"

#include <algorithm>
#include <array>

namespace throng::sim {

namespace {

constexpr double kCountedS = 0.05;
constexpr double kSameContactS = 0.5;

}  // namespace

const char* word_of(Obstacle obstacle) {
  constexpr std::array kWords{"ground", "building", "drone", "person"};
  return kWords.at(static_cast<std::size_t>(obstacle));
}

void ContactLog::note(std::size_t craft, Obstacle obstacle, int index, double speed_mps,
                      const Eigen::Vector3d& push_ns, double impulse_ns) {
  const auto is_same = [&](const Contact& contact) {
    return contact.impact.craft == craft && contact.impact.obstacle == obstacle &&
           contact.impact.index == index;
  };
  auto found = std::find_if(contacts_.begin(), contacts_.end(), is_same);
  if (found == contacts_.end()) {
    contacts_.push_back({{craft, obstacle, index, speed_mps}});
    found = contacts_.end() - 1;
  }
  found->apart_s = 0;
  if (found->counted) return;
  found->impact.impulse_ns += impulse_ns;
  found->impact.push_ns += push_ns;
}

void ContactLog::advance(double dt_s) {
  impacts_.clear();
  for (Contact& contact : contacts_) {
    contact.impact.ago_s += dt_s;
    contact.apart_s += dt_s;
    if (!contact.counted && contact.impact.ago_s > kCountedS) {
      contact.counted = true;
      impacts_.push_back(contact.impact);
    }
  }
  std::erase_if(contacts_, [](const Contact& contact) { return contact.apart_s > kSameContactS; });
}

std::vector<Impact> ContactLog::unfinished() const {
  std::vector<Impact> list;
  for (const Contact& contact : contacts_) {
    if (!contact.counted) list.push_back(contact.impact);
  }
  return list;
}

}  // namespace throng::sim
