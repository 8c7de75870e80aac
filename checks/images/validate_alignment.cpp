// Whether an image shows what its labels say: outlines of labels are where the image has edges.
//
// The mean brightness gradient along the labels' outlines is compared with that along the same
// outlines moved by some pixels. An image that belongs to its labels has its maximum where they
// are; of any other image all places are alike. How far the maximum stands out of the others, in
// standard deviations of these, also says whether an image (night, fog, noise) can tell at all.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "checks/median.h"
#include "checks/shot.h"
#include "formats/dataset/mask.h"

namespace throng::checks {

namespace {

constexpr int kReachPx = 7;
constexpr int kSide = 2 * kReachPx + 1;
constexpr int kNearPx = 1;  ///< a maximum so near is where it should be
constexpr std::size_t kMaxBorders = 6000;
constexpr std::size_t kMinBorders = 150;
/// The contrast of each person or object to what is around it is a sample of one: a few may have
/// the color of the ground, and the edge of a single roof looks alike wherever it is moved along
/// itself.
constexpr std::size_t kMinObjects = 6;
constexpr std::size_t kMinBordersOfObject = 40;
/// Sound images reach 4 to 30, any others stay below 2 (tests/cli/test_validate_damages.py).
constexpr double kMinScore = 2.5;
/// Places along a line, which are left out, still tell in their neighbors.
constexpr double kMinScoreOfLine = 1.5;
constexpr double kTellingScore = 5;

/// A border between two pixels: its left upper one, and whether the other lies to the right.
struct Border {
  int x;
  int y;
  bool is_right;
};

/// Differences across a border: of brightness and of color.
class Differences {
 public:
  explicit Differences(const Pixels& pixels) : pixels_(pixels) {}

  double at(const Border& border, int dx, int dy) const {
    const int x = border.x + dx;
    const int y = border.y + dy;
    const std::uint8_t* a = &pixels_.rgb[3 * pixels_.at(x, y)];
    const std::uint8_t* b =
        &pixels_.rgb[3 * pixels_.at(x + (border.is_right ? 1 : 0), y + (border.is_right ? 0 : 1))];
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += std::abs(static_cast<double>(a[c]) - b[c]);
    // Strong edges of something else must not decide alone.
    constexpr double kMaxSum = 60;
    return std::min(sum, kMaxSum);
  }

