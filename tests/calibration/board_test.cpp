// Boards found in images: real ones, and rendered ones whose corners are known.
#include "calibration/board.h"
#include "base/files/resources.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/files/files.h"
#include "calibration/intrinsics.h"

namespace throng::calibrate {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

images::GrayImage to_gray(const cv::Mat& image) {
  return {image.cols, image.rows, {image.datastart, image.dataend}};
}

/// A flat image seen askew: 900 x 700 pixels with noise of the lens's blur.
struct Askew {
  cv::Mat homography;
  images::GrayImage image;
};

Askew askew(const cv::Mat& flat, double shift = 0) {
  const std::vector<cv::Point2f> from = {
      {0, 0},
      {static_cast<float>(flat.cols), 0},
      {static_cast<float>(flat.cols), static_cast<float>(flat.rows)},
      {0, static_cast<float>(flat.rows)}};
  const auto s = static_cast<float>(shift);
  const std::vector<cv::Point2f> to = {
      {100 + s, 90}, {790, 140 + s}, {760 - s, 610}, {130, 560 - s}};
  Askew result;
  result.homography = cv::getPerspectiveTransform(from, to);
  cv::Mat large;
  cv::warpPerspective(flat, large, result.homography, cv::Size(900, 700), cv::INTER_AREA,
                      cv::BORDER_CONSTANT, cv::Scalar(255));
  cv::GaussianBlur(large, large, cv::Size(5, 5), 0.8);
  result.image = to_gray(large.clone());
  return result;
}

/// Projection of a point of the flat image (pixels from its corner).
Eigen::Vector2d seen(const Askew& askew, double x, double y) {
  // The middle of a pixel is half a pixel from its corner, on both sides.
  std::vector<cv::Point2d> to;
  cv::perspectiveTransform(std::vector<cv::Point2d>{{x - 0.5, y - 0.5}}, to, askew.homography);
  return {to[0].x, to[0].y};
}

cv::Mat flat_chessboard(int columns, int rows, int square) {
  cv::Mat flat((rows + 3) * square, (columns + 3) * square, CV_8UC1, cv::Scalar(255));
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      if ((row + column) % 2 != 0) continue;
      cv::rectangle(flat, cv::Rect((column + 1) * square, (row + 1) * square, square, square),
                    cv::Scalar(0), cv::FILLED);
    }
  }
  return flat;
}

const View& view_in(const std::variant<View, Problem>& found) {
  const auto* problem = std::get_if<Problem>(&found);
  if (problem != nullptr) throw std::runtime_error(problem->text());
  return std::get<View>(found);
}

TEST(Board, ChessboardsAreFoundToATenthOfAPixel) {
  for (const int square : {20, 40}) {  // small ones, too, where a wide window would be wrong
    const cv::Mat flat = flat_chessboard(9, 6, square);
    const Askew photo = askew(flat);
    Board board;
    board.square = 0.025;
    const auto found = find_board(photo.image, board, "drawn");
    const View& view = view_in(found);
    ASSERT_EQ(view.pixels.size(), 54U);
    EXPECT_NEAR(view.points[10].x(), 0.025, 1e-12);
    EXPECT_NEAR(view.points[10].y(), 0.025, 1e-12);
    // OpenCV may count from either end.
    const bool turned = (view.pixels[0] - seen(photo, 2 * square, 2 * square)).norm() > 30;
    for (std::size_t i = 0; i < view.pixels.size(); ++i) {
      const auto at = turned ? 53 - i : i;
      const double x = (2 + static_cast<double>(at % 9)) * square;
      const double y = (2 + static_cast<double>(at / 9)) * square;
      EXPECT_LT((view.pixels[i] - seen(photo, x, y)).norm(), 0.1) << i;
    }
  }
}

