#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/files/read_only_file.h"
#include "base/text/utf8.h"
#include "world/hdf5_file.h"
#include "world/trace.h"
#include "world/trace_layout.h"

namespace throng::world {

namespace fs = std::filesystem;

namespace {

// Far above any real run, far below what would exhaust the memory by a damaged number alone.
constexpr hsize_t kMaxElements = 4'000'000'000;
constexpr double kMaxImpulseNs = 1e6;

[[noreturn]] void reject(const std::string& source, const std::string& where,
                         const std::string& found, const std::string& expected) {
  throw InputError(Problem{source, where, found, expected});
}

class Reader {
 public:
  explicit Reader(const fs::path& path) : source_(path.string()) {
    if (!fs::is_regular_file(path)) {
      throw EnvironmentError(fmt::format("cannot read {}", source_));
    }
    // The library does not say why it cannot open a file.
    static_cast<void>(ReadOnlyFile(path));
    try {
      root_ = hdf5::open_file(source_);
    } catch (const hdf5::Failure&) {
      reject(source_, "", "a file that is damaged, cut short or not HDF5", "a trace");
    }
  }

  Trace read() {
    check_version();
    Trace trace;
    trace.header = read_header();
    read_crowd(trace);
    const hdf5::Handle drones = open_group("drones");
    for (std::size_t i = 0; i < trace.header.drone_ids.size(); ++i) {
      trace.drones.push_back(read_drone(drones, i));
    }
    trace.events = read_events(trace.header);
    return trace;
  }

 private:
  void check_version() {
    std::string format;
    try {
      format = hdf5::read_text_attribute(root_, "format");
    } catch (const hdf5::Failure&) {
      format.clear();
    }
    if (format != kTraceFormat) {
      reject(source_, "format", "an HDF5 file of another kind", "a trace");
    }
    const auto version = hdf5::read_attribute<std::int32_t>(root_, "version");
    if (version != kTraceVersion) {
      reject(source_, "version", std::to_string(version), std::to_string(kTraceVersion));
    }
  }

  CrowdOrigin read_origin() {
    const auto flag = [&](const char* name) {
      const auto value = hdf5::read_attribute<std::uint8_t>(root_, name);
      if (value > 1) reject(source_, name, std::to_string(value), "0 or 1");
      return value == 1;
    };
    CrowdOrigin crowd;
    crowd.model = text("crowd_model");
    crowd.compat = text("crowd_compat");
    crowd.hard_separation = flag("crowd_hard_separation");
    if (H5Aexists(root_.id(), "crowd_constants") > 0) crowd.constants = text("crowd_constants");
    crowd.compliance = number("crowd_compliance", 1);
    crowd.physical = flag("crowd_physical");
    crowd.fall_impulse_ns = number("crowd_fall_impulse_ns", kMaxImpulseNs);
    return crowd;
  }

  TraceHeader read_header() {
    TraceHeader header;
    header.scenario_id = text("scenario_id");
    header.generator = text("generator");
    header.seed = hdf5::read_attribute<std::uint64_t>(root_, "seed");
    header.dt_s = hdf5::read_attribute<double>(root_, "dt_s");
    if (!(header.dt_s > 0)) {
      reject(source_, "dt_s", fmt::format("{}", header.dt_s), "a positive number");
    }
    if (H5Aexists(root_.id(), "crowd_model") > 0) header.crowd = read_origin();
    header.state_names = texts("state_names");
    if (H5Lexists(root_.id(), "state_lying", H5P_DEFAULT) > 0) {
      header.state_lying = numbers<std::uint8_t>(root_, "state_lying", {header.state_names.size()});
    }
    header.exit_ids = texts("exit_ids");
    header.drone_ids = texts("drone_ids");
    if (H5Lexists(root_.id(), "scenario", H5P_DEFAULT) > 0) {
      const hsize_t bytes = hdf5::dataset_shape(root_, "scenario", 1)[0];
      const auto document = numbers<std::uint8_t>(root_, "scenario", {bytes});
      header.scenario_document.assign(document.begin(), document.end());
    }
    if (H5Lexists(root_.id(), "alarm_aware_states", H5P_DEFAULT) > 0) {
      header.alarm.emplace().aware_states = texts("alarm_aware_states");
      if (H5Aexists(root_.id(), "alarm_s") > 0) {
        header.alarm->at_s = hdf5::read_attribute<double>(root_, "alarm_s");
      }
    }
    const hdf5::Handle agents = open_group("agents");
    const hsize_t count = hdf5::dataset_shape(agents, "role", 1)[0];
    for (const std::uint8_t role : numbers<std::uint8_t>(agents, "role", {count})) {
      if (role > static_cast<std::uint8_t>(AgentRole::spectator)) {
        reject(source_, "agents/role", std::to_string(role), "0 to 4");
      }
      header.role.push_back(static_cast<AgentRole>(role));
    }
    header.radius_m = numbers<float>(agents, "radius_m", {count});
    header.pref_speed_mps = numbers<float>(agents, "pref_speed_mps", {count});
    header.group = numbers<std::int32_t>(agents, "group", {count});
    return header;
  }