 private:
  const Pixels& pixels_;
};

/// The owner of a pixel: instances, or whose mask it is in.
std::vector<std::uint32_t> label_image(const Shot& shot) {
  if (!shot.pixels.ids.empty()) return shot.pixels.ids;
  std::vector<std::uint32_t> labels(shot.pixels.count());
  for (const formats::Person& person : list_objects(shot.image)) {
    const formats::Bitmap mask = shot.instance_mask(person);
    for (int y = mask.y; y < mask.y + mask.height; ++y) {
      for (int x = mask.x; x < mask.x + mask.width; ++x) {
        if (mask.at(x, y)) labels[shot.pixels.at(x, y)] = instance_id(person);
      }
    }
  }
  return labels;
}

struct Borders {
  std::vector<Border> borders;  ///< some, if there are many
  std::size_t objects = 0;      ///< people or objects that they are of
};

Borders count_borders(const Shot& shot, const std::vector<std::uint32_t>& labels, bool of_people) {
  const Pixels& pixels = shot.pixels;
  std::vector<Border> borders;
  std::map<std::uint32_t, std::size_t> count;  // by label
  constexpr int kMargin = kReachPx + 1;
  const auto add = [&](std::uint32_t a, std::uint32_t b, int x, int y, bool is_right) {
    if ((formats::is_person(a) || formats::is_person(b)) != of_people) return;
    borders.push_back({x, y, is_right});
    ++count[a];
    ++count[b];
  };
  for (int y = kMargin; y < pixels.height - kMargin; ++y) {
    const std::uint32_t* row = &labels[pixels.at(0, y)];
    const std::uint32_t* below = &labels[pixels.at(0, y + 1)];
    for (int x = kMargin; x < pixels.width - kMargin; ++x) {
      if (row[x] != row[x + 1]) add(row[x], row[x + 1], x, y, true);
      if (row[x] != below[x]) add(row[x], below[x], x, y, false);
    }
  }
  const auto objects = std::count_if(count.begin(), count.end(), [&](const auto& entry) {
    const auto& [label, borders_of_label] = entry;
    return borders_of_label >= kMinBordersOfObject && formats::is_person(label) == of_people &&
           label != formats::kGround && label != 0;
  });
  if (borders.size() <= kMaxBorders) return {borders, static_cast<std::size_t>(objects)};
  std::vector<Border> some;
  const std::size_t step = borders.size() / kMaxBorders + 1;
  for (std::size_t i = 0; i < borders.size(); i += step) some.push_back(borders[i]);
  return {some, static_cast<std::size_t>(objects)};
}

struct Alignment {
  double here = 0;  ///< mean difference along the outlines, at most a pixel away
  double best = 0;  ///< the greatest anywhere
  int best_x = 0;
  int best_y = 0;
  double others = 0;     ///< mean over places some pixels away
  double deviation = 0;  ///< standard deviation of these
  bool is_line = false;  ///< the outlines lie on themselves again in many places
  double score() const { return (here - others) / std::max(deviation, 1e-3); }
  double best_score() const { return (best - others) / std::max(deviation, 1e-3); }
};

/// Pixels with an outline in them or beside them: 1, else 0.
std::vector<std::uint8_t> near_outlines(const Pixels& pixels, const std::vector<Border>& borders) {
  std::vector<std::uint8_t> is_near(pixels.count(), 0);
  for (const Border& border : borders) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) is_near[pixels.at(border.x + dx, border.y + dy)] = 1;
    }
  }
  return is_near;
}

/// The outlines moved by some pixels.
struct Moved {
  int dx = 0;
  int dy = 0;
  double mean = 0;   ///< difference across them
  double again = 0;  ///< share that lies on outlines again
  int away() const { return std::max(std::abs(dx), std::abs(dy)); }
};

std::vector<Moved> all_moves(const Shot& shot, const std::vector<Border>& borders) {
  const Differences differences(shot.pixels);
  const std::vector<std::uint8_t> is_near = near_outlines(shot.pixels, borders);
  const auto count = static_cast<double>(borders.size());
  std::vector<Moved> moves;
  for (int dy = -kReachPx; dy <= kReachPx; ++dy) {
    for (int dx = -kReachPx; dx <= kReachPx; ++dx) {
      Moved moved{dx, dy};
      for (const Border& border : borders) {
        moved.mean += differences.at(border, dx, dy) / count;
        moved.again += is_near[shot.pixels.at(border.x + dx, border.y + dy)] / count;
      }
      moves.push_back(moved);
    }
  }
  return moves;
}

/// Outlines may lie on themselves again in many places, as those of a fence do along it. The image
/// has edges there, too, so that these places do not count among the others.
Alignment align(const Shot& shot, const std::vector<Border>& borders) {
  constexpr int kAwayPx = 4;
  constexpr double kMuchMore = 0.15;
  constexpr double kLineShare = 0.18;
  const std::vector<Moved> moves = all_moves(shot, borders);
  double again = 0;
  for (const Moved& moved : moves) again += moved.again / static_cast<double>(moves.size());
  const auto lies_on_itself = [&](const Moved& moved) {
    return moved.away() >= kAwayPx && moved.again > again + kMuchMore;
  };
  Alignment alignment;
  alignment.is_line =
      static_cast<double>(std::count_if(moves.begin(), moves.end(), lies_on_itself)) >
      kLineShare * static_cast<double>(moves.size());
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (const Moved& moved : moves) {
    if (moved.away() <= kNearPx) alignment.here = std::max(alignment.here, moved.mean);
    if (alignment.is_line && lies_on_itself(moved)) continue;
    if (moved.mean > alignment.best) {
      alignment.best = moved.mean;
      alignment.best_x = moved.dx;
      alignment.best_y = moved.dy;
    }
    if (moved.away() < kAwayPx) continue;
    sum += moved.mean;
    squares += moved.mean * moved.mean;
    ++count;
  }
  alignment.others = sum / count;
  alignment.deviation =
      std::sqrt(std::max(0.0, squares / count - alignment.others * alignment.others));
  return alignment;
}

