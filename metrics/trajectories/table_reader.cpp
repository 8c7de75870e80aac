#include "metrics/trajectories/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/error.h"
#include "base/text/words.h"
#include "metrics/trajectories/column_roles.h"
#include "metrics/trajectories/comment_units.h"
#include "metrics/trajectories/number_in.h"
#include "metrics/trajectories/table_fields.h"
#include "metrics/trajectories/text_encoding.h"
#include "metrics/trajectories/timed_tracks.h"
#include "metrics/trajectories/trajectory_words.h"
#include "metrics/trajectories/unit_words.h"
#include "metrics/trajectories/unnamed_columns.h"

namespace throng::metrics {

using Eigen::Vector2d;
using Fields = std::vector<std::string_view>;

namespace {

constexpr double kMaxFrame = 1e7;
constexpr double kMaxId = 1e15;
/// The id of a person as a number; nothing for other words.
std::optional<std::int64_t> id_number(std::string_view word) {
  const auto number = number_in(word);
  if (!number || *number != std::floor(*number) || std::abs(*number) > kMaxId) return std::nullopt;
  return std::llround(*number);
}

class TableReader {
 public:
  TableReader(std::string_view text, const std::string& name, const TrajectoryFormat& format)
      : text_(text),
        name_(name),
        format_(format),
        roles_(numbered_columns(format.columns)),
        unnamed_(name) {
    are_numbered_ = roles_.has_value();
  }

  Recorded read() {
    for (std::size_t at = 0; at < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      ++line_;
      read_line(text_.substr(at, end - at));
      at = end + 1;
    }
    for (const UnnamedRow& row : unnamed_.person_first(stated_rate_.has_value())) {
      line_ = row.line;
      add(fmt::format("{}", row.first), row.second, row.place);
    }
    if (unit_of_y_m_ != unit_m_) {
      for (Track& track : tracks_) {
        for (auto& [when, place] : track) place.y() *= unit_of_y_m_ / unit_m_;
      }
    }
    return by_time() ? read_times() : read_frames();
  }

 private:
  enum class Part : std::uint8_t { names, units, rows };

  bool by_time() const { return roles_ && roles_->by_time; }

  void read_line(std::string_view line) {
    const std::string_view trimmed_line = trimmed(line, " \t\r");
    if (trimmed_line.empty()) return;
    if (trimmed_line.front() == '#' || trimmed_line.front() == '*') {
      return read_comment(trimmed_line);
    }
    if (trimmed_line.front() == '$' && read_viswalk_word(trimmed_line)) return;
    if (separator_ == 0) separator_ = detect_separator(trimmed_line);
    const std::string_view row = separator_ == ' ' ? trimmed_line : line;
    if (part_ == Part::names && read_names(split_names(row, separator_))) return;
    const Fields fields = split_fields(row, separator_);
    if (part_ == Part::units && read_units(fields)) return;
    part_ = Part::rows;
    read_row(fields);
  }

  void read_comment(std::string_view line) {
    if (line.front() == '*') {  // of Viswalk, which explains each column
      const std::string lower = lower_case(line);
      if (lower.find("coordcentx:") != std::string::npos) state_units(last_unit_in(line), {});
      if (const auto y = last_unit_in(line); y && lower.find("coordcenty:") != std::string::npos) {
        state_units(Unit{Unit::Kind::length, unit_m_}, y);  // x comes before
      }
      return;
    }
    if (const auto rate = frame_rate_in(line)) stated_rate_ = rate;
    line.remove_prefix(1);
    std::string missing;
    const Fields words = split_names(line, detect_separator(trimmed(line, " \t\r")));
    auto roles = named_columns(words, {}, missing);
    if (roles && roles->last() < words.size()) {
      state_columns(words, *roles);
      commented_ = roles;
    }
    if (!has_names_) state_units_of_comment(line, words);
  }

  /// Takes units from a comment that may name columns ("x/cm y/cm") or speak in sentences.
  void state_units_of_comment(std::string_view line, const Fields& words) {
    const auto unit_of = [&](const char* column) -> std::optional<Unit> {
      const auto at = column_named(words, column);
      return at ? unit_of_positions(words[*at]) : std::nullopt;
    };
    auto x = unit_of("x");
    auto y = unit_of("y");
    const bool are_alike = x && y && x->word == y->word;
    // "x/y" is no unit unless somebody names columns.
    if (x && !x->is_of_positions() && !are_alike) x.reset();
    if (y && !y->is_of_positions() && !are_alike) y.reset();
    if (!x && !y) x = unit_in_comment(line);
    state_units(x, y);
  }

  /// Takes units from the names of columns.
  void state_columns(const Fields& names, ColumnRoles& roles) {
    state_units(unit_of_positions(names[roles.x]), unit_of_positions(names[roles.y]));
    if (!roles.by_time) return;
    time_scale_ = 1;
    const auto unit = unit_of_times(names[roles.when]);
    if (!unit) return;
    if (unit->kind == Unit::Kind::unknown) {
      reject(fmt::format("times in {}", shown(unit->word)), "s, ms, us, ns, min, h or frames");
    }
    roles.by_time = unit->kind == Unit::Kind::time;
    time_scale_ = unit->factor;
  }

