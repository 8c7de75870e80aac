// Menge's trajectories as recorded people, and back.
#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "crowd/output/scb.h"
#include "metrics/trajectories/other_formats.h"
#include "metrics/trajectories/scb_trajectory.h"

namespace throng::metrics {

Recorded read_scb(const std::filesystem::path& file) {
  crowd::ScbReader reader(file);
  if (!(reader.dt_s() > 0)) {
    throw InputError(
        {file.string(), "header",
         fmt::format("version {} and a time step of {:g} s", reader.version(), reader.dt_s()),
         "version 2.0 or later and a time step above 0"});
  }
  const std::size_t floats = reader.floats_per_agent();
  const std::size_t y_at = reader.version() == "2.4" ? 2 : 1;  // beside the ground's height
  Recorded recorded;
  recorded.unit_is_stated = true;
  // The header has a float: 0.1 s are to be 10 frames per second.
  constexpr double kDigits = 1e4;
  recorded.frames_per_s = std::round(kDigits / reader.dt_s()) / kDigits;
  for (std::size_t frame = 0; frame < reader.frame_count(); ++frame) {
    const std::vector<float> values = reader.frame(frame);
    for (std::size_t agent = 0; agent < reader.agent_count(); ++agent) {
      const float x = values[agent * floats];
      const float y = values[agent * floats + y_at];
      if (!std::isfinite(x) || !std::isfinite(y)) continue;  // does not take part
      recorded.places[static_cast<std::int64_t>(agent) + 1][static_cast<std::int64_t>(frame)] = {x,
                                                                                                 y};
    }
  }
  return recorded;
}

void write_scb(const world::Trace& trace, const std::filesystem::path& file) {
  std::vector<std::size_t> people;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] == world::AgentRole::person) people.push_back(agent);
  }
  const std::vector<std::int32_t> classes(people.size(), 0);
  crowd::ScbFile scb(file, "2.1", trace.header.dt_s, classes);
  std::vector<float> frame;
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    frame.clear();
    for (const std::size_t agent : people) {
      const std::size_t at = trace.at(step, agent);
      if (trace.present(step, agent)) {
        const Eigen::Vector2f& place = trace.position[at];
        frame.insert(frame.end(), {place.x(), place.y(), trace.yaw_rad[at],
                                   static_cast<float>(trace.state[at])});
      } else {
        frame.insert(frame.end(), 4, std::numeric_limits<float>::quiet_NaN());
      }
    }
    scb.add(frame);
  }
  scb.commit();
}

}  // namespace throng::metrics
