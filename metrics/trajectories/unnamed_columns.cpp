#include "metrics/trajectories/unnamed_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text/words.h"
#include "metrics/trajectories/number_in.h"
#include "metrics/trajectories/table_fields.h"
#include "metrics/trajectories/text_encoding.h"
#include "metrics/trajectories/trajectory_words.h"

namespace throng::metrics {

namespace {

using Samples = std::vector<std::vector<double>>;

constexpr std::size_t kUsualColumns = UnnamedTable::kUsed;  // person, frame, x, y

bool grows_by_steps(const Samples& rows, std::size_t person, std::size_t column) {
  constexpr double kNearlyAll = 0.9;
  constexpr double kMinSteps = 3;
  std::map<double, double> last;   // by person
  std::map<double, double> steps;  // how often
  double count = 0;
  for (const std::vector<double>& row : rows) {
    const double value = row[column];
    if (!(value == std::floor(value))) return false;
    const auto [known, is_new] = last.try_emplace(row[person], value);
    if (is_new) continue;
    ++steps[value - known->second];
    ++count;
    known->second = value;
  }
  if (count < kMinSteps) return false;
  const auto usual = std::max_element(steps.begin(), steps.end(),
                                      [](auto& a, auto& b) { return a.second < b.second; });
  return usual->first > 0 && usual->second >= kNearlyAll * count;
}

/// Whether two columns are the same but for their zero and their unit.
bool are_scales(const Samples& rows, std::size_t a, std::size_t b) {
  const std::vector<double>& first = rows.front();
  const auto other =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row[a] != first[a]; });
  if (other == rows.end()) return false;
  const double slope = ((*other)[b] - first[b]) / ((*other)[a] - first[a]);
  return std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
    constexpr double kRounding = 1e-6;
    return std::abs(first[b] + slope * (row[a] - first[a]) - row[b]) <= kRounding;
  });
}

std::size_t count_values(const Samples& rows, std::size_t column) {
  std::set<double> values;
  for (const std::vector<double>& row : rows) values.insert(row[column]);
  return values.size();
}

/// The column that is as good a frame as `frame`, if there is one.
std::optional<std::size_t> find_rival_frame(const Samples& rows, std::size_t person,
                                            std::size_t frame) {
  constexpr std::size_t kFewColumns = 5;
  if (rows.empty()) return std::nullopt;
  const std::size_t columns =
      rows.front().size() <= kFewColumns ? kUsualColumns : rows.front().size();
  const std::size_t frames = count_values(rows, frame);
  std::optional<std::size_t> rival;
  // Any regular column is as good as one that is not regular.
  std::size_t fewest =
      (grows_by_steps(rows, person, frame) ? frames : std::max(frames, rows.size())) + 1;
  for (std::size_t column = 2; column < columns; ++column) {
    const std::size_t values = count_values(rows, column);
    if (values >= fewest || (column < kUsualColumns && values >= frames)) continue;
    if (!grows_by_steps(rows, person, column) || are_scales(rows, frame, column)) continue;
    rival = column;
    fewest = values;
  }
  return rival;
}

}  // namespace

void UnnamedTable::add(const std::vector<std::string_view>& fields, int line) {
  constexpr std::size_t kObsmat = 8;
  constexpr double kMaxNumber = 1e15;
  const auto reject = [&](const std::string& found) {
    throw InputError({name_, fmt::format("line {}", line), found, kUnnamedExpected});
  };
  if (fields.size() < kUsed) reject(fmt::format("{} values", fields.size()));
  std::vector<double> row;
  row.reserve(fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto number = field_number(fields[i]);
    const double value = number ? number->value : std::numeric_limits<double>::quiet_NaN();
    row.push_back(value);
    const bool is_whole = value == std::floor(value) && std::abs(value) <= kMaxNumber;
    if (i < 2 ? !is_whole : i < kUsed && !number) reject(shown(fields[i]));
  }
  is_obsmat_ = is_obsmat_ && fields.size() == kObsmat && row[3] == 0 && row[6] == 0;
  rows_.push_back({row[0], row[1], {row[2], row[3]}, line});
  if (is_obsmat_) depths_.push_back(row[4]);
  constexpr std::size_t kSamples = 2000;
  if (samples_.size() < kSamples && (samples_.empty() || samples_[0].size() == row.size())) {
    samples_.push_back(std::move(row));
  }
}