  void read_crowd(Trace& trace) {
    const hdf5::Handle crowd = open_group("crowd");
    const hsize_t steps = hdf5::dataset_shape(crowd, "time_s", 1)[0];
    const hsize_t agents = trace.agents();
    trace.time_s = numbers<double>(crowd, "time_s", {steps});
    for (std::size_t i = 0; i < steps; ++i) {
      const double expected = static_cast<double>(i) * trace.header.dt_s;
      if (!(std::abs(trace.time_s[i] - expected) < 1e-6 * std::max(1.0, expected))) {
        reject(source_, "crowd/time_s", fmt::format("{} at step {}", trace.time_s[i], i),
               fmt::format("{}", expected));
      }
    }
    trace.position = vectors(crowd, "position", steps, agents);
    trace.velocity = vectors(crowd, "velocity", steps, agents);
    trace.yaw_rad = numbers<float>(crowd, "yaw_rad", {steps, agents});
    trace.desired_speed_mps = numbers<float>(crowd, "desired_speed_mps", {steps, agents});
    trace.state = numbers<std::uint8_t>(crowd, "state", {steps, agents});
    trace.exit_intent = numbers<std::int8_t>(crowd, "exit_intent", {steps, agents});
    trace.flags = numbers<std::uint8_t>(crowd, "flags", {steps, agents});
    for (const std::uint8_t state : trace.state) {
      require_index(state, 0, trace.header.state_names.size(), "crowd/state");
    }
    for (const std::int8_t exit : trace.exit_intent) {
      require_index(exit, -1, trace.header.exit_ids.size(), "crowd/exit_intent");
    }
    mark_lying(trace);
  }

  /// Files written before kFallen covered the states in which people lie.
  static void mark_lying(Trace& trace) {
    const std::vector<bool> is_lying = trace.header.lying_states();
    if (std::find(is_lying.begin(), is_lying.end(), true) == is_lying.end()) return;
    for (std::size_t i = 0; i < trace.state.size(); ++i) {
      if (is_lying[trace.state[i]]) trace.flags[i] |= kFallen;
    }
  }

  std::vector<DroneSample> read_drone(const hdf5::Handle& drones, std::size_t index) {
    const std::string name = std::to_string(index);
    const hdf5::Handle group(H5Gopen2(drones.id(), name.c_str(), H5P_DEFAULT), H5Gclose,
                             "drones/" + name);
    const hsize_t count = hdf5::dataset_shape(group, "time_s", 1)[0];
    const auto time_s = numbers<double>(group, "time_s", {count});
    const auto position = numbers<double>(group, "position", {count, 3});
    const auto velocity = numbers<double>(group, "velocity", {count, 3});
    const auto wxyz = numbers<double>(group, "orientation_wxyz", {count, 4});
    const auto body_rates = numbers<float>(group, "body_rates", {count, 3});
    const auto specific_force = numbers<float>(group, "specific_force", {count, 3});
    const auto air_velocity = numbers<float>(group, "air_velocity", {count, 3});
    const auto energy_j = numbers<double>(group, "energy_j", {count});
    std::vector<DroneSample> samples(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0 && time_s[i] <= time_s[i - 1]) {
        reject(source_, fmt::format("drones/{}/time_s", name), fmt::format("{}", time_s[i]),
               fmt::format("more than {}", time_s[i - 1]));
      }
      const double* q = &wxyz[4 * i];
      const auto vector = [i](const std::vector<float>& xyz) {
        return Eigen::Vector3d(Eigen::Vector3f(&xyz[3 * i]).cast<double>());
      };
      samples[i] = {time_s[i],
                    Eigen::Vector3d(&position[3 * i]),
                    Eigen::Vector3d(&velocity[3 * i]),
                    Eigen::Quaterniond(q[0], q[1], q[2], q[3]),
                    vector(body_rates),
                    vector(specific_force),
                    vector(air_velocity),
                    energy_j[i]};
      constexpr double kUnitTolerance = 1e-6;
      if (std::abs(samples[i].orientation.norm() - 1) > kUnitTolerance) {
        reject(source_, fmt::format("drones/{}/orientation_wxyz", name),
               fmt::format("norm {}", samples[i].orientation.norm()), "a unit quaternion");
      }
    }
    return samples;
  }

