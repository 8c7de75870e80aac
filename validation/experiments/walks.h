// Paths of people, recorded or simulated, and what is measured from them by the same code.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "validation/experiments/experiment.h"
#include "world/trace.h"

namespace throng::validation {

/// Positions of one person in consecutive steps.
struct Walk {
  std::size_t first_step = 0;
  std::size_t stream = 0;               ///< index of the goal
  std::vector<Eigen::Vector2d> places;  ///< m
};

/// Positions of all people.
struct Walks {
  double dt_s = 0.1;
  std::vector<Walk> people;
};

/// Converts a recording; everybody belongs to the stream whose goal their path approaches most. A
/// gap of at most 1 s in a person's presence is bridged in a straight line; a person who appears
/// again later is another one.
Walks recorded_walks(const world::Trace& trace, const std::vector<Eigen::AlignedBox2d>& goals);

/// Cuts off what was recorded of people before they come to the walkable ground; people who never
/// come there are left out.
void begin_on_ground(Walks& walks, const Recording& recording);

/// The time (s) of the last step in which somebody is there.
double duration_s(const Walks& walks);

/// A measured quantity.
struct Quantity {
  std::string name;  ///< "flow"
  std::string unit;  ///< "1/(m s)"
  double value = 0;
  double at_density = 0;  ///< 1/m^2, of a point of a diagram; else 0
};

/// Results for one run of an experiment.
struct Measures {
  std::size_t people = 0;  ///< in recordings
  std::vector<Quantity> quantities;
  std::vector<double> passages_s;  ///< sorted times at which people first pass the line
};

/// Measures the flow of each stream over the line between its 20th and 80th percentile of people (0
/// if fewer pass, NaN for fewer than two people), density and speed in the area, the time until 90
/// % of the people have passed, time gaps, and for two streams with goals on both sides of the line
/// the band index (Yamori 1998, Psychol. Rev. 105, 530). Times that are not reached are infinite.
Measures measure(const Walks& walks, const Recording& recording, const TimeRange& steady);

/// Means over time and people in an area. The speed is that from where people enter the area to
/// where they leave it: swaying does not count, which is as fast as people walk in a dense crowd.
struct AreaMeans {
  double density = 0;    ///< 1/m^2
  double speed_mps = 0;  ///< NaN if nobody is there for two steps
};
AreaMeans means_in_area(const Walks& walks, const Eigen::AlignedBox2d& area,
                        const TimeRange& range);

/// The period of the steady state: `recording.steady`, or that between the 20th and the 80th
/// percentile of the passages, or all the time for fewer than two.
TimeRange steady_range(const Walks& recorded, const Recording& recording);

/// Returns the greatest difference of two N-t curves, as a share of the number of people.
double curve_difference(const std::vector<double>& recorded_s, const std::vector<double>& model_s);

}  // namespace throng::validation
