#include "world/trajectories.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/files/read_only_file.h"
#include "world/hdf5_file.h"
#include "world/trace_layout.h"

namespace throng::world {

namespace fs = std::filesystem;

namespace {

InputError not_a_trace(const fs::path& file) {
  return InputError(Problem{file.string(), "", "a file that is damaged or no trace", "a trace"});
}

}  // namespace

struct TrajectoryReader::File {
  fs::path path;
  hdf5::Handle root;
  hdf5::Handle crowd;
  double dt_s = 0;
  hsize_t steps = 0;
  std::vector<AgentRole> role;

  void open(const fs::path& trace) {
    path = trace;
    root = hdf5::open_file(trace.string());
    if (hdf5::read_text_attribute(root, "format") != kTraceFormat ||
        hdf5::read_attribute<std::int32_t>(root, "version") != kTraceVersion) {
      throw hdf5::Failure("version");
    }
    dt_s = hdf5::read_attribute<double>(root, "dt_s");
    if (!(dt_s > 0)) throw hdf5::Failure("dt_s");
    crowd = hdf5::Handle(H5Gopen2(root.id(), "crowd", H5P_DEFAULT), H5Gclose, "crowd");
    steps = hdf5::dataset_shape(crowd, "time_s", 1)[0];
    const hdf5::Handle agents(H5Gopen2(root.id(), "agents", H5P_DEFAULT), H5Gclose, "agents");
    const hsize_t count = hdf5::dataset_shape(agents, "role", 1)[0];
    hdf5::require_stored(agents, "role", {count}, 1);
    std::vector<std::uint8_t> roles(count);
    hdf5::read_into(agents, "role", {count}, hdf5::element_type<std::uint8_t>(), roles.data());
    for (const std::uint8_t value : roles) {
      if (value > static_cast<std::uint8_t>(AgentRole::spectator)) throw hdf5::Failure("role");
      role.push_back(static_cast<AgentRole>(value));
    }
    if (steps == 0) throw hdf5::Failure("time_s");
  }
};

TrajectoryReader::TrajectoryReader(const fs::path& trace) : file_(std::make_unique<File>()) {
  if (!fs::is_regular_file(trace)) {
    throw EnvironmentError(fmt::format("cannot read {}", trace.string()));
  }
  static_cast<void>(ReadOnlyFile(trace));
  const hdf5::QuietErrors quiet;
  try {
    file_->open(trace);
  } catch (const hdf5::Failure&) {
    throw not_a_trace(trace);
  }
}

TrajectoryReader::~TrajectoryReader() = default;

std::size_t TrajectoryReader::agents() const { return file_->role.size(); }

double TrajectoryReader::end_s() const {
  return static_cast<double>(file_->steps - 1) * file_->dt_s;
}

Trajectories TrajectoryReader::at(std::span<const double> time_s) const {
  const File& file = *file_;
  const hsize_t people = file.role.size();
  Trajectories result{file.role, {time_s.begin(), time_s.end()}, {}, {}, {}};
  if (people == 0) return result;
  const hdf5::QuietErrors quiet;
  try {
    const hdf5::RowReader positions(file.crowd, "position", hdf5::element_type<float>(),
                                    {file.steps, people, 2});
    const hdf5::RowReader states(file.crowd, "state", hdf5::element_type<std::uint8_t>(),
                                 {file.steps, people});
    const hdf5::RowReader all_flags(file.crowd, "flags", hdf5::element_type<std::uint8_t>(),
                                    {file.steps, people});
    std::vector<Eigen::Vector2f> place(2 * people);
    std::vector<std::uint8_t> state(people);
    std::vector<std::uint8_t> flags(2 * people);
    for (const double time : time_s) {
      const double exact = std::max(0.0, time / file.dt_s);
      const auto step = static_cast<hsize_t>(
          std::min(std::floor(exact + kTimeSlackS), static_cast<double>(file.steps - 1)));
      const hsize_t rows = std::min<hsize_t>(2, file.steps - step);
      const auto share = static_cast<float>(
          std::clamp(rows < 2 ? 0.0 : exact - static_cast<double>(step), 0.0, 1.0));
      positions.read(step, rows, place.data());
      states.read(step, 1, state.data());
      all_flags.read(step, rows, flags.data());
      for (hsize_t i = 0; i < people; ++i) {
        const bool goes_on = rows == 2 && (flags[people + i] & kPresent) != 0;
        result.position.push_back(goes_on ? place[i] + share * (place[people + i] - place[i])
                                          : place[i]);
      }
      result.state.insert(result.state.end(), state.begin(), state.end());
      result.flags.insert(result.flags.end(), flags.begin(),
                          flags.begin() + static_cast<std::ptrdiff_t>(people));
    }
  } catch (const hdf5::Failure&) {
    throw not_a_trace(file.path);
  }
  return result;
}

}  // namespace throng::world
