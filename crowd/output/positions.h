// Positions of agents at selected times of a run as a table (CSV): time, agent, class, state,
// position, orientation, preferred and actual velocity. Agents that are not present are left out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowd/output/recorder.h"
#include "crowd/output/scb.h"

namespace throng::crowd {

/// Writes the positions of agents at selected times.
class PositionsWriter : public Recorder {
 public:
  /// Records the frames nearest to `times_s` that the run reaches. Without times: the start, 10 %,
  /// 25 %, 50 %, 75 % and the end of the run; as the end is unknown, all frames are kept in a
  /// temporary file beside `path` until finish(). Throws EnvironmentError.
  PositionsWriter(const std::filesystem::path& path,
                  const std::optional<std::vector<double>>& times_s, const Simulation& crowd);

  void record(const Simulation& crowd) override;
  void finish(const Simulation& crowd) override;

 private:
  std::filesystem::path path_;
  std::optional<std::vector<std::size_t>> wanted_;  ///< indices of frames, ascending
  ScbWriter frames_;
  std::size_t frame_count_ = 0;
};

}  // namespace throng::crowd
