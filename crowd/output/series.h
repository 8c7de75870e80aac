// Statistics of a whole crowd, second by second, as a table (CSV): time, shares of agents in final
// states and in states that no transition leads out of, mean and highest speed, distance of the
// nearest pair, pairs that overlap, mean and (population) standard deviation of places, agents per
// state. Units are seconds and meters. Agents that do not take part are left out.
#pragma once

#include <filesystem>
#include <vector>

#include "base/files/files.h"
#include "crowd/output/pair_distances.h"
#include "crowd/output/recorder.h"

namespace throng::crowd {

/// Writes one line for the frame nearest to every whole second, and one for the last frame.
class SeriesWriter : public Recorder {
 public:
  /// Throws EnvironmentError when the file cannot be written.
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
