#include "calibration/board.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "base/compute/parallel.h"
#include "base/files/files.h"

namespace throng::calibrate {

namespace {

/// Images are searched at most this large; corners are refined in the whole image.
constexpr int kSearchSide = 1400;

cv::Mat wrapped(const images::GrayImage& image) {
  // OpenCV has no view of constant pixels; nothing here writes to it.
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())};
}

double smallest_spacing(const std::vector<cv::Point2f>& corners, int columns) {
  double min_distance_px = INFINITY;
  const auto distance = [&](std::size_t a, std::size_t b) {
    return std::hypot(corners[a].x - corners[b].x, corners[a].y - corners[b].y);
  };
  const auto width = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if ((i + 1) % width != 0)
      min_distance_px = std::min<double>(min_distance_px, distance(i, i + 1));
    if (i + width < corners.size())
      min_distance_px = std::min<double>(min_distance_px, distance(i, i + width));
  }
  return min_distance_px;
}

/// `clear_px`: how far from a corner there is nothing but its own edges.
void refine(const cv::Mat& image, double clear_px, std::vector<cv::Point2f>& corners) {
  constexpr int kMaxHalfWindowPx = 11;
  constexpr int kMaxSteps = 100;
  constexpr double kPrecise = 1e-4;
  const int half = std::clamp(static_cast<int>(clear_px), 2, kMaxHalfWindowPx);
  cv::cornerSubPix(
      image, corners, cv::Size(half, half), cv::Size(-1, -1),
      cv::TermCriteria(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, kMaxSteps, kPrecise));
}

/// The image as it is searched, and how much smaller it is.
struct Reduced {
  cv::Mat image;
  double scale = 1;
};

Reduced reduced(const cv::Mat& image) {
  const int side = std::max(image.cols, image.rows);
  if (side <= kSearchSide) return {image, 1};
  Reduced small;
  small.scale = static_cast<double>(kSearchSide) / side;
  cv::resize(image, small.image, {}, small.scale, small.scale, cv::INTER_AREA);
  return small;
}

std::optional<cv::Size> size_of_any_chessboard(const cv::Mat& small) {
  std::vector<cv::Point2f> corners;
  cv::Mat meta;
  const bool found = cv::findChessboardCornersSB(
      small, cv::Size(3, 3), corners,
      cv::CALIB_CB_LARGER | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE, meta);
  return found ? std::optional(meta.size()) : std::nullopt;
}

std::variant<View, Problem> no_board(const std::string& name, const Board& board,
                                     std::string found) {
  return Problem{name, "", std::move(found),
                 fmt::format("a {} of {} x {}{}", to_string(board.kind), board.columns, board.rows,
                             board.kind == Board::Kind::chessboard ? " inner corners" : "")};
}

View make_view(const std::string& name, const std::vector<Eigen::Vector3d>& points,
               const std::vector<cv::Point2f>& pixels) {
  View view{name, points, {}};
  for (const cv::Point2f& p : pixels) view.pixels.emplace_back(p.x, p.y);
  return view;
}

std::variant<View, Problem> find_chessboard(const cv::Mat& image, const Board& board,
                                            const std::string& name) {
  const cv::Size size(board.columns, board.rows);
  const Reduced small = reduced(image);
  std::vector<cv::Point2f> corners;
  bool found = cv::findChessboardCorners(
      small.image, size, corners, cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE);
  if (!found) {
    found = cv::findChessboardCornersSB(small.image, size, corners,
                                        cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE);
  }
  // One threshold for the whole image finds slanted boards before an even background, which the
  // others miss.
  if (!found) found = cv::findChessboardCorners(small.image, size, corners, 0);
  // A part of a larger board looks like a smaller one.
  const std::optional<cv::Size> there = size_of_any_chessboard(small.image);
  const bool fits = there && ((there->width == size.width && there->height == size.height) ||
                              (there->width == size.height && there->height == size.width));
  // An apparent extra row may be a shadow at the border, and an apparent board a crowd: the other
  // method has to find it, too.
  std::vector<cv::Point2f> others;
  const bool is_other = there && !fits && (!found || there->area() > size.area()) &&
                        cv::findChessboardCorners(small.image, *there, others);
  if (is_other) {
    return no_board(
        name, board,
        fmt::format("a chessboard of {} x {} inner corners", std::max(there->width, there->height),
                    std::min(there->width, there->height)));
  }
  if (!found) return no_board(name, board, "no chessboard");
  for (cv::Point2f& corner : corners) {
    // Pixels are counted from their middles.
    corner = (corner + cv::Point2f(0.5F, 0.5F)) / static_cast<float>(small.scale) -
             cv::Point2f(0.5F, 0.5F);
  }
  // Wider than nearly half a square, a window contains the next corner, too, and is attracted by
  // it.
  constexpr double kClearShare = 0.45;
  refine(image, kClearShare * smallest_spacing(corners, board.columns), corners);
  return make_view(name, board_points(board), corners);
}

