#include "metrics/trajectories/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/text/words.h"
#include "metrics/trajectories/column_roles.h"
#include "metrics/trajectories/table_fields.h"
#include "metrics/trajectories/table_people.h"
#include "metrics/trajectories/table_units.h"
#include "metrics/trajectories/text_encoding.h"
#include "metrics/trajectories/timed_tracks.h"
#include "metrics/trajectories/trajectory_words.h"
#include "metrics/trajectories/unnamed_columns.h"

namespace throng::metrics {

using Eigen::Vector2d;
using Fields = std::vector<std::string_view>;

namespace {

constexpr double kMaxFrame = 1e7;

bool is_missing(std::string_view field) {
  const std::string word = lower_case(field);
  return word.empty() || word == "nan" || word == "na" || word == "null";
}

/// The statements of a table before its rows.
struct TableHead {
  enum class Next : std::uint8_t { names, units, rows };

  Next next = Next::names;  ///< the kind of line that may come next
  char separator = 0;       ///< 0: not known yet
  std::optional<ColumnRoles> roles;
  std::optional<ColumnRoles> roles_in_comment;
  bool are_numbered = false;  ///< the columns, by the user
  bool has_names = false;
  std::size_t name_count = 0;
  bool spans_gaps = false;  ///< people are present between any of their times
  std::optional<double> frames_per_s;

  bool is_by_time() const { return roles && roles->by_time; }
};

[[noreturn]] void reject_names(const Fields& names, const std::string& missing,
                               const TableLine& line) {
  std::string all;
  for (const std::string_view name : names) all += (all.empty() ? "" : ", ") + shown(name);
  line.reject(all.substr(0, 200),
              fmt::format("a column \"{}\"; --columns id,frame,x,y (or time for frame) says what "
                          "they are in their order (in JSON \"columns\")",
                          missing));
}

/// Whether the line names the columns, which no line with numbers does.
bool read_names(TableHead& head, TableUnits& units, const Fields& names,
                const TrajectoryFormat& format, const TableLine& line) {
  head.next = TableHead::Next::rows;
  const bool are_names = std::none_of(names.begin(), names.end(),
                                      [](auto name) { return field_number(name).has_value(); });
  if (head.are_numbered) {
    if (are_names && head.roles->last() < names.size()) {
      state_units_in_names(units, names, *head.roles, line);
    }
    return are_names;
  }
  if (!are_names) {
    head.roles = head.roles_in_comment;
    return false;
  }
  if (are_names_of_boxes(names)) return true;
  std::string missing;
  head.roles = named_columns(names, format.columns, missing);
  if (!head.roles) reject_names(names, missing, line);
  head.next = TableHead::Next::units;
  head.name_count = names.size();
  head.has_names = true;
  head.spans_gaps = bare_name(names[head.roles->x]) == "startx";  // footsteps of Vadere, in m
  units.are_stated = units.are_stated || head.spans_gaps;
  state_units_in_names(units, names, *head.roles, line);
  return true;
}

/// Whether a line that begins with $ is nothing but a mark of Viswalk's.
bool read_viswalk_word(TableHead& head, TableUnits& units, std::string_view text,
                       const TrajectoryFormat& format, const TableLine& line) {
  constexpr std::string_view kNames = "$PEDESTRIAN:";
  if (text.starts_with(kNames)) {
    head.separator = ';';
    const Fields names = split_fields(text.substr(kNames.size()), head.separator);
    head.has_names = read_names(head, units, names, format, line);
    units.are_stated = true;  // m unless a comment states another
    return true;
  }
  if (text.starts_with("$VISION")) return true;
  if (text.starts_with("$VEHICLE:")) line.reject("a table of vehicles", "one of pedestrians");
  return false;
}

void read_comment(TableHead& head, TableUnits& units, std::string_view text,
                  const TableLine& line) {
  if (text.front() == '*') return state_units_in_explanation(units, text, line);
  if (const auto rate = frame_rate_in(text)) head.frames_per_s = rate;
  text.remove_prefix(1);
  std::string missing;
  const Fields words = split_names(text, detect_separator(trimmed(text, " \t\r")));
  auto roles = named_columns(words, {}, missing);
  if (roles && roles->last() < words.size()) {
    state_units_in_names(units, words, *roles, line);
    head.roles_in_comment = roles;
  }
  if (!head.has_names) state_units_in_comment(units, text, words, line);
}

/// Refuses rows that have not as many fields as the head says.
void check_field_count(const TableHead& head, const Fields& fields, const TableLine& line) {
  const std::size_t needed = head.roles->last() + 1;
  if (fields.size() < needed) {
    line.reject(fmt::format("{} fields", fields.size()), fmt::format("at least {}", needed));
  }
  if (head.separator == ',' && head.has_names && fields.size() > head.name_count &&
      !(fields.size() == head.name_count + 1 && fields.back().empty())) {
    line.reject(fmt::format("{} fields", fields.size()),
                fmt::format("{}, as there are names; decimals with a comma need quotes or another "
                            "separator",
                            head.name_count));
  }
}

Recorded on_frames(const TablePeople& people, std::optional<double> frames_per_s,
                   const std::string& file) {
  Recorded recorded;
  recorded.frames_per_s = frames_per_s.value_or(0);
  if (!(recorded.frames_per_s > 0)) {
    throw InputError({file, "", "no frame rate",
                      kFrameRateExpected + std::string(", or a comment \"# framerate: 16\"")});
  }
  people.put_frames(recorded);
  return recorded;
}

/// Reads the lines of a table one after the other.
class TableReader {
 public:
  TableReader(const std::string& name, const TrajectoryFormat& format)
      : format_(format), line_{name}, unnamed_(name) {
    head_.roles = numbered_columns(format.columns);
    head_.are_numbered = head_.roles.has_value();
    units_.are_given = format.unit_m.has_value();
  }

