// Statistics of the crowd for each second as a table (CSV): time, shares of agents in final states
// and in states without transitions, mean and max speed, distance of the nearest pair, number of
// overlapping pairs, mean and (population) standard deviation of positions, agents per state. Units
// are seconds and meters. Absent agents are left out.
// state. Units are seconds and meters. Agents that do not take part are left out.
#pragma once

#include <filesystem>
#include <vector>

#include "base/files/files.h"
#include "crowd/output/pair_distances.h"
#include "crowd/output/recorder.h"

namespace throng::crowd {

/// Writes a row for the frame nearest to each whole second and one for the last frame.
class SeriesWriter : public Recorder {
 public:
  /// Throws EnvironmentError if the file cannot be written.
  SeriesWriter(const std::filesystem::path& path, const Simulation& crowd);

  void record(const Simulation& crowd) override;
  void finish(const Simulation& crowd) override;

 private:
  void write_line(const Simulation& crowd);

  StagedFile file_;
  PairDistancesMeter pairs_;
  double next_s_ = 0;
  bool last_written_ = false;
};

}  // namespace throng::crowd