std::vector<UnnamedRow> UnnamedTable::person_first(bool states_rate) const {
  if (rows_.empty()) return {};
  std::vector<UnnamedRow> rows = rows_;
  ColumnOrder order = ColumnOrder::frame_first;
  if (is_obsmat_) {
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].place.y() = depths_[i];
  } else {
    order = order_of_columns(rows, states_rate);
    const std::size_t frame = order == ColumnOrder::frame_first ? 0 : 1;
    if (const auto rival = find_rival_frame(samples_, 1 - frame, frame)) {
      throw InputError(
          {name_, "",
           fmt::format("{} columns without names, of which columns {} and {} may be the frame",
                       samples_[0].size(), frame + 1, *rival + 1),
           "the columns in their order, such as --columns id,x,y,-,-,frame (of a job: "
           "\"columns\": {\"person\": \"1\", \"x\": \"2\", \"y\": \"3\", \"frame\": \"6\"})"});
    }
  }
  if (order == ColumnOrder::unclear) refuse_order();
  if (order == ColumnOrder::frame_first) {
    for (UnnamedRow& row : rows) std::swap(row.first, row.second);
  }
  return rows;
}

void UnnamedTable::refuse_order() const {
  const auto count = [&](double UnnamedRow::*column) {
    std::set<double> numbers;
    for (const UnnamedRow& row : rows_) numbers.insert(row.*column);
    return numbers.size();
  };
  const auto first = count(&UnnamedRow::first);
  const auto second = count(&UnnamedRow::second);
  throw InputError(
      {name_, "",
       fmt::format("columns without names that are either {} people in {} frames or {} frames with "
                   "{} people",
                   first, second, first, second),
       "which column is the person: --columns id,frame,x,y or --columns frame,id,x,y (of a job: "
       "\"columns\": {\"person\": \"1\", \"frame\": \"2\", \"x\": \"3\", \"y\": \"4\"} or "
       "{\"frame\": \"1\", \"person\": \"2\", ...})"});
}

std::optional<AnnotatedBox> read_annotated_box(const std::vector<std::string_view>& fields) {
  constexpr std::size_t kNumbers = 9;
  constexpr std::size_t kFlags = 6;  // from here on
  if (fields.size() <= kNumbers || fields[kNumbers].empty() || number_in(fields[kNumbers])) {
    return std::nullopt;
  }
  std::array<double, kNumbers> numbers{};
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const auto number = number_in(fields[i]);
    if (!number || (i >= kFlags && *number != 0 && *number != 1)) return std::nullopt;
    numbers[i] = *number;
  }
  const auto& [track, x_min, y_min, x_max, y_max, frame, lost, occluded, generated] = numbers;
  if (x_max < x_min || y_max < y_min) return std::nullopt;
  return AnnotatedBox{track,
                      frame,
                      {0.5 * (x_min + x_max), 0.5 * (y_min + y_max)},
                      lost == 1,
                      std::string(fields[kNumbers])};
}

bool are_names_of_boxes(const std::vector<std::string_view>& names) {
  constexpr std::array kNames = {"xmin", "ymin", "xmax", "ymax", "frame", "lost"};
  if (names.size() <= kNames.size()) return false;
  return std::equal(
      kNames.begin(), kNames.end(), names.begin() + 1,
      [](std::string_view name, std::string_view found) { return bare_name(found) == name; });
}

bool LeftOut::add(const AnnotatedBox& box) {
  const std::string label = lower_case(box.label);
  if (label != "pedestrian" && label != "person") {
    others_[box.label].insert(box.track);
    return true;
  }
  lost_rows_ += box.is_lost ? 1 : 0;
  return box.is_lost;
}

std::string LeftOut::text() const {
  std::string text;
  for (const auto& [label, tracks] : others_) {
    text +=
        fmt::format("{}{} of {}", text.empty() ? "tracks: " : ", ", tracks.size(), shown(label));
  }
  if (lost_rows_ > 0) {
    text +=
        fmt::format("{}{} rows of people out of view (lost)", text.empty() ? "" : "; ", lost_rows_);
  }
  return text.empty() ? text : "left out: " + text;
}

}  // namespace throng::metrics
