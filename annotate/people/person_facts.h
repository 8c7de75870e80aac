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
  getting_up,
  sitting,
  squatting
};
std::string_view to_string(Activity activity);

/// The activity of a person from the name of their behavior's state, the trace's flags, the actions
/// of the rendered body and the speed, by the first rule that applies: falling, lying or getting up
/// if the body does so; lying with world::kFallen; sitting or, for squat and cower, squatting if
/// the body does so; panicking with world::kPanicked; waiting below 0.2 m/s; following if the
/// state's name says so; running above 2.07 m/s (transition from walking to running, Hreljac 1993);
/// walking.
Activity classify_activity(std::string_view state, std::uint8_t flags, skinning::Actions actions,
                           double speed_mps);

/// The attributes of all people of a run.
class PersonFacts {
 public:
  /// The trace must outlive this object. `population` and `styling` must be those of the rendering.
  PersonFacts(const world::Trace& trace, const skinning::Population& population,
              const skinning::Styling& styling);

  /// Appends `,"state":..,"behaviour":..,"exit":..` of an agent at a time (docs/formats.md); omits
  /// the last two if the agent has none.
  void append(std::string& text, std::uint32_t agent, double time_s, skinning::Actions actions,
              double speed_mps) const;

  /// Appends `,"group":..,"attributes":{..}`, which are constant during the run.
  void append_track(std::string& text, std::uint32_t agent) const;

 private:
  std::size_t step_at(double time_s) const;

  const world::Trace* trace_;
  std::vector<std::string> behavior_;  ///< JSON, by state
  std::vector<std::string> exit_;      ///< JSON, by exit
  std::vector<std::string> fixed_;     ///< members that do not change, by agent
};

}  // namespace throng::annotate