std::variant<View, Problem> find_circles(const cv::Mat& image, const Board& board,
                                         const std::string& name) {
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> centers;
  bool found = cv::findCirclesGrid(image, size, centers, cv::CALIB_CB_ASYMMETRIC_GRID);
  if (!found) {
    found = cv::findCirclesGrid(image, size, centers,
                                cv::CALIB_CB_ASYMMETRIC_GRID | cv::CALIB_CB_CLUSTERING);
  }
  if (!found) return no_board(name, board, "no such grid of circles");
  return make_view(name, board_points(board), centers);
}

cv::Ptr<cv::aruco::Dictionary> marker_dictionary(const Board& board) {
  const auto* found = std::find(kDictionaries.begin(), kDictionaries.end(), board.dictionary);
  check(found != kDictionaries.end(), "boards are checked before they are looked for");
  // OpenCV numbers them in this order.
  return cv::aruco::getPredefinedDictionary(static_cast<int>(found - kDictionaries.begin()));
}

double marker_size_m(const Board& board) {
  constexpr double kUsual = 0.75;
  return board.marker > 0 ? board.marker : kUsual * board.square;
}

std::variant<View, Problem> find_charuco(const cv::Mat& image, const Board& board,
                                         const std::string& name) {
  const auto pattern = cv::aruco::CharucoBoard::create(
      board.columns, board.rows, static_cast<float>(board.square),
      static_cast<float>(marker_size_m(board)), marker_dictionary(board));
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(image, pattern->dictionary, markers, ids);
  if (ids.empty()) {
    return no_board(name, board, fmt::format("no marker of {}", board.dictionary));
  }
  std::vector<cv::Point2f> corners;
  std::vector<int> corner_ids;
  cv::aruco::interpolateCornersCharuco(markers, ids, image, pattern, corners, corner_ids);
  if (corners.size() < kMinPoints) {
    return no_board(name, board,
                    fmt::format("{} markers and {} corners", ids.size(), corners.size()));
  }
  // OpenCV 4.6 refines them, and counts from the pixel's corner. The markers must stay outside.
  double spacing = INFINITY;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    spacing = std::min<double>(
        spacing, std::hypot(corners[i].x - corners[i - 1].x, corners[i].y - corners[i - 1].y));
  }
  refine(image, 0.5 * (1 - marker_size_m(board) / board.square) * spacing, corners);
  std::vector<Eigen::Vector3d> points;
  points.reserve(corner_ids.size());
  for (const int id : corner_ids) {
    points.push_back(board_points(board)[static_cast<std::size_t>(id)]);
  }
  return make_view(name, points, corners);
}

std::variant<View, Problem> view_in(const std::filesystem::path& file, const Board& board,
                                    ImageSize& size) {
  if (std::filesystem::is_directory(file)) {
    return Problem{file.string(), "", "a folder", "images, such as " + (file / "*.jpg").string()};
  }
  try {
    const images::GrayImage image = images::read_gray_image(file);
    size = {image.width, image.height};
    return find_board(image, board, file.string());
  } catch (const InputError& error) {
    return error.problems().front();
  } catch (const EnvironmentError& error) {
    return Problem{file.string(), "", error.what(), "an image that can be read"};
  }
}

ImageSize most_frequent(const std::vector<ImageSize>& sizes) {
  ImageSize best;
  std::ptrdiff_t max_times = 0;
  for (const ImageSize& size : sizes) {
    const auto times = std::count(sizes.begin(), sizes.end(), size);
    if (size.width > 0 && times > max_times) {
      max_times = times;
      best = size;
    }
  }
  return best;
}

}  // namespace