TEST(Board, AWrongSizeIsNamed) {
  const Askew photo = askew(flat_chessboard(9, 6, 40));
  for (const auto& [columns, rows] : {std::pair(7, 5), std::pair(8, 6), std::pair(11, 8)}) {
    Board board;
    board.columns = columns;
    board.rows = rows;
    const auto found = find_board(photo.image, board, "drawn");
    ASSERT_TRUE(std::holds_alternative<Problem>(found)) << columns;
    EXPECT_THAT(std::get<Problem>(found).text(), HasSubstr("9 x 6 inner corners")) << columns;
  }
}

TEST(Board, ImagesOfAnotherSizeThanMostAreLeftOut) {
  const fs::path folder = fs::temp_directory_path() / "throng_board_sizes";
  fs::create_directories(folder);
  Board board;
  board.columns = 9;
  board.rows = 6;
  const cv::Mat drawn = flat_chessboard(9, 6, 40);
  cv::Mat smaller;
  cv::resize(drawn, smaller, {}, 0.8, 0.8, cv::INTER_AREA);
  std::vector<fs::path> files;
  for (const char* name : {"a.png", "b.png", "odd.png", "c.png"}) {
    files.push_back(folder / name);
    cv::imwrite(files.back().string(), std::string_view(name) == "odd.png" ? smaller : drawn);
  }
  const Correspondences found = find_boards(files, board);
  fs::remove_all(folder);
  EXPECT_EQ(found.views.size(), 3U);
  ASSERT_EQ(found.left_out.size(), 1U);
  EXPECT_THAT(found.left_out[0].text(), HasSubstr("odd.png"));
  EXPECT_THAT(found.left_out[0].text(),
              HasSubstr(fmt::format("{} x {}", smaller.cols, smaller.rows)));
}

TEST(Board, AnEmptyImageHasNone) {
  const images::GrayImage empty{640, 480, std::vector<std::uint8_t>(640 * 480, 128)};
  for (const auto kind : {Board::Kind::chessboard, Board::Kind::charuco, Board::Kind::circles}) {
    Board board;
    board.kind = kind;
    EXPECT_TRUE(std::holds_alternative<Problem>(find_board(empty, board, "empty")));
  }
}

// Windows, stones and people have corners in rows, too.
TEST(Board, ImagesOfCrowdsHaveNone) {
  for (const char* name : {"docs/weather.jpg", "docs/scenarios/concert.jpg", "docs/labels.jpg",
                           "docs/scenarios/station.jpg"}) {
    const auto found = find_board(images::read_gray_image(source_folder() / name), {}, name);
    ASSERT_TRUE(std::holds_alternative<Problem>(found)) << name;
    EXPECT_THAT(std::get<Problem>(found).text(), HasSubstr("no chessboard")) << name;
  }
}

TEST(Board, CharucoBoardsAreFoundByTheirCornersNames) {
  Board board;
  board.kind = Board::Kind::charuco;
  board.columns = 7;
  board.rows = 5;
  board.square = 0.04;
  board.marker = 0.03;
  const auto drawn = cv::aruco::CharucoBoard::create(
      7, 5, 0.04F, 0.03F, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50));
  cv::Mat flat;
  drawn->draw(cv::Size(700, 500), flat, 0);
  const Askew photo = askew(flat);
  const auto found = find_board(photo.image, board, "drawn");
  const View& view = view_in(found);
  ASSERT_EQ(view.pixels.size(), 24U);
  double worst = 0;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    const double x = view.points[i].x() / 0.04 * 100;
    const double y = view.points[i].y() / 0.04 * 100;
    worst = std::max(worst, (view.pixels[i] - seen(photo, x, y)).norm());
  }
  EXPECT_LT(worst, 0.3);
}

TEST(Board, CirclesAreFound) {
  Board board;
  board.kind = Board::Kind::circles;
  board.columns = 4;
  board.rows = 11;
  board.square = 0.02;
  cv::Mat flat(13 * 60, 10 * 60, CV_8UC1, cv::Scalar(255));
  for (const Eigen::Vector3d& point : board_points(board)) {
    cv::circle(flat,
               cv::Point(static_cast<int>(90 + point.x() / 0.02 * 60),
                         static_cast<int>(90 + point.y() / 0.02 * 60)),
               20, cv::Scalar(0), cv::FILLED, cv::LINE_AA);
  }
  const Askew photo = askew(flat);
  const auto found = find_board(photo.image, board, "drawn");
  EXPECT_EQ(view_in(found).pixels.size(), 44U);
}

