#include "crowd/output/positions.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "crowd/output/csv.h"

namespace throng::crowd {

namespace {

constexpr std::array kShares = {0.0, 0.10, 0.25, 0.50, 0.75, 1.0};
constexpr int kTimeDecimals = 4;
constexpr int kPlaceDecimals = 5;

std::optional<std::vector<std::size_t>> frames_at(const std::optional<std::vector<double>>& times_s,
                                                  double dt_s) {
  if (!times_s) return std::nullopt;
  constexpr double kMaxFrame = 1e15;
  std::vector<std::size_t> frames;
  for (const double time_s : *times_s) {
    frames.push_back(
        static_cast<std::size_t>(std::clamp(std::round(time_s / dt_s), 0.0, kMaxFrame)));
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

/// Which frames show the shares of a run; halves go to the even neighbor.
std::vector<std::size_t> frames_of_shares(std::size_t last) {
  std::vector<std::size_t> frames;
  frames.reserve(kShares.size());
  for (const double share : kShares) {
    frames.push_back(static_cast<std::size_t>(std::nearbyint(share * static_cast<double>(last))));
  }
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

/// The lines of one frame, whose floats are those of .scb 2.2.
void write_frame(const std::vector<float>& floats, std::size_t floats_per_agent, double time_s,
                 const Simulation& crowd, StagedFile& file) {
  constexpr std::size_t kState = 3;
  const std::string time = csv_number(time_s, kTimeDecimals);
  std::string lines;
  for (std::size_t agent = 0; agent < crowd.agent_count(); ++agent) {
    const float* values = &floats[agent * floats_per_agent];
    if (std::isnan(values[kState])) continue;  // does not take part
    lines += fmt::format("{},{},{},{}", time, agent, crowd.agent_classes()[agent],
                         csv_text(crowd.state_names()[static_cast<std::size_t>(values[kState])]));
    for (std::size_t i = 0; i < floats_per_agent; ++i) {
      if (i != kState) lines += fmt::format(",{}", csv_number(values[i], kPlaceDecimals));
    }
    lines += "\n";
  }
  file.write(lines);
}

}  // namespace

PositionsWriter::PositionsWriter(const std::filesystem::path& path,
                                 const std::optional<std::vector<double>>& times_s,
                                 const Simulation& crowd)
    : path_(path),
      wanted_(frames_at(times_s, crowd.dt_s())),
      frames_(path.string() + ".frames", "2.2", crowd) {}

void PositionsWriter::record(const Simulation& crowd) {
  const std::size_t frame = frame_count_++;
  const bool keep = !wanted_ || std::binary_search(wanted_->begin(), wanted_->end(), frame);
  if (keep) frames_.record(crowd);
}

void PositionsWriter::finish(const Simulation& crowd) {
  StagedFile file(path_);
  file.write("time,agent,class,state,x,y,orient_rad,vpref_x,vpref_y,vx,vy\n");
  frames_.flush();
  ScbReader kept(frames_.path());
  const std::vector<std::size_t> chosen = wanted_ ? *wanted_ : frames_of_shares(frame_count_ - 1);
  for (std::size_t i = 0; i < chosen.size() && chosen[i] < frame_count_; ++i) {
    write_frame(kept.frame(wanted_ ? i : chosen[i]), kept.floats_per_agent(),
                static_cast<double>(chosen[i]) * crowd.dt_s(), crowd, file);
  }
  file.commit();
}

}  // namespace throng::crowd
