#include "checks/exit_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "checks/median.h"

namespace throng::checks {

namespace {

constexpr double kFullDensity = 0.6;
constexpr double kFreeSpeed = 0.6;

bool differs(double a, double b, double slack) { return std::abs(a - b) > slack; }

/// People gone out less people come in.
double net_flow(const ExitRow& row) { return row["crossed_out"] - row["crossed_in"]; }

/// Constants of an exit that the table does not name.
struct ExitSizes {
  double zone_m2 = 0;
  double packing = 0;  ///< normalized density over density
  double width_m = 0;
};

ExitSizes exit_sizes(const ExitSeries& series) {
  std::vector<double> areas;
  std::vector<double> packings;
  std::vector<double> widths;
  for (const auto& [frame, row] : series) {
    if (row["density"] > 0.02) areas.push_back(row["in_zone"] / row["density"]);
    if (row["density"] > 0.1) packings.push_back(row["normalised_density"] / row["density"]);
    if (std::abs(row["specific_flow"]) > 0.05) {
      widths.push_back(row["flow"] / row["specific_flow"]);
    }
  }
  return {median(areas), median(packings), median(widths)};
}

/// One row, and what it follows from.
class ExitRowCheck {
 public:
  ExitRowCheck(const std::string& file, const std::string& exit, const ExitSizes& sizes,
               const ExitRow& row, Findings& findings)
      : file_(file), exit_(exit), sizes_(sizes), row_(row), findings_(findings) {}

  void check_ratios() const {
    if (differs(row_["density"] * sizes_.zone_m2, row_["in_zone"], 0.02 + 0.01 * row_["in_zone"])) {
      fault(fmt::format("density {} is not in_zone {} over the zone's {:.2f} m2", row_["density"],
                        row_["in_zone"], sizes_.zone_m2));
    }
    if (differs(row_["normalised_density"], row_["density"] * sizes_.packing,
                2e-4 + 0.005 * row_["density"])) {
      fault(fmt::format("normalised_density {} is not density {} times {:.4f}",
                        row_["normalised_density"], row_["density"], sizes_.packing));
    }
    if (differs(row_["specific_flow"] * sizes_.width_m, row_["flow"],
                0.02 + 0.003 * sizes_.width_m)) {
      fault(fmt::format("specific_flow {} is not flow {} over {:.2f} m", row_["specific_flow"],
                        row_["flow"], sizes_.width_m));
    }
  }

  void check_states() const {
    const bool is_closed = row_.state == "closed";
    if (!is_closed && has_demand() == (row_.state == "idle")) {
      fault(fmt::format("state {} with demand {}", row_.state, row_["demand"]));
    }
    if ((row_.state_offline == "closed") != is_closed ||
        (row_.state_offline == "idle") != (row_.state == "idle") ||
        (row_.state == "clogged" && row_.state_offline != "clogged")) {
      fault(fmt::format("state_offline {} where state is {}", row_.state_offline, row_.state));
    }
  }

  void check_index() const {
    const double index = row_["clogging_index"];
    if (!has_demand() && index != 0) {
      fault(fmt::format("clogging_index {} without demand", index));
    }
    if (!has_demand() || !std::isfinite(sizes_.width_m)) return;
    const double full = std::min(1.0, row_["normalised_density"] / kFullDensity);
    const double capacity = kCapacityPerMs * sizes_.width_m;
    const double low = 0.5 * full * std::clamp(1 - row_["flow"] / capacity, 0.0, 1.0);
    const double high = low + 0.5 * full;
    const double slack = 0.004 + 0.01 * full;
    const double speed_lack = full > 0 ? std::clamp((index - low) / (0.5 * full), 0.0, 1.0) : 0;
    // The mean desired speed that the index would stand for.
    const double desired =
        speed_lack < 1 ? row_["approach_speed"] / (kFreeSpeed * (1 - speed_lack)) : 1;
    const bool is_between = index >= low - slack && index <= high + slack;
    constexpr double kMinSpeedMps = 0.2;
    constexpr double kMaxSpeedMps = 5;
    const bool is_plausible = full < 0.05 || speed_lack < 0.02 || speed_lack > 0.98 ||
                              (desired > kMinSpeedMps && desired < kMaxSpeedMps);
    const bool is_full_lack = row_["approach_speed"] > -0.01 || index >= high - slack;
    if (!is_between || !is_plausible || !is_full_lack) {
      fault(fmt::format(
          "clogging_index {}, but density, flow and approach speed give {:.3f} to {:.3f}", index,
          low, high));
    }
  }

