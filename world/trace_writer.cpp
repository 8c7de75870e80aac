#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/files/staging.h"
#include "base/resource_exhaustion.h"
#include "world/hdf5_file.h"
#include "world/trace.h"
#include "world/trace_layout.h"

namespace throng::world {

namespace fs = std::filesystem;

namespace {

constexpr hsize_t kMaxRowsPerChunk = 64;
constexpr hsize_t kChunkBytes = 1 << 20;
constexpr hsize_t kDroneRowsPerChunk = 1024;
constexpr hsize_t kEventRowsPerChunk = 1024;

hsize_t rows_per_chunk(std::size_t agents) {
  const hsize_t bytes_per_row = std::max<hsize_t>(agents, 1) * 2 * sizeof(float);
  return std::clamp<hsize_t>(kChunkBytes / bytes_per_row, 1, kMaxRowsPerChunk);
}

// A dataset with rows that wait to be written together: whole chunks, so that none is compressed
// twice.
template <typename T>
class Column {
 public:
  Column(const hdf5::Handle& group, const char* name, const std::vector<hsize_t>& row, hsize_t rows,
         const char* unit)
      : data_(group, name, hdf5::element_type<T>().file, hdf5::element_type<T>().memory, row, rows,
              unit),
        rows_(rows) {}

  /// Adds one row.
  void add(const T* values, std::size_t count) {
    waiting_.insert(waiting_.end(), values, values + count);
    if (++waiting_rows_ == rows_) flush();
  }
  void add(T value) { add(&value, 1); }

  void flush() {
    data_.append(waiting_.data(), waiting_rows_);
    waiting_.clear();
    waiting_rows_ = 0;
  }

 private:
  hdf5::RowDataset data_;
  hsize_t rows_;
  hsize_t waiting_rows_ = 0;
  std::vector<T> waiting_;
};

struct CrowdColumns {
  CrowdColumns(const hdf5::Handle& group, hsize_t agents, hsize_t rows)
      : time_s(group, "time_s", {}, rows, "s"),
        position(group, "position", {agents, 2}, rows, "m"),
        velocity(group, "velocity", {agents, 2}, rows, "m/s"),
        yaw_rad(group, "yaw_rad", {agents}, rows, "rad"),
        desired_speed_mps(group, "desired_speed_mps", {agents}, rows, "m/s"),
        state(group, "state", {agents}, rows, ""),
        exit_intent(group, "exit_intent", {agents}, rows, ""),
        flags(group, "flags", {agents}, rows, "") {}

  void add(const CrowdStep& step) {
    const std::size_t agents = step.position.size();
    time_s.add(step.time_s);
    position.add(agents > 0 ? step.position.front().data() : nullptr, 2 * agents);
    velocity.add(agents > 0 ? step.velocity.front().data() : nullptr, 2 * agents);
    yaw_rad.add(step.yaw_rad.data(), agents);
    desired_speed_mps.add(step.desired_speed_mps.data(), agents);
    state.add(step.state.data(), agents);
    exit_intent.add(step.exit_intent.data(), agents);
    flags.add(step.flags.data(), agents);
  }

  void flush() {
    time_s.flush();
    position.flush();
    velocity.flush();
    yaw_rad.flush();
    desired_speed_mps.flush();
    state.flush();
    exit_intent.flush();
    flags.flush();
  }

