#include "annotate/ground_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "annotate/density.h"
#include "base/error.h"

namespace throng::annotate {

namespace {

std::size_t nearest_step(const world::Trace& trace, double time_s) {
  check(trace.steps() > 0, "a trace has steps");
  const auto after = std::lower_bound(trace.time_s.begin(), trace.time_s.end(), time_s);
  if (after == trace.time_s.begin()) return 0;
  if (after == trace.time_s.end()) return trace.steps() - 1;
  const auto step = static_cast<std::size_t>(after - trace.time_s.begin());
  return time_s - trace.time_s[step - 1] < trace.time_s[step] - time_s ? step - 1 : step;
}

}  // namespace

GroundField ground_field(const world::Trace& trace, const world::Rectangle& ground, double time_s) {
  GroundField field;
  field.origin = ground.min;
  const Eigen::Vector2d size = ground.max - ground.min;
  field.columns = std::max(1, static_cast<int>(std::ceil(size.x() / kFieldCellM)));
  field.rows = std::max(1, static_cast<int>(std::ceil(size.y() / kFieldCellM)));
  const auto cells = static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows);
  for (auto* values : {&field.density, &field.velocity_x, &field.velocity_y}) {
    values->assign(cells, 0);
  }
  const std::size_t step = nearest_step(trace, time_s);
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person || !trace.present(step, agent)) {
      continue;
    }
    const Eigen::Vector2d at = trace.position[trace.at(step, agent)].cast<double>();
    const Eigen::Vector2d cell = (at - field.origin) / kFieldCellM;
    const int column = static_cast<int>(std::floor(cell.x()));
    const int row = static_cast<int>(std::floor(cell.y()));
    if (column < 0 || row < 0 || column >= field.columns || row >= field.rows) continue;
    const std::size_t index =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(field.columns) +
        static_cast<std::size_t>(column);
    const Eigen::Vector2f& velocity = trace.velocity[trace.at(step, agent)];
    field.density[index] += 1;
    field.velocity_x[index] += velocity.x();
    field.velocity_y[index] += velocity.y();
    ++field.people;
  }
  for (std::size_t i = 0; i < cells; ++i) {
    if (field.density[i] == 0) continue;
    field.velocity_x[i] /= field.density[i];
    field.velocity_y[i] /= field.density[i];
    field.density[i] /= static_cast<float>(kFieldCellM * kFieldCellM);
  }
  return field;
}

std::string npy_bytes(const GroundField& field) {
  std::vector<float> values = field.density;
  values.insert(values.end(), field.velocity_x.begin(), field.velocity_x.end());
  values.insert(values.end(), field.velocity_y.begin(), field.velocity_y.end());
  return npy_bytes(std::array{3, field.rows, field.columns}, values);
}

}  // namespace throng::annotate