  std::vector<TraceEvent> read_events(const TraceHeader& header) {
    const hdf5::Handle group = open_group("events");
    const hsize_t count = hdf5::dataset_shape(group, "time_s", 1)[0];
    const auto time_s = numbers<double>(group, "time_s", {count});
    const auto types = hdf5::read_texts(group, "type");
    const auto agent = numbers<std::int32_t>(group, "agent", {count});
    const auto drone = numbers<std::int32_t>(group, "drone", {count});
    const auto value = numbers<double>(group, "value", {count});
    const auto partners = hdf5::read_texts(group, "partner");
    const auto other = numbers<std::int32_t>(group, "other", {count});
    const auto extra = numbers<double>(group, "extra", {count});
    for (const auto& [name, words] : {std::pair("type", &types), std::pair("partner", &partners)}) {
      if (words->size() == count) continue;
      reject(source_, fmt::format("events/{}", name), fmt::format("{} entries", words->size()),
             fmt::format("{}", count));
    }
    std::vector<TraceEvent> events;
    for (std::size_t i = 0; i < count; ++i) {
      require_index(agent[i], -1, header.agent_count(), "events/agent");
      require_index(drone[i], -1, header.drone_ids.size(), "events/drone");
      events.push_back(from_row(
          {time_s[i], types[i], agent[i], drone[i], value[i], partners[i], other[i], extra[i]},
          source_));
    }
    return events;
  }

  std::string text(const char* name) {
    std::string value = hdf5::read_text_attribute(root_, name);
    require_utf8(value, name);
    return value;
  }

  std::vector<std::string> texts(const char* name) {
    std::vector<std::string> values = hdf5::read_texts(root_, name);
    for (const std::string& value : values) require_utf8(value, name);
    return values;
  }

  // Names and ids end up in JSON, whose writer refuses other bytes.
  void require_utf8(const std::string& value, const char* name) {
    if (is_utf8(value)) return;
    reject(source_, name, "bytes that are not UTF-8", "text");
  }

  double number(const char* name, double max) {
    const auto value = hdf5::read_attribute<double>(root_, name);
    if (!(value >= 0 && value <= max)) {
      reject(source_, name, fmt::format("{}", value), fmt::format("a number from 0 to {}", max));
    }
    return value;
  }

  hdf5::Handle open_group(const char* name) {
    return {H5Gopen2(root_.id(), name, H5P_DEFAULT), H5Gclose, name};
  }

  void require_index(std::int64_t index, std::int64_t lowest, std::size_t count,
                     const char* where) {
    if (index >= lowest && index < static_cast<std::int64_t>(count)) return;
    reject(source_, where, std::to_string(index), fmt::format("{} to below {}", lowest, count));
  }

  template <typename T>
  std::vector<T> numbers(const hdf5::Handle& group, const char* name,
                         const std::vector<hsize_t>& shape) {
    hsize_t count = 1;
    for (const hsize_t size : shape) {
      if (size > 0 && count > kMaxElements / size) throw hdf5::Failure(name);
      count *= size;
    }
    hdf5::require_stored(group, name, shape, sizeof(T));
    std::vector<T> values(count);
    hdf5::read_into(group, name, shape, hdf5::element_type<T>(), values.data());
    if constexpr (std::is_floating_point_v<T>) {
      for (const T value : values) {
        if (!std::isfinite(value)) reject(source_, name, fmt::format("{}", value), "a number");
      }
    }
    return values;
  }

  std::vector<Eigen::Vector2f> vectors(const hdf5::Handle& group, const char* name, hsize_t steps,
                                       hsize_t agents) {
    const auto xy = numbers<float>(group, name, {steps, agents, 2});
    std::vector<Eigen::Vector2f> points(xy.size() / 2);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {xy[2 * i], xy[2 * i + 1]};
    return points;
  }

  std::string source_;
  hdf5::Handle root_;
};

}  // namespace

Trace read_trace(const fs::path& path) {
  const hdf5::QuietErrors quiet;
  try {
    return Reader(path).read();
  } catch (const hdf5::Failure& failure) {
    reject(path.string(), failure.what(), "data that is missing, damaged or of another shape",
           "a trace of version " + std::to_string(kTraceVersion));
  }
}

}  // namespace throng::world