  Column<double> time_s;
  Column<float> position;
  Column<float> velocity;
  Column<float> yaw_rad;
  Column<float> desired_speed_mps;
  Column<std::uint8_t> state;
  Column<std::int8_t> exit_intent;
  Column<std::uint8_t> flags;
};

// Digits that nobody needs cost most of the time and the space that compression takes.
double rounded(double value, double steps) { return std::round(value * steps) / steps; }
template <typename Vector>
Vector rounded(const Vector& values, double steps) {
  return values.unaryExpr([steps](double value) { return rounded(value, steps); });
}
constexpr double kCoarse = 1 << 14;  // rates, forces, winds
constexpr double kFine = 1 << 20;    // meters, joules
constexpr double kFinest = 1 << 30;  // quaternions

struct DroneColumns {
  explicit DroneColumns(const hdf5::Handle& group)
      : time_s(group, "time_s", {}, kDroneRowsPerChunk, "s"),
        position(group, "position", {3}, kDroneRowsPerChunk, "m"),
        velocity(group, "velocity", {3}, kDroneRowsPerChunk, "m/s"),
        orientation(group, "orientation_wxyz", {4}, kDroneRowsPerChunk, ""),
        body_rates(group, "body_rates", {3}, kDroneRowsPerChunk, "rad/s"),
        specific_force(group, "specific_force", {3}, kDroneRowsPerChunk, "m/s^2"),
        air_velocity(group, "air_velocity", {3}, kDroneRowsPerChunk, "m/s"),
        energy_j(group, "energy_j", {}, kDroneRowsPerChunk, "J") {}

  void add(const DroneSample& given) {
    const DroneSample sample = as_recorded(given);
    const auto add_floats = [](Column<float>& column, const Eigen::Vector3d& v) {
      column.add(Eigen::Vector3f(v.cast<float>()).data(), 3);
    };
    const Eigen::Quaterniond& q = sample.orientation;
    time_s.add(sample.time_s);
    position.add(sample.position.data(), 3);
    velocity.add(sample.velocity.data(), 3);
    orientation.add(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).data(), 4);
    add_floats(body_rates, sample.body_rates);
    add_floats(specific_force, sample.specific_force);
    add_floats(air_velocity, sample.air_velocity);
    energy_j.add(sample.energy_j);
  }

  void flush() {
    time_s.flush();
    position.flush();
    velocity.flush();
    orientation.flush();
    body_rates.flush();
    specific_force.flush();
    air_velocity.flush();
    energy_j.flush();
  }

  Column<double> time_s;
  Column<double> position;
  Column<double> velocity;
  Column<double> orientation;
  Column<float> body_rates;
  Column<float> specific_force;
  Column<float> air_velocity;
  Column<double> energy_j;
};

// A dataset of words, written together like a Column's rows.
class WordColumn {
 public:
  WordColumn(const hdf5::Handle& group, const char* name)
      : word_(hdf5::text_type(kEventWordWidth)),
        data_(group, name, word_.id(), word_.id(), {}, kEventRowsPerChunk, "") {}

  void add(const std::string& word) {
    words_ += word;
    words_.append(kEventWordWidth - word.size(), '\0');
  }

  void flush() {
    data_.append(words_.data(), words_.size() / kEventWordWidth);
    words_.clear();
  }

 private:
  hdf5::Handle word_;
  hdf5::RowDataset data_;
  std::string words_;
};

class EventColumns {
 public:
  explicit EventColumns(const hdf5::Handle& group)
      : time_s_(group, "time_s", {}, kEventRowsPerChunk, "s"),
        type_(group, "type"),
        agent_(group, "agent", {}, kEventRowsPerChunk, ""),
        drone_(group, "drone", {}, kEventRowsPerChunk, ""),
        value_(group, "value", {}, kEventRowsPerChunk, ""),
        partner_(group, "partner"),
        other_(group, "other", {}, kEventRowsPerChunk, ""),
        extra_(group, "extra", {}, kEventRowsPerChunk, "") {}

  void add(const EventRow& event) {
    time_s_.add(event.time_s);
    type_.add(event.type);
    agent_.add(event.agent);
    drone_.add(event.drone);
    value_.add(event.value);
    partner_.add(event.partner);
    other_.add(event.other);
    extra_.add(event.extra);
  }

  void flush() {
    time_s_.flush();
    type_.flush();
    agent_.flush();
    drone_.flush();
    value_.flush();
    partner_.flush();
    other_.flush();
    extra_.flush();
  }