  void read_line(std::string_view text) {
    ++line_.number;
    const std::string_view trimmed_text = trimmed(text, " \t\r");
    if (trimmed_text.empty()) return;
    const char first = trimmed_text.front();
    if (first == '#' || first == '*') return read_comment(head_, units_, trimmed_text, line_);
    if (first == '$' && read_viswalk_word(head_, units_, trimmed_text, format_, line_)) return;
    if (head_.separator == 0) head_.separator = detect_separator(trimmed_text);
    const std::string_view row = head_.separator == ' ' ? trimmed_text : text;
    if (head_.next == TableHead::Next::names &&
        read_names(head_, units_, split_names(row, head_.separator), format_, line_)) {
      return;
    }
    const Fields fields = split_fields(row, head_.separator);
    const bool may_be_units = head_.next == TableHead::Next::units;
    if (may_be_units && state_units_in_row(units_, fields, *head_.roles, line_)) return;
    head_.next = TableHead::Next::rows;
    if (head_.roles) return read_row(fields);
    if (unnamed_.empty() && read_annotation(fields)) return;
    read_unnamed(fields);
  }

  /// The recording of all lines.
  Recorded finish() {
    for (const UnnamedRow& row : unnamed_.person_first(head_.frames_per_s.has_value())) {
      line_.number = row.line;
      add(fmt::format("{}", row.first), row.second, row.place);
    }
    if (units_.y_m != units_.x_m) people_.scale_y(units_.y_m / units_.x_m);
    const auto rate = format_.frames_per_s ? format_.frames_per_s : head_.frames_per_s;
    const std::string left_out = left_out_.text();
    if (!left_out.empty() && people_.empty()) {
      throw InputError({line_.file, "", "no people, " + left_out, "Pedestrian as label"});
    }
    Recorded recorded = head_.is_by_time()
                            ? put_on_frames(people_.take_timed(head_.spans_gaps), rate, line_.file)
                            : on_frames(people_, rate, line_.file);
    if (!left_out.empty()) recorded.notes.push_back({"", "", left_out, ""});
    recorded.unit_m = units_.x_m;
    recorded.unit_is_stated = units_.are_stated;
    people_.put_names(recorded);
    return recorded;
  }

 private:
  void read_row(const Fields& fields) {
    check_field_count(head_, fields, line_);
    const ColumnRoles& roles = *head_.roles;
    if (is_missing(fields[roles.x]) && is_missing(fields[roles.y])) return;
    const std::string_view person = fields[roles.person];
    if (person.empty()) line_.reject("nobody", "a person's name or number");
    double when = 0;
    if (roles.by_time) {
      const auto time = field_time(fields[roles.when]);
      if (!time) line_.reject(shown(fields[roles.when]), "a time");
      numbers_.note_decimal(time->decimal, line_);
      when = time->value * units_.time_s;
    } else {
      when = numbers_.read(fields[roles.when], line_);
    }
    const double x = numbers_.read(fields[roles.x], line_);
    const double y = numbers_.read(fields[roles.y], line_);
    add(person, when, Vector2d(x, y));
  }

  /// Whether the row is one of the Stanford Drone Dataset.
  bool read_annotation(const Fields& fields) {
    const auto box = read_annotated_box(fields);
    if (!box) return false;
    if (!units_.are_given && !units_.are_stated) {
      const Unit pixels{.kind = Unit::Kind::pixels};
      line_.reject("boxes in pixels, as of the Stanford Drone Dataset", expected_unit(pixels));
    }
    if (!left_out_.add(*box)) add(fmt::format("{}", box->track), box->frame, box->center);
    return true;
  }

  void read_unnamed(const Fields& fields) {
    unnamed_.add(fields, line_.number);
    for (std::size_t i = 0; i < UnnamedTable::kUsed; ++i) {
      numbers_.note_decimal(field_number(fields[i])->decimal, line_);
    }
  }

  void add(std::string_view person, double when, const Vector2d& place) {
    const auto expected = [&](const char* of_named) {
      return head_.has_names ? of_named : kUnnamedExpected;
    };
    if (!head_.is_by_time() && when != std::floor(when)) {
      line_.reject(fmt::format("frame {}", when), expected("a whole number"));
    }
    if (!head_.is_by_time() && std::abs(when) > kMaxFrame) {
      line_.reject(fmt::format("frame {:g}", when), "a frame within 1e7");
    }
    if (!people_.add(person, when, place)) {
      line_.reject("the same person and time again", expected("each person once at a time"));
    }
  }

  const TrajectoryFormat& format_;
  TableLine line_;
  TableHead head_;
  TableUnits units_;
  TableNumbers numbers_;
  UnnamedTable unnamed_;
  LeftOut left_out_;
  TablePeople people_;
};

}  // namespace

Recorded read_table(std::string_view text, const std::string& name,
                    const TrajectoryFormat& format) {
  TableReader reader(name, format);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    reader.read_line(text.substr(at, end - at));
    at = end + 1;
  }
  return reader.finish();
}

}  // namespace throng::metrics