/// Whether light, air and camera are such that outlines must show, whatever other images do.
bool can_tell(const formats::Image& image) {
  const auto environment = image.record.find("environment");
  if (environment == image.record.end()) return false;
  constexpr double kLowSunDeg = 5;
  constexpr double kClearM = 500;
  constexpr double kBlurPx = 6;
  constexpr double kNoisyIso = 800;
  const nlohmann::json sensor = image.record.value("sensor", nlohmann::json::object());
  return environment->value("sun_elevation_deg", 0.0) > kLowSunDeg &&
         environment->value("visibility_m", 0.0) > kClearM &&
         environment->value("smoke", 0.0) == 0 && environment->value("weather", "") != "rain" &&
         sensor.value("blur_px", 0.0) < kBlurPx && sensor.value("iso", 0.0) <= kNoisyIso &&
         std::abs(sensor.value("ev", 0.0)) < 2;
}

}  // namespace

void AlignmentCheck::add(const Shot& shot) {
  if (shot.pixels.rgb.empty()) return;
  const std::vector<std::uint32_t> labels = label_image(shot);
  for (const bool of_people : {true, false}) {
    const auto& [borders, objects] = count_borders(shot, labels, of_people);
    if (borders.size() < kMinBorders || objects < kMinObjects) continue;
    const Alignment found = align(shot, borders);
    scores_[{shot.image.run, shot.image.camera, of_people}].push_back(
        {shot.image.file, shot.record(), found.score(), found.best_score(), found.best_x,
         found.best_y, can_tell(shot.image), found.is_line});
  }
}

void AlignmentCheck::finish(Findings& findings) const {
  // Outlines that are where the image has edges show that the image is theirs: other outlines
  // of it may be few, or lie in patterns (a wall full of windows), and need not stand out.
  std::set<std::string> confirmed;
  for (const auto& [series, scores] : scores_) {
    for (const Score& score : scores) {
      const int away = std::max(std::abs(score.best_x), std::abs(score.best_y));
      if (score.here >= kTellingScore && away <= kNearPx) confirmed.insert(score.file);
    }
  }
  for (const auto& [series, scores] : scores_) {
    std::vector<double> scores_here;
    for (const Score& score : scores) scores_here.push_back(score.here);
    constexpr std::size_t kMinImages = 3;
    const bool others_tell =
        scores.size() >= kMinImages && median(std::move(scores_here)) >= kTellingScore;
    for (const Score& score : scores) {
      if (!others_tell && (!score.can_tell || confirmed.contains(score.file))) continue;
      const int away = std::max(std::abs(score.best_x), std::abs(score.best_y));
      const bool is_elsewhere = away > kNearPx && score.best > 1.1 * score.here;
      if (!is_elsewhere && score.here >= (score.is_line ? kMinScoreOfLine : kMinScore)) continue;
      findings.add("image-is-labels", score.file, score.record,
                   fmt::format("the outlines of {} have no edges in the image: {:.1f} standard "
                               "deviations above other places, best {:.1f} at ({}, {}) px",
                               std::get<2>(series) ? "people" : "buildings, props and ground",
                               score.here, score.best, score.best_x, score.best_y));
    }
  }
}

}  // namespace throng::checks
