// Trajectories of everybody, seen or not, as the texts of JuPedSim, ETH/UCY and TrajNet++. A file
// for each run.
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

#include "formats/dataset/run_trajectories.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

/// Frames a second; 0 of a run with one frame.
double rate_hz(const RunTrajectories& run) {
  const std::size_t frames = run.times_s.size();
  if (frames < 2) return 0;
  return static_cast<double>(frames - 1) / (run.times_s.back() - run.times_s.front());
}

template <typename Visit>
void for_each_place(const RunTrajectories& run, const Visit& visit) {
  for (std::size_t frame = 0; frame < run.times_s.size(); ++frame) {
    for (std::size_t person = 0; person < run.tracks.size(); ++person) {
      if (run.present(frame, person)) visit(frame, run.tracks[person], run.place(frame, person));
    }
  }
}

/// JuPedSim's and PedPy's text: id, frame, x, y, z, with the frame rate and units in the head.
std::string jupedsim_text(const RunTrajectories& run) {
  std::string text = fmt::format(
      "#description: people of a throng dataset\n#framerate: {:.6g}\n#ID\tFR\tx/m\ty/m\tz/m\n",
      rate_hz(run));
  for_each_place(run, [&](std::size_t frame, std::int64_t track, const Eigen::Vector2d& place) {
    fmt::format_to(std::back_inserter(text), "{}\t{}\t{:.4f}\t{:.4f}\t0\n", track, frame, place.x(),
                   place.y());
  });
  return text;
}

/// Rows of frame, person, x, y, as Social GAN (Gupta et al. 2018) reads ETH and UCY.
std::string eth_ucy_text(const RunTrajectories& run) {
  std::string text;
  for_each_place(run, [&](std::size_t frame, std::int64_t track, const Eigen::Vector2d& place) {
    fmt::format_to(std::back_inserter(text), "{}\t{}\t{:.4f}\t{:.4f}\n", frame, track, place.x(),
                   place.y());
  });
  return text;
}

/// TrajNet++ (Kothari et al. 2021): scenes of 21 frames, 9 observed and 12 to predict, in which
/// one person is present throughout; then the rows.
std::string trajnet_text(const RunTrajectories& run) {
  constexpr std::size_t kSceneFrames = 21;
  std::string text;
  int scene = 0;
  for (std::size_t person = 0; person < run.tracks.size(); ++person) {
    std::size_t first = 0;
    for (std::size_t frame = 0; frame < run.times_s.size(); ++frame) {
      if (!run.present(frame, person)) first = frame + 1;
      if (frame + 1 - first < kSceneFrames) continue;
      fmt::format_to(
          std::back_inserter(text),
          "{{\"scene\": {{\"id\": {}, \"p\": {}, \"s\": {}, \"e\": {}, \"fps\": {:.6g}}}}}\n",
          scene++, run.tracks[person], first, frame, rate_hz(run));
      first = frame + 1;
    }
  }
  for_each_place(run, [&](std::size_t frame, std::int64_t track, const Eigen::Vector2d& place) {
    fmt::format_to(std::back_inserter(text),
                   "{{\"track\": {{\"f\": {}, \"p\": {}, \"x\": {:.4f}, \"y\": {:.4f}}}}}\n", frame,
                   track, place.x(), place.y());
  });
  return text;
}

class TrajectoryExporter : public Exporter {
 public:
  using Text = std::string (*)(const RunTrajectories& run);

  TrajectoryExporter(const DatasetInfo& info, Output output, std::string_view suffix, Text text)
      : info_(info), output_(std::move(output)), suffix_(suffix), text_(text) {}

  void add(const Image& /*image*/) override {}
  void finish() override {
    for (const std::string& run : info_.runs) {
      output_.write(fmt::format("{}/{}.{}", to_string(info_.split_of(run)), run, suffix_),
                    text_(read_run_trajectories(info_.root, run)));
    }
  }

 private:
  const DatasetInfo& info_;
  Output output_;
  std::string_view suffix_;
  Text text_;
};

}  // namespace

ExporterPointer make_jupedsim(const DatasetInfo& info, Output output) {
  return std::make_unique<TrajectoryExporter>(info, std::move(output), "txt", jupedsim_text);
}

ExporterPointer make_eth_ucy(const DatasetInfo& info, Output output) {
  return std::make_unique<TrajectoryExporter>(info, std::move(output), "txt", eth_ucy_text);
}

ExporterPointer make_trajnet(const DatasetInfo& info, Output output) {
  return std::make_unique<TrajectoryExporter>(info, std::move(output), "ndjson", trajnet_text);
}

}  // namespace throng::formats