 private:
  Column<double> time_s_;
  WordColumn type_;
  Column<std::int32_t> agent_;
  Column<std::int32_t> drone_;
  Column<double> value_;
  WordColumn partner_;
  Column<std::int32_t> other_;
  Column<double> extra_;
};

void write_origin(const hdf5::Handle& file, const CrowdOrigin& crowd) {
  if (crowd.model.empty()) return;
  hdf5::write_text_attribute(file, "crowd_model", crowd.model);
  hdf5::write_text_attribute(file, "crowd_compat", crowd.compat);
  hdf5::write_attribute(file, "crowd_hard_separation", std::uint8_t{crowd.hard_separation});
  hdf5::write_text_attribute(file, "crowd_constants", crowd.constants);
  hdf5::write_attribute(file, "crowd_compliance", crowd.compliance);
  hdf5::write_attribute(file, "crowd_physical", std::uint8_t{crowd.physical});
  hdf5::write_attribute(file, "crowd_fall_impulse_ns", crowd.fall_impulse_ns);
}

void write_header(const hdf5::Handle& file, const TraceHeader& header) {
  hdf5::write_text_attribute(file, "format", kTraceFormat);
  hdf5::write_attribute(file, "version", kTraceVersion);
  hdf5::write_text_attribute(file, "scenario_id", header.scenario_id);
  hdf5::write_text_attribute(file, "generator", header.generator);
  hdf5::write_attribute(file, "seed", header.seed);
  hdf5::write_attribute(file, "dt_s", header.dt_s);
  write_origin(file, header.crowd);
  hdf5::write_texts(file, "state_names", header.state_names);
  if (!header.state_lying.empty()) {
    Column<std::uint8_t> lying(file, "state_lying", {}, 1024, "");
    for (const std::uint8_t lies : header.state_lying) lying.add(lies);
    lying.flush();
  }
  hdf5::write_texts(file, "exit_ids", header.exit_ids);
  hdf5::write_texts(file, "drone_ids", header.drone_ids);
  if (!header.scenario_document.empty()) {
    constexpr hsize_t kDocumentChunk = 65'536;
    Column<std::uint8_t> document(file, "scenario", {}, kDocumentChunk, "");
    for (const char byte : header.scenario_document) document.add(static_cast<std::uint8_t>(byte));
    document.flush();
  }
  if (header.alarm) {
    hdf5::write_texts(file, "alarm_aware_states", header.alarm->aware_states);
    if (header.alarm->at_s) hdf5::write_attribute(file, "alarm_s", *header.alarm->at_s);
  }
  const hdf5::Handle agents = hdf5::create_group(file, "agents");
  Column<std::uint8_t> role(agents, "role", {}, 1024, "");
  Column<float> radius_m(agents, "radius_m", {}, 1024, "m");
  Column<float> pref_speed_mps(agents, "pref_speed_mps", {}, 1024, "m/s");
  Column<std::int32_t> group(agents, "group", {}, 1024, "");
  for (std::size_t i = 0; i < header.agent_count(); ++i) {
    role.add(static_cast<std::uint8_t>(header.role[i]));
    radius_m.add(header.radius_m[i]);
    pref_speed_mps.add(header.pref_speed_mps[i]);
    group.add(header.group[i]);
  }
  role.flush();
  radius_m.flush();
  pref_speed_mps.flush();
  group.flush();
}

void sync_to_disk(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  if (descriptor >= 0) ::close(descriptor);
  if (!synced) throw EnvironmentError(fmt::format("cannot sync {}", path.string()));
}

// A file that is gone again unless it gets its final name.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path final_path)
      : final_(std::move(final_path)), path_(staging_path(final_).string()) {}
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  const fs::path& final_path() const { return final_; }

  void publish() {
    sync_to_disk(path_);
    if (const std::error_code error = publish_staged(path_, final_)) {
      throw EnvironmentError(
          fmt::format("cannot rename {} to {}: {}", path_, final_.string(), error.message()));
    }
  }

 private:
  fs::path final_;
  std::string path_;
};

// Runs HDF5 calls; what fails there while writing is the machine's fault.
template <typename Work>
auto writing(const fs::path& path, const Work& work) {
  const hdf5::QuietErrors quiet;
  try {
    return work();
  } catch (const hdf5::Failure&) {  // names a table, which is nothing to the user
    throw_write_error(path, 0);
  }
}

}  // namespace

