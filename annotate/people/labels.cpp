#include "annotate/people/labels.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <span>

#include "annotate/people/object_labels.h"
#include "annotate/people/person_record.h"
#include "base/error.h"

namespace throng::annotate {

namespace {

// Pixels [begin, end) of row y that show one person.
struct RowRun {
  std::uint32_t person;  // index into Frame::people
  int y;
  int begin;
  int end;
};

// First pixel at or after `x` that does not show `id`. Whole blocks are compared without a branch
// per pixel: most of an image is ground.
int end_of_run(const std::uint32_t* row, int x, int width, std::uint32_t id) {
  constexpr int kBlock = 16;
  while (x + kBlock <= width) {
    std::uint32_t difference = 0;
    for (int i = 0; i < kBlock; ++i) difference |= row[x + i] ^ id;
    if (difference != 0) break;
    x += kBlock;
  }
  while (x < width && row[x] == id) ++x;
  return x;
}

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

// Agent id -> index into Frame::people, kNobody where the frame does not list the agent.
std::vector<std::uint32_t> index_of_agents(const render::Frame& frame) {
  std::uint32_t count = 0;
  for (const render::PersonInView& person : frame.people) count = std::max(count, person.agent + 1);
  std::vector<std::uint32_t> index(count, kNobody);
  for (std::uint32_t i = 0; i < frame.people.size(); ++i) index[frame.people[i].agent] = i;
  return index;
}

// The people's runs, row by row.
std::vector<RowRun> scan(const render::Frame& frame) {
  const std::vector<std::uint32_t> index = index_of_agents(frame);
  const int width = frame.width();
  std::vector<RowRun> runs;
  for (int y = 0; y < frame.height(); ++y) {
    const std::uint32_t* row = frame.id.data() + static_cast<std::size_t>(y) * width;
    for (int x = 0; x < width;) {
      const std::uint32_t id = row[x];
      const int end = end_of_run(row, x, width, id);
      if (render::is_agent(id)) {
        const std::uint32_t agent = render::agent_of_id(id);
        check(agent < index.size() && index[agent] != kNobody,
              "all people in the id buffer are listed in the frame");
        runs.push_back({index[agent], y, x, end});
      }
      x = end;
    }
  }
  return runs;
}

// The same runs person by person, each person's still row by row; `first[p]` is where person p's
// begin, and `first[people]` the end.
struct RunsByPerson {
  std::vector<RowRun> runs;
  std::vector<std::size_t> first;

  std::span<const RowRun> of(std::size_t person) const {
    return std::span(runs).subspan(first[person], first[person + 1] - first[person]);
  }
};

RunsByPerson group(const std::vector<RowRun>& runs, std::size_t people) {
  RunsByPerson grouped{std::vector<RowRun>(runs.size()), std::vector<std::size_t>(people + 1)};
  for (const RowRun& run : runs) ++grouped.first[run.person + 1];
  for (std::size_t p = 0; p < people; ++p) grouped.first[p + 1] += grouped.first[p];
  std::vector<std::size_t> next(grouped.first.begin(), grouped.first.end() - 1);
  for (const RowRun& run : runs) grouped.runs[next[run.person]++] = run;
  return grouped;
}

PixelBox run_bounds(std::span<const RowRun> runs) {
  int left = runs.front().begin;
  int right = runs.front().end;
  for (const RowRun& run : runs) {
    left = std::min(left, run.begin);
    right = std::max(right, run.end);
  }
  const int top = runs.front().y;
  return {left, top, right - left, runs.back().y + 1 - top};
}

std::uint64_t count_pixels(std::span<const RowRun> runs) {
  std::uint64_t area = 0;
  for (const RowRun& run : runs) area += static_cast<std::uint64_t>(run.end - run.begin);
  return area;
}

// Turns row runs into column runs without painting the mask. Down a column, the mask toggles at row
// y exactly where rows y - 1 and y differ; as lists of run borders, that difference is a symmetric
// set difference. The work grows with the mask's outline, not with its area.
class ColumnRuns {
 public:
  RunLengths of(std::span<const RowRun> runs, const PixelBox& box, int width, int height) {
    find_toggles(runs, box);
    sort_by_column(box);
    return run_lengths(box, static_cast<std::uint64_t>(width) * height, height);
  }

 private:
  // Columns [begin, end) toggle at row y.
  struct Toggle {
    int y;
    int begin;
    int end;
  };

