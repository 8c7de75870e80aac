// A run's figures of exits (metrics.json) against the table exits/RUN.csv.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "checks/exit_series.h"
#include "checks/validate_figures.h"
#include "formats/files/csv_table.h"

namespace throng::checks {

using nlohmann::json;

namespace {

/// Crossings count when the person is 0.2 m beyond the line, some time after having crossed it:
/// slow people stand in the door.
constexpr double kMaxDelayS = 4;
/// The table is of the last crowd step before the frame.
constexpr double kMaxStepS = 0.3;

/// The rows of exits/RUN.csv by exit.
class ExitTable {
 public:
  using Rows = std::vector<ExitRow>;

  explicit ExitTable(const formats::CsvTable& table) {
    const std::size_t exit = table.find("exit");
    if (exit == table.columns.size()) return;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      ExitRow row;
      row.line = i + 2;
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        row.value[table.columns[c]] = formats::parse_number(table.rows[i][c]);
      }
      rows_[table.rows[i][exit]].push_back(std::move(row));
    }
  }

  const Rows& of(const std::string& exit) const {
    static const Rows kNone;
    const auto found = rows_.find(exit);
    return found == rows_.end() ? kNone : found->second;
  }

 private:
  std::map<std::string, Rows> rows_;
};

/// One exit's figures and rows.
class ExitFigures {
 public:
  ExitFigures(std::string file, const json& exit, const ExitTable& table, const Report& fault)
      : file_(std::move(file)),
        exit_(exit),
        id_(exit.value("id", "")),
        rows_(table.of(id_)),
        crossed_s_(crossing_times(exit)),
        fault_(fault) {}

  /// No value of the table is above the greatest of all steps.
  void check_maxima() const {
    struct Maximum {
      const char* column;
      const char* key;
      double rounding;
    };
    for (const Maximum& maximum :
         {Maximum{"queue", "max_queue", 0.01}, Maximum{"queue_length", "max_queue_length_m", 0.01},
          Maximum{"predicted_wait", "max_predicted_wait_s", 0.01},
          Maximum{"pressure", "max_pressure_per_s2", 1e-5},
          Maximum{"voronoi_density", "max_voronoi_density_per_m2", 1e-4}}) {
      const auto found = exit_.find(maximum.key);
      if (found == exit_.end() || !found->is_number()) continue;
      const double limit = found->get<double>() + maximum.rounding;
      const auto above = std::find_if(rows_.begin(), rows_.end(), [&](const ExitRow& row) {
        return row[maximum.column] > limit;
      });
      if (above == rows_.end()) continue;
      fault_(fmt::format("{} of {} is {}, but {} line {} has {}", maximum.key, id_, found->dump(),
                         file_, above->line, (*above)[maximum.column]));
      return;
    }
  }

  /// Crossings are at the times that gaps and last crossing give.
  void check_crossings() const {
    const double in = exit_.value("crossings", json::object()).value("in", 1e9);
    for (const ExitRow& row : rows_) {
      if (row["crossed_in"] > in) {
        fault_(fmt::format("crossings.in of {} is {}, but {} line {} has {}", id_, in, file_,
                           row.line, row["crossed_in"]));
        return;
      }
      const double crossed = row["crossed_out"];
      const double max = crossed_until(row["time_s"] + 1e-3);
      const double min = crossed_until(row["time_s"] - kMaxDelayS - kMaxStepS);
      if (std::isnan(crossed) || (crossed <= max && crossed >= min)) continue;
      fault_(
          fmt::format("{} has {} crossings in {} line {}, but {} by its gaps and "
                      "last_crossing_s",
                      id_, crossed, file_, row.line, max));
      return;
    }
  }

