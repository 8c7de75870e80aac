// Tables without names whose columns are not person, frame, x and y: tracks in images, and others
// of which a further column may be the frame.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "metrics/trajectories/column_roles.h"

namespace throng::metrics {

/// Expected in messages about rows of tables without names.
inline constexpr const char* kUnnamedExpected =
    "id, frame (whole numbers), x and y, each person once a frame; or columns that are named "
    "(--columns frame,id,x,y)";

/// Rows of which the first four columns are person, frame, x and y, or frame, person, x and y; of
/// ETH's obsmat.txt frame, person, x, height, y and velocities, the heights being 0.
class UnnamedTable {
 public:
  static constexpr std::size_t kUsed = 4;  ///< columns that each row has

  explicit UnnamedTable(std::string name) : name_(std::move(name)) {}

  bool empty() const { return rows_.empty(); }

  /// Adds the row of a line. Throws InputError.
  void add(const std::vector<std::string_view>& fields, int line);

  /// Returns the rows with the person first (order_of_columns()). Throws InputError if that is
  /// unclear or another column is as good a frame: one from the third on that grows by the same
  /// step within nearly every person and is no other scale of the frame. If the frame grows by the
  /// same steps, too, the column has no more different values. The third and the fourth, where x
  /// and y are expected, have fewer in any case; only these are looked at in tables of up to five
  /// columns.
  std::vector<UnnamedRow> person_first(bool states_rate) const;

 private:
  [[noreturn]] void refuse_order() const;

  std::string name_;
  std::vector<UnnamedRow> rows_;
  std::vector<double> depths_;                // of obsmat.txt
  std::vector<std::vector<double>> samples_;  // all columns of the first rows; NaN for words
  bool is_obsmat_ = true;
};

/// A row of the Stanford Drone Dataset (of vatic): track, xmin, ymin, xmax, ymax (pixels), frame,
/// lost, occluded, generated, label.
struct AnnotatedBox {
  double track = 0;
  double frame = 0;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< pixels, y downward
  bool is_lost = false;                              ///< outside of the view
  std::string label;
};

/// The row in these fields; nothing if they are others.
std::optional<AnnotatedBox> read_annotated_box(const std::vector<std::string_view>& fields);

/// Whether names are those of the columns of such rows.
bool are_names_of_boxes(const std::vector<std::string_view>& names);

/// Counts the rows of a dataset of boxes that are left out.
class LeftOut {
 public:
  /// Whether a row is left out: its label is not that of a person, or the person is lost.
  bool add(const AnnotatedBox& box);
  /// "left out: 12 tracks of Biker, 3 of Cart; 40 rows of people out of view"; "" if nothing was.
  std::string text() const;

 private:
  std::map<std::string, std::set<double>> others_;  ///< tracks by label
  std::size_t lost_rows_ = 0;
};

}  // namespace throng::metrics