  /// Units of x and y; an axis without one has the other's. The user's unit overrides both.
  void state_units(const std::optional<Unit>& x, const std::optional<Unit>& y) {
    if ((!x && !y) || format_.unit_m) return;
    for (const auto& unit : {x, y}) {
      if (unit && unit->kind != Unit::Kind::length) {
        reject(fmt::format("positions in {}", shown(unit->word)), expected_unit(*unit));
      }
    }
    unit_m_ = x ? x->factor : y->factor;
    unit_of_y_m_ = y ? y->factor : x->factor;
    unit_is_stated_ = true;
  }

  /// Whether a line that begins with $ is nothing but a mark of Viswalk's.
  bool read_viswalk_word(std::string_view line) {
    constexpr std::string_view kNames = "$PEDESTRIAN:";
    if (line.starts_with(kNames)) {
      separator_ = ';';
      has_names_ = read_names(split_fields(line.substr(kNames.size()), separator_));
      unit_is_stated_ = true;  // m unless a comment states another
      return true;
    }
    if (line.starts_with("$VISION")) return true;
    if (line.starts_with("$VEHICLE:")) reject("a table of vehicles", "one of pedestrians");
    return false;
  }

  /// Whether the line names the columns, which no line with numbers does.
  bool read_names(const Fields& names) {
    part_ = Part::rows;
    const bool are_names = std::none_of(names.begin(), names.end(),
                                        [](auto name) { return field_number(name).has_value(); });
    if (are_numbered_) {
      if (are_names && roles_->last() < names.size()) state_columns(names, *roles_);
      return are_names;
    }
    if (!are_names) {
      roles_ = commented_;
      return false;
    }
    if (are_names_of_boxes(names)) return true;
    std::string missing;
    roles_ = named_columns(names, format_.columns, missing);
    if (!roles_) {
      std::string all;
      for (const std::string_view name : names) {
        all += (all.empty() ? "" : ", ") + shown(name);
      }
      reject(all.substr(0, 200),
             fmt::format("a column \"{}\"; --columns id,frame,x,y (or time for frame) says what "
                         "they are in their order (in JSON \"columns\")",
                         missing));
    }
    part_ = Part::units;
    field_count_ = names.size();
    has_names_ = true;
    spans_gaps_ = bare_name(names[roles_->x]) == "startx";  // footsteps of Vadere, in m
    unit_is_stated_ = unit_is_stated_ || spans_gaps_;
    state_columns(names, *roles_);
    return true;
  }

  /// Whether the line gives the units of the columns.
  bool read_units(const Fields& fields) {
    if (fields.size() <= roles_->last()) return false;
    const std::string_view unit = fields[roles_->x];
    if (unit.empty() || field_number(unit) || field_number(fields[roles_->y]) ||
        field_number(fields[roles_->when])) {
      return false;
    }
    state_units(unit_of_word(unit), unit_of_word(fields[roles_->y]));
    const Unit time = unit_of_word(fields[roles_->when]);
    if (time.kind == Unit::Kind::time) time_scale_ = time.factor;
    return true;
  }

  void read_row(const Fields& fields) {
    if (!roles_) {
      if (unnamed_.empty() && read_annotation(fields)) return;
      return read_unnamed(fields);
    }
    if (fields.size() <= roles_->last()) {
      reject(fmt::format("{} fields", fields.size()),
             fmt::format("at least {}", roles_->last() + 1));
    }
    if (separator_ == ',' && has_names_ && fields.size() > field_count_ &&
        !(fields.size() == field_count_ + 1 && fields.back().empty())) {
      reject(fmt::format("{} fields", fields.size()),
             fmt::format("{}, as there are names; decimals with a comma need quotes or another "
                         "separator",
                         field_count_));
    }
    const std::string_view x = fields[roles_->x];
    const std::string_view y = fields[roles_->y];
    if (is_missing(x) && is_missing(y)) return;
    const std::string_view person = fields[roles_->person];
    if (person.empty()) reject("nobody", "a person's name or number");
    double when = 0;
    if (roles_->by_time) {
      const auto time = field_time(fields[roles_->when]);
      if (!time) reject(shown(fields[roles_->when]), "a time");
      note_decimal(time->decimal);
      when = time->value * time_scale_;
    } else {
      when = number(fields[roles_->when]);
    }
    add(person, when, Vector2d(number(x), number(y)));
  }

  static bool is_missing(std::string_view field) {
    const std::string word = lower_case(field);
    return word.empty() || word == "nan" || word == "na" || word == "null";
  }

  /// Whether the row is one of the Stanford Drone Dataset.
  bool read_annotation(const Fields& fields) {
    const auto box = read_annotated_box(fields);
    if (!box) return false;
    if (!format_.unit_m && !unit_is_stated_) {
      const Unit pixels{.kind = Unit::Kind::pixels};
      reject("boxes in pixels, as of the Stanford Drone Dataset", expected_unit(pixels));
    }
    if (!left_out_.add(*box)) add(fmt::format("{}", box->track), box->frame, box->center);
    return true;
  }