void check_board(const Board& board, const std::string& source) {
  const auto refuse = [&](std::string found, std::string expected) {
    throw InputError(Problem{source, "", std::move(found), std::move(expected)});
  };
  if (std::min(board.columns, board.rows) < kMinBoardSide ||
      std::max(board.columns, board.rows) > kMaxBoardSide) {
    refuse(fmt::format("a board of {} x {}", board.columns, board.rows),
           fmt::format("{} to {} columns and rows", kMinBoardSide, kMaxBoardSide));
  }
  if (!(board.square > 0) || !(board.marker >= 0 && board.marker < board.square)) {
    refuse(fmt::format("squares of {} with markers of {}", board.square, board.marker),
           "squares larger than 0, and markers smaller than squares");
  }
  if (board.kind == Board::Kind::charuco && std::find(kDictionaries.begin(), kDictionaries.end(),
                                                      board.dictionary) == kDictionaries.end()) {
    refuse(fmt::format("the dictionary \"{}\"", board.dictionary),
           fmt::format("one of: {}", fmt::join(kDictionaries, ", ")));
  }
  constexpr int kMarkersOfFewest = 50;
  if (board.kind == Board::Kind::charuco) {
    const int capacity = marker_dictionary(board)->bytesList.rows;
    if (board.columns * board.rows / 2 > std::max(capacity, kMarkersOfFewest)) {
      refuse(fmt::format("{} markers", board.columns * board.rows / 2),
             fmt::format("a dictionary with as many; {} has {}", board.dictionary, capacity));
    }
  }
}

std::vector<Eigen::Vector3d> board_points(const Board& board) {
  std::vector<Eigen::Vector3d> points;
  const int less = board.kind == Board::Kind::charuco ? 1 : 0;
  for (int row = 0; row < board.rows - less; ++row) {
    for (int column = 0; column < board.columns - less; ++column) {
      const Eigen::Vector3d steps = board.kind == Board::Kind::circles
                                        ? Eigen::Vector3d(2 * column + row % 2, row, 0)
                                        : Eigen::Vector3d(column + less, row + less, 0);
      points.push_back(board.square * steps);
    }
  }
  return points;
}

std::variant<View, Problem> find_board(const images::GrayImage& image, const Board& board,
                                       const std::string& name) {
  try {
    const cv::Mat pixels = wrapped(image);
    if (board.kind == Board::Kind::charuco) return find_charuco(pixels, board, name);
    if (board.kind == Board::Kind::circles) return find_circles(pixels, board, name);
    return find_chessboard(pixels, board, name);
  } catch (const cv::Exception& error) {
    return no_board(name, board, fmt::format("an image that OpenCV cannot decode ({})", error.err));
  }
}

Correspondences find_boards(const std::vector<std::filesystem::path>& images, const Board& board,
                            const std::function<bool(std::size_t)>& on_image) {
  if (images.empty()) throw InputError(Problem{"images", "", "none", "images of a board"});
  std::vector<std::variant<View, Problem>> found(images.size());
  std::vector<ImageSize> sizes(images.size());
  std::mutex mutex;
  std::size_t done = 0;
  bool should_continue = true;
  parallel_ranges(images.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      {
        const std::lock_guard lock(mutex);
        if (!should_continue) return;
      }
      found[i] = view_in(images[i], board, sizes[i]);
      const std::lock_guard lock(mutex);
      if (on_image && !on_image(++done)) should_continue = false;
    }
  });
  if (!should_continue) throw Cancelled();
  Correspondences all;
  all.size = most_frequent(sizes);
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (const auto* problem = std::get_if<Problem>(&found[i])) {
      all.left_out.push_back(*problem);
    } else if (!(sizes[i] == all.size)) {
      all.left_out.push_back(
          {images[i].string(), "", fmt::format("{} x {} pixels", sizes[i].width, sizes[i].height),
           fmt::format("{} x {}, as the other images", all.size.width, all.size.height)});
    } else {
      all.views.push_back(std::move(std::get<View>(found[i])));
    }
  }
  leave_out_bad_views(all);
  if (all.views.empty()) throw InputError(all.left_out);
  return all;
}

}  // namespace throng::calibrate
