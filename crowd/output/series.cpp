#include "crowd/output/series.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "crowd/output/csv.h"

namespace throng::crowd {

namespace {

constexpr int kDecimals = 4;

struct Spread {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d deviation = Eigen::Vector2d::Zero();
};

/// The spread of the positions of all agents that take part; NaN if none does.
Spread measure_spread(const Simulation& crowd, double count) {
  Spread spread;
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    if (crowd.present()[i] != 0) spread.mean += crowd.positions()[i].cast<double>();
  }
  spread.mean /= count;
  Eigen::Array2d squares = Eigen::Array2d::Zero();
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    if (crowd.present()[i] == 0) continue;
    squares += (crowd.positions()[i].cast<double>() - spread.mean).array().square();
  }
  spread.deviation = (squares / count).sqrt();
  return spread;
}

struct Speeds {
  double sum = 0;
  double highest = 0;

  void add(double speed) {
    sum += speed;
    // A value that is not a number stays.
    if (!(speed <= highest) && !std::isnan(highest)) highest = speed;
  }
};

}  // namespace

SeriesWriter::SeriesWriter(const std::filesystem::path& path, const Simulation& crowd)
    : file_(path) {
  std::string header =
      "time,frac_final_state,frac_terminal_state,mean_speed,max_speed,min_pair_dist,"
      "overlapping_pairs,mean_x,mean_y,std_x,std_y";
  for (const std::string& name : crowd.state_names()) {
    header += fmt::format(",{}", csv_text("n_" + name));
  }
  file_.write(header + "\n");
}

void SeriesWriter::record(const Simulation& crowd) {
  const double half_frame_s = 0.5 * crowd.dt_s();
  last_written_ = crowd.time_s() >= next_s_ - half_frame_s;
  if (!last_written_) return;
  next_s_ = std::floor(crowd.time_s() + half_frame_s) + 1;
  write_line(crowd);
}

void SeriesWriter::finish(const Simulation& crowd) {
  if (!last_written_) write_line(crowd);
  file_.commit();
}

void SeriesWriter::write_line(const Simulation& crowd) {
  std::vector<std::size_t> in_state(crowd.state_names().size(), 0);
  Speeds speeds;
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    if (crowd.present()[i] == 0) continue;
    ++in_state[crowd.states()[i]];
    speeds.add(crowd.velocities()[i].norm());
  }
  std::size_t all = 0;
  std::size_t final = 0;
  std::size_t terminal = 0;
  for (std::size_t state = 0; state < in_state.size(); ++state) {
    all += in_state[state];
    if (crowd.is_final(static_cast<std::uint8_t>(state))) final += in_state[state];
    if (!crowd.has_exits(static_cast<std::uint8_t>(state))) terminal += in_state[state];
  }
  const auto count = static_cast<double>(all);
  const Spread spread = measure_spread(crowd, count);
  const PairDistances pairs =
      pairs_.measure(crowd.positions(), crowd.body_radii_m(), crowd.present());
  std::string line = csv_number(crowd.time_s(), kDecimals);
  const auto add = [&](double value) { line += fmt::format(",{}", csv_number(value, kDecimals)); };
  add(static_cast<double>(final) / count);
  add(static_cast<double>(terminal) / count);
  add(speeds.sum / count);
  add(all > 0 ? speeds.highest : NAN);
  add(pairs.nearest_m);
  line += fmt::format(",{}", pairs.overlapping);
  for (const Eigen::Vector2d& each : {spread.mean, spread.deviation}) {
    add(each.x());
    add(each.y());
  }
  for (const std::size_t number : in_state) line += fmt::format(",{}", number);
  file_.write(line + "\n");
}

}  // namespace throng::crowd
