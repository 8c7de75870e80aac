// The people of a table with their places by frame or time.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "metrics/trajectories/recorded.h"
#include "metrics/trajectories/timed_tracks.h"

namespace throng::metrics {

/// People by the words that name them, in order of their first places.
class TablePeople {
 public:
  /// Adds a place. Returns false if the person has one at this frame or time already.
  bool add(std::string_view person, double when, const Eigen::Vector2d& place);

  bool empty() const { return tracks_.empty(); }

  /// Multiplies all y.
  void scale_y(double factor);

  /// Puts the places into a recording, whose keys are frames.
  void put_frames(Recorded& recorded) const;

  /// Moves the tracks with their ids into people whose keys are times.
  TimedPeople take_timed(bool spans_gaps);

  /// Adds the words of people whose ids are not their words.
  void put_names(Recorded& recorded) const;

 private:
  /// The id of a person in the trace: the number in the file, or the index in its order from 1.
  std::int64_t id(std::size_t person) const {
    return are_numbers_ ? ids_[person] : static_cast<std::int64_t>(person) + 1;
  }

  std::unordered_map<std::string, std::size_t> indices_;  ///< by word
  std::vector<std::int64_t> ids_;
  bool are_numbers_ = true;  ///< all words
  std::vector<Track> tracks_;
};

}  // namespace throng::metrics
