// Capacities of doors that are imposed on the crowd, whatever its pedestrian model does: those of
// building codes, of turnstiles and the like, or given ones.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace throng::world {

/// A building code or a device with a published capacity.
struct CapacityRule {
  std::string_view name;  ///< as scenarios write it
  double per_ms = 0;      ///< people per second and meter of effective width; 0: a device
  double boundary_m = 0;  ///< at each side, not part of the effective width
  double device_per_s = 0;
  std::string_view source;
};

std::span<const CapacityRule> capacity_codes();
std::span<const CapacityRule> capacity_devices();

/// A capacity; one of per_s, per_ms, code and device is set.
struct ImposedCapacity {
  std::optional<double> per_s;   ///< people per second
  std::optional<double> per_ms;  ///< people per second and meter of width
  std::string code;              ///< name of capacity_codes()
  std::string device;            ///< name of capacity_devices()
  int devices = 1;               ///< number of devices side by side

  /// The capacity of a door of this width, people per second.
  double per_s_at(double width_m) const;
  /// "sfpe", "3 x turnstile", "1.2 /s", "1.3 /(m s)".
  std::string text() const;
};

}  // namespace throng::world