TEST(Board, ImpossibleOnesAreRefused) {
  Board board;
  board.columns = 2;
  EXPECT_THROW(check_board(board, "--board"), InputError);
  board = {};
  board.square = -1;
  EXPECT_THROW(check_board(board, "--board"), InputError);
  board = {};
  board.kind = Board::Kind::charuco;
  board.dictionary = "9X9_50";
  EXPECT_THROW(check_board(board, "--board"), InputError);
  EXPECT_THROW(board_kind_named("checkers", "--board"), InputError);
}

class RealBoards : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(folder())) GTEST_SKIP() << "no images beside the sources";
    for (const auto& entry : fs::directory_iterator(folder())) images_.push_back(entry.path());
    std::sort(images_.begin(), images_.end());
    base_ = fs::temp_directory_path() / ("throng_boards_" + std::to_string(::getpid()));
    fs::create_directories(base_);
  }
  void TearDown() override {
    if (!base_.empty()) fs::remove_all(base_);
  }
  static fs::path folder() {
    const char* shared = std::getenv("THRONG_SHARED");
    const fs::path root =
        shared != nullptr ? fs::path(shared) : source_folder().parent_path() / "shared";
    return root / "data" / "calib" / "chess";
  }
  std::vector<fs::path> images_;
  fs::path base_;
};

TEST_F(RealBoards, CornersAreThoseOfTheReference) {
  const Correspondences found = find_boards(images_, {});
  const Correspondences wanted =
      read_correspondences(folder().parent_path() / "corners_left.csv", {640, 480});
  EXPECT_EQ(found.size, wanted.size);
  for (const Problem& problem : found.left_out) ADD_FAILURE() << problem.text();
  ASSERT_EQ(found.views.size(), wanted.views.size());
  for (std::size_t v = 0; v < found.views.size(); ++v) {
    EXPECT_EQ(fs::path(found.views[v].name).filename(), wanted.views[v].name);
    for (std::size_t i = 0; i < found.views[v].pixels.size(); ++i) {
      EXPECT_LT((found.views[v].pixels[i] - wanted.views[v].pixels[i]).norm(), 0.05)
          << wanted.views[v].name << ' ' << i;
    }
  }
  const Calibration camera = calibrate_intrinsics(found, {});
  EXPECT_NEAR(camera.parameters[kFx], 533.966, 0.05);
  EXPECT_NEAR(camera.rms_px, 0.24497, 1e-3);
}

TEST_F(RealBoards, BadImagesAreLeftOutOneByOne) {
  write_file_atomically(base_ / "broken.jpg", "no image at all");
  std::ofstream(base_ / "empty.png");
  const std::vector<fs::path> few = {images_[0],           images_[1],          images_[2],
                                     base_ / "broken.jpg", base_ / "empty.png", base_ / "gone.jpg"};
  const Correspondences found = find_boards(few, {});
  EXPECT_EQ(found.views.size(), 3U);
  ASSERT_EQ(found.left_out.size(), 3U);
  EXPECT_THAT(found.left_out[0].text(), HasSubstr("broken.jpg"));
  EXPECT_THAT(found.left_out[2].text(), HasSubstr("gone.jpg"));
}

TEST_F(RealBoards, AWrongBoardIsNamedForEveryImage) {
  Board board;
  board.columns = 7;
  try {
    find_boards({images_[0], images_[3]}, board);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 2U);
    EXPECT_THAT(error.what(), HasSubstr("9 x 6 inner corners"));
  }
}

TEST_F(RealBoards, TheSearchCanBeCancelled) {
  EXPECT_THROW(find_boards(images_, {}, [](std::size_t) { return false; }), Cancelled);
}

}  // namespace
}  // namespace throng::calibrate
