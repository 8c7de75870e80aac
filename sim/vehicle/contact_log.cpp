#include "sim/vehicle/contact_log.h"

#include <algorithm>

namespace throng::sim {

namespace {

constexpr double kCountedS = 0.05;
constexpr double kSameContactS = 0.5;

}  // namespace

void ContactLog::record(const Touch& touch) {
  const auto is_same = [&](const Contact& contact) {
    return contact.impact.vehicle == touch.vehicle && contact.impact.obstacle == touch.obstacle &&
           contact.impact.index == touch.index;
  };
  auto found = std::find_if(contacts_.begin(), contacts_.end(), is_same);
  if (found == contacts_.end()) {
    contacts_.push_back({{touch.vehicle, touch.obstacle, touch.index, touch.speed_mps}});
    found = contacts_.end() - 1;
  }
  found->apart_s = 0;
  if (found->counted) return;
  found->impact.impulse_ns += touch.impulse_ns;
  found->impact.push_ns += touch.push_ns;
  for (std::size_t rotor = 0; rotor < touch.rotor_ns.size(); ++rotor) {
    found->impact.rotor_ns[rotor] += touch.rotor_ns[rotor];
  }
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