  void read_unnamed(const Fields& fields) {
    unnamed_.add(fields, line_);
    for (std::size_t i = 0; i < UnnamedTable::kUsed; ++i) {
      note_decimal(field_number(fields[i])->decimal);
    }
  }

  void add(std::string_view person, double when, const Vector2d& place) {
    if (!by_time() && when != std::floor(when)) {
      reject(fmt::format("frame {}", when),
             has_names_ ? "a whole number" : std::string(kUnnamedExpected));
    }
    if (!by_time() && std::abs(when) > kMaxFrame) {
      reject(fmt::format("frame {:g}", when), "a frame within 1e7");
    }
    const auto id = id_number(person);
    const std::string key = id ? fmt::format("{}", *id) : std::string(person);
    const auto [known, is_new] = numbers_.try_emplace(key, tracks_.size());
    if (is_new) {
      tracks_.emplace_back();
      ids_.push_back(id.value_or(0));
      are_numbers_ = are_numbers_ && id.has_value();
    }
    if (!tracks_[known->second].try_emplace(when, place).second) {
      reject("the same person and time again",
             has_names_ ? "each person once at a time" : std::string(kUnnamedExpected));
    }
  }

  double number(std::string_view field) {
    const auto value = field_number(field);
    if (!value) reject(shown(field), "a number");
    note_decimal(value->decimal);
    return value->value;
  }

  /// Refuses points beside decimal commas, which may separate thousands.
  void note_decimal(char decimal) {
    if (decimal == 0 || decimal == decimal_) return;
    if (decimal_ != 0) {
      reject(fmt::format("a number with '{}', after numbers with '{}'", decimal, decimal_),
             "the same decimal separator throughout, and none of thousands");
    }
    decimal_ = decimal;
  }

  Recorded read_frames() {
    Recorded recorded;
    state(recorded);
    recorded.frames_per_s = format_.frames_per_s.value_or(stated_rate_.value_or(0));
    if (!(recorded.frames_per_s > 0)) {
      throw InputError({name_, "", "no frame rate",
                        kFrameRateExpected + std::string(", or a comment \"# framerate: 16\"")});
    }
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      auto& places = recorded.places[id_of(i)];
      for (const auto& [frame, place] : tracks_[i]) places[std::llround(frame)] = place;
    }
    return recorded;
  }

  Recorded read_times() {
    TimedPeople people{{}, std::move(tracks_), spans_gaps_};
    for (std::size_t i = 0; i < people.tracks.size(); ++i) people.ids.push_back(id_of(i));
    auto rate = format_.frames_per_s ? format_.frames_per_s : stated_rate_;
    Recorded recorded = put_on_frames(std::move(people), rate, name_);
    state(recorded);
    return recorded;
  }

  /// Adds what is known beside positions.
  void state(Recorded& recorded) const {
    if (const std::string text = left_out_.text(); !text.empty()) {
      if (tracks_.empty())
        throw InputError({name_, "", "no people, " + text, "Pedestrian as label"});
      recorded.notes.push_back({"", "", text, ""});
    }
    recorded.unit_m = unit_m_;
    recorded.unit_is_stated = unit_is_stated_;
    if (are_numbers_) return;
    for (const auto& [word, person] : numbers_) recorded.names[id_of(person)] = word;
  }

  /// The id of a person in the trace: the number in the file, or the place in its order.
  std::int64_t id_of(std::size_t person) const {
    return are_numbers_ ? ids_[person] : static_cast<std::int64_t>(person) + 1;
  }

  [[noreturn]] void reject(const std::string& found, const std::string& expected) const {
    throw InputError({name_, fmt::format("line {}", line_), found, expected});
  }

  std::string_view text_;
  const std::string& name_;
  const TrajectoryFormat& format_;
  std::optional<ColumnRoles> roles_;
  std::optional<ColumnRoles> commented_;  // columns that a comment names
  bool are_numbered_ = false;             // by the user
  bool has_names_ = false;
  Part part_ = Part::names;
  std::optional<double> stated_rate_;
  double unit_m_ = 1;       // of x
  double unit_of_y_m_ = 1;  // brought to that of x in the end
  bool unit_is_stated_ = false;
  double time_scale_ = 1;
  bool spans_gaps_ = false;
  int line_ = 0;
  char separator_ = 0;  // 0: not known yet
  char decimal_ = 0;
  std::size_t field_count_ = 0;
  UnnamedTable unnamed_;
  LeftOut left_out_;
  std::unordered_map<std::string, std::size_t> numbers_;  // of persons, in order of appearance
  std::vector<std::int64_t> ids_;
  bool are_numbers_ = true;
  std::vector<Track> tracks_;
};

}  // namespace

Recorded read_table(std::string_view text, const std::string& name,
                    const TrajectoryFormat& format) {
  return TableReader(text, name, format).read();
}

}  // namespace throng::metrics