  /// The longest time of the last seconds before a row that began with a queue, and the fewest
  /// crossings outward in it.
  struct Waiting {
    double max_s = 0;
    double min_crossed = 0;
  };
  Waiting waiting_before(std::size_t index) const {
    const double from_s = rows_[index]["time_s"] - kWaitWindowS;
    Waiting waiting;
    double known_from_s = rows_[index]["time_s"];
    for (std::size_t i = index; i > 0; --i) {
      const ExitRow& then = rows_[i - 1];
      const double length_s = known_from_s - std::max(then["time_s"], from_s);
      // Between frames that are farther apart a queue may come and go.
      constexpr double kNeighborsS = 1.1;
      const bool are_near = rows_[i]["time_s"] - then["time_s"] <= kNeighborsS;
      const bool may_wait = then["queue"] > 0 || rows_[i]["queue"] > 0 || !are_near;
      if (may_wait) waiting.max_s += length_s;
      known_from_s = std::max(then["time_s"], from_s);
      if (then["time_s"] < from_s) break;
      // Crossings count where the step before had a queue.
      const bool waits = are_near && then["queue"] > 0 && rows_[i]["queue"] > 0;
      if (waits)
        waiting.min_crossed += std::max(rows_[i]["crossed_out"] - then["crossed_out"] - 1, 0.0);
    }
    waiting.max_s +=
        std::max(std::min(known_from_s, rows_[0]["time_s"]) - std::max(from_s, 0.0), 0.0);
    constexpr double kSlackS = 2;
    waiting.max_s = std::min(waiting.max_s + kSlackS, kWaitWindowS);
    return waiting;
  }

  /// The predicted wait is the queue over a rate, which is between what the crossings of the last
  /// seconds give with one lane's capacity and with the whole door's (docs/metrics.md).
  void check_waits() const {
    const auto width = exit_.find("width_m");
    if (width == exit_.end() || !width->is_number()) return;
    const double capacity = kCapacityPerMs * width->get<double>();
    const double min_capacity = kCapacityPerMs * std::min(kMinLaneM, width->get<double>());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const ExitRow& row = rows_[i];
      const double time_s = row["time_s"];
      const double passed =
          crossed_until(time_s + 1e-3) -
          crossed_until(time_s - kWaitWindowS - kMaxDelayS - kMaxStepS - kRoundingS);
      const double min_wait_s = row["queue"] * kWaitPriorS / (passed + capacity * kWaitPriorS);
      const Waiting waiting = waiting_before(i);
      const double max_wait_s = row["queue"] * (waiting.max_s + kWaitPriorS) /
                                (waiting.min_crossed + min_capacity * kWaitPriorS);
      const double wait_s = row["predicted_wait"];
      if (std::isnan(wait_s) ||
          (wait_s >= min_wait_s - kRoundingS && wait_s <= max_wait_s + kRoundingS)) {
        continue;
      }
      fault_(
          fmt::format("{} line {}: predicted_wait {} s for a queue of {}, expected {:.2f} to "
                      "{:.2f} s",
                      file_, row.line, wait_s, row["queue"], min_wait_s, max_wait_s));
      return;
    }
  }

 private:
  static constexpr double kRoundingS = 0.011;

  double crossed_until(double time_s) const {
    return static_cast<double>(std::upper_bound(crossed_s_.begin(), crossed_s_.end(), time_s) -
                               crossed_s_.begin());
  }

  std::string file_;
  const json& exit_;
  std::string id_;
  const ExitTable::Rows& rows_;
  std::vector<double> crossed_s_;
  const Report& fault_;
};

}  // namespace

void check_against_exit_table(const std::filesystem::path& root, const json& run,
                              const Report& fault) {
  const std::string file = "exits/" + run.at("run").get<std::string>() + ".csv";
  if (!std::filesystem::is_regular_file(root / file) || !run.contains("exits")) return;
  const ExitTable table(formats::read_csv(root / file));
  for (const json& exit : run.at("exits")) {
    const ExitFigures figures(file, exit, table, fault);
    figures.check_maxima();
    figures.check_crossings();
    figures.check_waits();
  }
}

}  // namespace throng::checks