  void find_toggles(std::span<const RowRun> runs, const PixelBox& box) {
    toggles_.clear();
    above_.clear();
    auto run = runs.begin();
    for (int y = box.y; y <= box.y + box.height; ++y) {
      here_.clear();
      for (; run != runs.end() && run->y == y; ++run) {
        here_.push_back(run->begin);
        here_.push_back(run->end);
      }
      add_difference(y);
      std::swap(above_, here_);
    }
  }

  // Adds the differences of this row's runs and those above.
  void add_difference(int y) {
    if (above_.size() == 2 && here_.size() == 2 && above_[0] < here_[1] && here_[0] < above_[1]) {
      // Most often one run lies below one other.
      for (const std::size_t border : {0U, 1U}) {
        const auto [begin, end] = std::minmax(above_[border], here_[border]);
        if (begin != end) toggles_.push_back({y, begin, end});
      }
      return;
    }
    changes_.clear();
    std::set_symmetric_difference(above_.begin(), above_.end(), here_.begin(), here_.end(),
                                  std::back_inserter(changes_));
    for (std::size_t i = 0; i < changes_.size(); i += 2) {
      toggles_.push_back({y, changes_[i], changes_[i + 1]});
    }
  }

  // Rows at which each column toggles, column by column, downwards.
  void sort_by_column(const PixelBox& box) {
    first_.assign(box.width + 1, 0);
    for (const Toggle& toggle : toggles_) {
      for (int x = toggle.begin; x < toggle.end; ++x) ++first_[x - box.x + 1];
    }
    for (int x = 0; x < box.width; ++x) first_[x + 1] += first_[x];
    rows_.resize(first_.back());
    next_.assign(first_.begin(), first_.end() - 1);
    for (const Toggle& toggle : toggles_) {
      for (int x = toggle.begin; x < toggle.end; ++x) rows_[next_[x - box.x]++] = toggle.y;
    }
  }

  RunLengths run_lengths(const PixelBox& box, std::uint64_t pixels, int height) {
    positions_.clear();
    for (int x = 0; x < box.width; ++x) {
      const std::uint64_t top = static_cast<std::uint64_t>(box.x + x) * height;
      for (std::size_t i = first_[x]; i < first_[x + 1]; ++i) {
        const std::uint64_t position = top + rows_[i];
        // A run that ends at the bottom of a column goes on at the top of the next.
        if (!positions_.empty() && positions_.back() == position) {
          positions_.pop_back();
        } else {
          positions_.push_back(position);
        }
      }
    }
    if (positions_.empty() || positions_.back() != pixels) positions_.push_back(pixels);
    RunLengths lengths;
    lengths.reserve(positions_.size());
    std::uint64_t before = 0;
    for (const std::uint64_t position : positions_) {
      lengths.push_back(static_cast<std::uint32_t>(position - before));
      before = position;
    }
    return lengths;
  }

  std::vector<Toggle> toggles_;
  std::vector<int> above_, here_, changes_;
  std::vector<std::size_t> first_, next_;
  std::vector<int> rows_;
  std::vector<std::uint64_t> positions_;
};

}  // namespace

FrameLabels label_people(const render::Frame& frame) {
  const auto pixels = static_cast<std::size_t>(frame.width()) * frame.height();
  check(frame.id.size() == pixels, "the id buffer has the camera's size");
  const RunsByPerson grouped = group(scan(frame), frame.people.size());
  ColumnRuns column_runs;
  FrameLabels labels{frame.index, frame.time_s, {}, {}, label_objects(frame)};
  labels.people.reserve(frame.people.size());
  const Eigen::AlignedBox2d image(Eigen::Vector2d(0, 0),
                                  Eigen::Vector2d(frame.width(), frame.height()));
  for (std::size_t p = 0; p < frame.people.size(); ++p) {
    const std::span<const RowRun> runs = grouped.of(p);
    if (runs.empty()) {
      const Eigen::AlignedBox2d box = recorded_box(frame.people[p].amodal_box);
      const Eigen::AlignedBox2d inside = box.intersection(image);
      if (!inside.isEmpty() && inside.volume() > 0)
        labels.hidden.push_back({frame.people[p].agent, box});
      continue;
    }
    PersonLabel& label = labels.people.emplace_back();
    label.person = frame.people[p];
    label.agent = label.person.agent;
    label.box = run_bounds(runs);
    label.mask = column_runs.of(runs, label.box, frame.width(), frame.height());
    label.area_px = count_pixels(runs);
    // The amodal area comes from another draw, which may round an outline pixel the other way.
    label.person.amodal_area_px = std::max(label.person.amodal_area_px, label.area_px);
    label.visibility =
        static_cast<double>(label.area_px) / static_cast<double>(label.person.amodal_area_px);
  }
  return labels;
}

}  // namespace throng::annotate
