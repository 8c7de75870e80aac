// The module throng_engine of Python: live/engine/stepped_job.h with arrays of NumPy that show the
// engine's own memory.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "live/engine/stepped_job.h"
#include "world/trace_event.h"

namespace py = pybind11;

namespace throng::engine {

namespace {

/// A read-only array over memory that `owner` keeps.
template <typename Number>
py::array view(const Number* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array_t<Number> array(std::move(shape), data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array pairs(const std::vector<Eigen::Vector2f>& values, const py::object& owner) {
  static_assert(sizeof(Eigen::Vector2f) == 2 * sizeof(float));
  const float* data = values.empty() ? nullptr : values.front().data();
  return view(data, {static_cast<py::ssize_t>(values.size()), 2}, owner);
}

template <typename Number>
py::array numbers(const std::vector<Number>& values, const py::object& owner) {
  return view(values.data(), {static_cast<py::ssize_t>(values.size())}, owner);
}

/// Rows: velocity ahead, left, up (m/s), yaw rate (rad/s), beacon (above 0: on) and, in rows of 7,
/// pitch and yaw of the gimbal (rad).
std::vector<sim::RemoteCommand> read_commands(
    const py::array_t<double, py::array::c_style | py::array::forcecast>& rows) {
  constexpr double kDegreesPerRadian = 57.295779513082323;
  constexpr py::ssize_t kColumns = 5;
  constexpr py::ssize_t kGimbalColumns = 7;
  if (rows.ndim() != 2 || (rows.shape(1) != kColumns && rows.shape(1) != kGimbalColumns)) {
    throw InputError({"", "commands", "another shape",
                      "one row of 5 numbers per drone, or of 7 with the gimbal's pitch and yaw"});
  }
  std::vector<sim::RemoteCommand> commands(static_cast<std::size_t>(rows.shape(0)));
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    sim::RemoteCommand& command = commands[static_cast<std::size_t>(i)];
    for (py::ssize_t j = 0; j < rows.shape(1); ++j) {
      if (!std::isfinite(rows.at(i, j))) {
        throw InputError({"", "commands", "a number that is not finite", "finite numbers"});
      }
    }
    command.velocity_mps = {rows.at(i, 0), rows.at(i, 1), rows.at(i, 2)};
    command.yaw_rate_deg_s = kDegreesPerRadian * rows.at(i, 3);
    command.beacon = rows.at(i, 4) > 0;
    if (rows.shape(1) == kGimbalColumns) {
      command.gimbal = {kDegreesPerRadian * rows.at(i, 5), kDegreesPerRadian * rows.at(i, 6)};
    }
  }
  return commands;
}

py::list event_list(const std::vector<world::TraceEvent>& events) {
  py::list list;
  for (const world::TraceEvent& event : events) {
    const world::EventRow row = world::to_row(event);
    py::dict entry;
    entry["time_s"] = row.time_s;
    entry["type"] = row.type;
    entry["agent"] = row.agent;
    entry["drone"] = row.drone;
    entry["value"] = row.value;
    entry["partner"] = row.partner;
    entry["other"] = row.other;
    entry["extra"] = row.extra;
    list.append(std::move(entry));
  }
  return list;
}

void bind(py::module_& module) {
  py::class_<SteppedJob>(module, "SteppedJob")
      .def(py::init([](const std::string& job, const std::string& source,
                       std::optional<std::uint64_t> seed, bool is_remote, const std::string& trace,
                       int width, int height, int threads) {
             RunChoices choices;
             choices.seed = seed;
             choices.is_remote = is_remote;
             choices.trace_file = trace;
             choices.image_width = width;
             choices.image_height = height;
             choices.threads = threads;
             const py::gil_scoped_release released;
             return std::make_unique<SteppedJob>(job, source, choices);
           }),
           py::arg("job"), py::arg("source"), py::arg("seed"), py::arg("is_remote"),
           py::arg("trace"), py::arg("width"), py::arg("height"), py::arg("threads"))
      .def_property_readonly("dt_s", &SteppedJob::dt_s)
      .def_property_readonly("time_s", &SteppedJob::time_s)
      .def_property_readonly("duration_s", &SteppedJob::duration_s)
      .def_property_readonly("is_over", &SteppedJob::is_over)
      .def_property_readonly("drone_ids",
                             [](const SteppedJob& job) { return job.header().drone_ids; })
      .def_property_readonly("exit_ids",
                             [](const SteppedJob& job) { return job.header().exit_ids; })
      .def_property_readonly(
          "area",
          [](const SteppedJob& job) {
            const world::Rectangle& area = job.area();
            return std::vector<double>{area.min.x(), area.min.y(), area.max.x(), area.max.y()};
          })
      .def_property_readonly("positions",
                             [](const py::object& self) {
                               return pairs(self.cast<const SteppedJob&>().people().position, self);
                             })
      .def_property_readonly("velocities",
                             [](const py::object& self) {
                               return pairs(self.cast<const SteppedJob&>().people().velocity, self);
                             })
      .def_property_readonly("yaws",
                             [](const py::object& self) {
                               return numbers(self.cast<const SteppedJob&>().people().yaw_rad,
                                              self);
                             })
      .def_property_readonly("flags",
                             [](const py::object& self) {
                               return numbers(self.cast<const SteppedJob&>().people().flags, self);
                             })
      .def_property_readonly("exit_intents",
                             [](const py::object& self) {
                               return numbers(self.cast<const SteppedJob&>().people().exit_intent,
                                              self);
                             })
      .def_property_readonly("roles",
                             [](const SteppedJob& job) {
                               std::vector<int> roles;
                               for (const world::AgentRole role : job.header().role) {
                                 roles.push_back(static_cast<int>(role));
                               }
                               return py::array(py::cast(roles));
                             })
      .def_property_readonly("drones",
                             [](const py::object& self) {
                               const auto& rows = self.cast<const SteppedJob&>().drones();
                               return view(rows.data(), {rows.rows(), rows.cols()}, self);
                             })
      .def("step",
           [](SteppedJob& job, int steps) {
             const py::gil_scoped_release released;
             for (int i = 0; i < steps; ++i) job.step({});
           })
      .def("step_by",
           [](SteppedJob& job,
              const py::array_t<double, py::array::c_style | py::array::forcecast>& rows,
              int steps) {
             const std::vector<sim::RemoteCommand> commands = read_commands(rows);
             const py::gil_scoped_release released;
             for (int i = 0; i < steps; ++i) job.step(commands);
           })
      .def("take_events", [](SteppedJob& job) { return event_list(job.take_events()); })
      .def("image",
           [](SteppedJob& job, std::size_t drone, int width, int height) {
             const std::vector<std::uint8_t>& rgb = job.image(drone);
             return py::array_t<std::uint8_t>({height, width, 3}, rgb.data());  // a copy
           })
      .def("finish", &SteppedJob::finish, py::call_guard<py::gil_scoped_release>())
      .def("flown_job", &SteppedJob::flown_job);
}

}  // namespace

}  // namespace throng::engine

PYBIND11_MODULE(throng_engine, module) {
  py::register_exception<throng::InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<throng::EnvironmentError>(module, "EnvironmentError", PyExc_RuntimeError);
  throng::engine::bind(module);
}
