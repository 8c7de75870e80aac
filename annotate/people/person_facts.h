// Attributes of a run's people that do not depend on the image: activity, goal, companions
// and appearance.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "skinning/animate/action.h"
#include "skinning/appearance.h"
#include "skinning/population.h"
#include "world/trace.h"

namespace throng::annotate {

/// A person's activity, independent of the names in the behavior file.
enum class Activity : std::uint8_t {
  waiting,
  walking,
  running,
  following,
  panicking,
  lying,
  falling,
  getting_up
};
std::string_view to_string(Activity activity);

/// The activity of somebody in a behavior's state of this name, with the trace's flags, whose body
/// is rendered in such a motion: falling, lying or getting up where that shows it, and lying with
/// world::kFallen where it shows neither; else panicking with world::kPanicked, else by
/// speed: below 0.2 m/s they wait; faster they follow if the state's name says so, and above
/// 2.07 m/s they run (Hreljac, 1993: where people change from walking to running).
Activity classify_activity(std::string_view state, std::uint8_t flags, skinning::Actions actions,
                           double speed_mps);

class PersonFacts {
 public:
  /// The trace must outlive it; the population and the styling are those that the run is rendered
  /// with.
  PersonFacts(const world::Trace& trace, const skinning::Population& population,
              const skinning::Styling& styling);

  /// Appends `,"state":..,"behaviour":..,"exit":..` of an agent at a time (docs/formats.md); the
  /// last two only where there are any.
  void append(std::string& text, std::uint32_t agent, double time_s, skinning::Actions actions,
              double speed_mps) const;

  /// Appends `,"group":..,"attributes":{..}`: what stays the same all run long.
  void append_track(std::string& text, std::uint32_t agent) const;

 private:
  std::size_t step_at(double time_s) const;

  const world::Trace* trace_;
  std::vector<std::string> behavior_;  ///< JSON, by state
  std::vector<std::string> exit_;      ///< JSON, by exit
  std::vector<std::string> fixed_;     ///< members that do not change, by agent
};

}  // namespace throng::annotate
