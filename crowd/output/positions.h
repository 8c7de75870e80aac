// Agents' positions at some moments of a run, as a table (CSV): time, agent, class, state,
// position, orientation, preferred and actual velocity. Agents that do not take part are left out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowd/output/recorder.h"
#include "crowd/output/scb.h"

namespace throng::crowd {

class PositionsWriter : public Recorder {
 public:
  /// At the frames nearest to `times_s`, as far as the run goes on until then. Without times at
  /// the beginning, 10 %, 25 %, 50 %, 75 % and the end of the run; all frames are then kept beside
  /// `path` until it is known which these are. Throws EnvironmentError.
  PositionsWriter(const std::filesystem::path& path,
                  const std::optional<std::vector<double>>& times_s, const Simulation& crowd);

  void record(const Simulation& crowd) override;
  void finish(const Simulation& crowd) override;

 private:
  std::filesystem::path path_;
  std::optional<std::vector<std::size_t>> wanted_;  ///< frames, ascending
  ScbWriter frames_;
  std::size_t frame_count_ = 0;
};

}  // namespace throng::crowd