  void check_queue() const {
    if (row_["queue"] == 0 && (row_["queue_length"] != 0 || row_["predicted_wait"] != 0)) {
      fault("a queue of nobody with a length or a wait");
    }
    const double lane_m = std::min(kMinLaneM, sizes_.width_m);
    const double max_wait_s =
        row_["queue"] * (kWaitWindowS + kWaitPriorS) / (kWaitPriorS * kCapacityPerMs * lane_m);
    if (std::isfinite(sizes_.width_m) && row_["predicted_wait"] > max_wait_s * 1.01 + 0.02) {
      fault(fmt::format("predicted_wait {} s for a queue of {}", row_["predicted_wait"],
                        row_["queue"]));
    }
  }

  void check_since(const ExitRow& last) const {
    const double dt_s = row_["time_s"] - last["time_s"];
    const double since_s = row_["since_crossing"];
    if (since_s > dt_s + 0.11 && differs(since_s, last["since_crossing"] + dt_s, 0.11)) {
      fault(fmt::format("since_crossing {} s, {} s before it was {} s", since_s, dt_s,
                        last["since_crossing"]));
    }
    if (row_["crossed_out"] < last["crossed_out"] || row_["crossed_in"] < last["crossed_in"]) {
      fault("fewer crossings than before");
    }
    if (row_["crossed_out"] > last["crossed_out"] && since_s > dt_s + 0.11) {
      fault(fmt::format("crossed_out grows, but since_crossing is {} s", since_s));
    }
    if (last.state == "closed" && row_.state != "closed") fault("a closed exit that opens");
  }

  /// `then`: the row of kFlowS seconds before.
  void check_flow(const ExitRow& then) const {
    if (differs(row_["time_s"] - then["time_s"], kFlowS, 1e-6)) return;
    const double expected = (net_flow(row_) - net_flow(then)) / kFlowS;
    // A crossing at the border of the 4 s may be in or out.
    if (differs(row_["flow"], expected, 0.26)) {
      fault(fmt::format("flow {} /s, but crossings changed by {} /s", row_["flow"], expected));
    }
  }

  static constexpr std::int64_t kFlowS = 4;  ///< seconds that flow is taken over

 private:
  bool has_demand() const { return row_["demand"] > 0; }
  void fault(const std::string& what) const {
    findings_.add("exits", file_, fmt::format("line {}", row_.line),
                  fmt::format("{}: {}", exit_, what));
  }

  const std::string& file_;
  const std::string& exit_;
  const ExitSizes& sizes_;
  const ExitRow& row_;
  Findings& findings_;
};

}  // namespace

double ExitRow::operator[](const char* column) const {
  const auto found = value.find(column);
  return found == value.end() ? std::nan("") : found->second;
}

void check_exit_series(const std::string& file, const std::string& exit, const ExitSeries& series,
                       Findings& findings) {
  const ExitSizes sizes = exit_sizes(series);
  const ExitRow* last = nullptr;
  for (const auto& [frame, row] : series) {
    const ExitRowCheck check(file, exit, sizes, row, findings);
    check.check_ratios();
    check.check_states();
    check.check_index();
    check.check_queue();
    if (last != nullptr) {
      check.check_since(*last);
      const double dt_s = row["time_s"] - (*last)["time_s"];
      const std::int64_t back = std::llround(static_cast<double>(ExitRowCheck::kFlowS) / dt_s);
      const auto then = back > 0 ? series.find(frame - back) : series.end();
      if (then != series.end()) check.check_flow(then->second);
    }
    last = &row;
  }
}

}  // namespace throng::checks
