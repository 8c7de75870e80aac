#include "sim/vehicle/damage.h"

#include <algorithm>

namespace throng::sim {

std::optional<std::size_t> propeller_hit(const Contact& contact, const Airframe& airframe) {
  // A push within 45 degrees of straight up comes in through the landing gear.
  constexpr double kFromBelow = 0.7071;
  if (contact.push_ns.z() > kFromBelow * contact.push_ns.norm()) return std::nullopt;
  std::size_t nearest = 0;
  double best = -1;
  for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
    // The rotor most nearly in line with the point, seen from the middle.
    const double along = airframe.rotors[i].at_m.normalized().dot(contact.point.head<2>());
    if (i > 0 && along <= best) continue;
    best = along;
    nearest = i;
  }
  return nearest;
}

double wall_speed_mps(double impulse_ns, const Airframe& airframe) {
  return impulse_ns / (airframe.mass_kg * (1 + kRestitution));
}

bool Damage::any_propeller() const {
  return std::any_of(propeller.begin(), propeller.end(), [](bool broken) { return broken; });
}

Damage impact_damage(const Impact& impact, const Airframe& airframe) {
  constexpr double kSharePerPropeller = 0.2;
  Damage damage;
  const double speed_mps = wall_speed_mps(impact.impulse_ns, airframe);
  damage.structure = speed_mps > airframe.structure_limit_mps;
  if (speed_mps <= airframe.propeller_limit_mps) return damage;
  for (std::size_t i = 0; i < damage.propeller.size(); ++i) {
    damage.propeller[i] = impact.rotor_ns[i] >= kSharePerPropeller * impact.impulse_ns;
  }
  return damage;
}

}  // namespace throng::sim