DroneSample as_recorded(const DroneSample& sample) {
  const auto coarse = [](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(rounded(v, kCoarse).cast<float>().cast<double>());
  };
  return {sample.time_s,
          rounded(sample.position, kFine),
          rounded(sample.velocity, kFine),
          Eigen::Quaterniond(rounded(sample.orientation.coeffs(), kFinest)),
          coarse(sample.body_rates),
          coarse(sample.specific_force),
          coarse(sample.air_velocity),
          rounded(sample.energy_j, kFine)};
}

// The members go in reverse order: the columns close before the file that holds them, and the
// temporary file is removed last.
struct TraceWriter::File {
  File(fs::path path, const TraceHeader& header)
      : temporary(std::move(path)),
        agents(header.agent_count()),
        dt_s(header.dt_s),
        last_drone_time_s(header.drone_ids.size(), -1),
        root(hdf5::create_file(temporary.path())) {
    write_header(root, header);
    crowd.emplace(hdf5::create_group(root, "crowd"), agents, rows_per_chunk(agents));
    const hdf5::Handle drone_group = hdf5::create_group(root, "drones");
    for (std::size_t i = 0; i < header.drone_ids.size(); ++i) {
      drones.emplace_back(hdf5::create_group(drone_group, std::to_string(i)));
    }
    events.emplace(hdf5::create_group(root, "events"));
  }

  void close() {
    crowd->flush();
    for (DroneColumns& drone : drones) drone.flush();
    std::stable_sort(waiting_events.begin(), waiting_events.end(),
                     [](const TraceEvent& a, const TraceEvent& b) { return a.time_s < b.time_s; });
    for (const TraceEvent& event : waiting_events) events->add(to_row(event));
    events->flush();
    crowd.reset();
    drones.clear();
    events.reset();
    root.close(temporary.path());
  }

  TemporaryFile temporary;
  std::size_t agents;
  double dt_s;
  std::size_t steps = 0;
  std::vector<double> last_drone_time_s;
  hdf5::Handle root;
  std::optional<CrowdColumns> crowd;  // empty once closed, like events
  std::vector<DroneColumns> drones;
  std::optional<EventColumns> events;
  std::vector<TraceEvent> waiting_events;  // few: a handful per person and drone
};

TraceWriter::TraceWriter(fs::path path, const TraceHeader& header) {
  check(header.dt_s > 0, "a trace has a positive step");
  check(header.radius_m.size() == header.agent_count() &&
            header.pref_speed_mps.size() == header.agent_count() &&
            header.group.size() == header.agent_count(),
        "every agent has a role, a radius, a preferred speed and a group or none");
  const fs::path name = path;
  file_ = writing(name, [&] { return std::make_unique<File>(std::move(path), header); });
}

TraceWriter::~TraceWriter() {
  const hdf5::QuietErrors quiet;
  file_.reset();
}

void TraceWriter::add(const CrowdStep& step) {
  const std::size_t agents = file_->agents;
  check(step.position.size() == agents && step.velocity.size() == agents &&
            step.yaw_rad.size() == agents && step.desired_speed_mps.size() == agents &&
            step.state.size() == agents && step.exit_intent.size() == agents &&
            step.flags.size() == agents,
        "a crowd step has one entry per agent");
  const double expected_s = static_cast<double>(file_->steps) * file_->dt_s;
  check(std::abs(step.time_s - expected_s) < 1e-6 * std::max(1.0, expected_s),
        "crowd steps come in order, dt apart");
  ++file_->steps;
  writing(file_->temporary.final_path(), [&] { file_->crowd->add(step); });
}

void TraceWriter::add_drone(std::size_t drone, const DroneSample& sample) {
  check(drone < file_->drones.size(), "the drone is in the trace's header");
  check(sample.time_s > file_->last_drone_time_s[drone], "a drone's samples come in order");
  file_->last_drone_time_s[drone] = sample.time_s;
  writing(file_->temporary.final_path(), [&] { file_->drones[drone].add(sample); });
}

void TraceWriter::add_event(const TraceEvent& event) { file_->waiting_events.push_back(event); }

void TraceWriter::finish() {
  writing(file_->temporary.final_path(), [&] { file_->close(); });
  file_->temporary.publish();
}

}  // namespace throng::world
