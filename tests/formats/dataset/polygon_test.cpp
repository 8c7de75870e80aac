// Polygons filled as training programs fill them: with cv::fillPoly on whole numbers.
#include "formats/dataset/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/compute/random.h"
#include "tests/annotate/rle.h"
#include "tests/formats/dataset_fixture.h"
#include "tests/formats/readers.h"

namespace throng::formats {
namespace {

using PolygonExports = SmallDataset;

Bitmap to_bitmap(const cv::Mat& image) {
  Bitmap mask{0, 0, image.cols, image.rows, {}};
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) mask.set.push_back(image.at<std::uint8_t>(y, x) != 0);
  }
  return mask;
}

cv::Mat filled(const std::vector<cv::Point>& polygon, const cv::Size& size) {
  cv::Mat image = cv::Mat::zeros(size, CV_8U);
  cv::fillPoly(image, std::vector<std::vector<cv::Point>>{polygon}, cv::Scalar(1));
  return image;
}

cv::Mat filled_again(const cv::Mat& image) {
  std::vector<cv::Point> polygon;
  for (const auto& [x, y] : trace_polygon(to_bitmap(image))) polygon.emplace_back(x, y);
  EXPECT_GE(polygon.size(), 3U);
  return filled(polygon, image.size());
}

/// Discs, bars, lines a pixel wide and holes at random, then only the largest piece.
cv::Mat blotch(std::uint64_t seed, bool one_piece) {
  Random random(seed, Stream::appearance, 7);
  cv::Mat image = cv::Mat::zeros(40, 50, CV_8U);
  const auto place = [&] {
    return cv::Point(static_cast<int>(random.below(50)), static_cast<int>(random.below(40)));
  };
  for (int i = 0; i < 6; ++i) cv::line(image, place(), place(), cv::Scalar(1), 1);
  for (int i = 0; i < 4; ++i)
    cv::circle(image, place(), 1 + static_cast<int>(random.below(9)), 1, -1);
  for (int i = 0; i < 4; ++i) cv::circle(image, place(), static_cast<int>(random.below(4)), 0, -1);
  for (int i = 0; i < 120; ++i) image.at<std::uint8_t>(place()) = 0;
  for (int i = 0; i < 15; ++i) image.at<std::uint8_t>(place()) = 1;
  if (!one_piece) return image;
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centers;
  const int count = cv::connectedComponentsWithStats(image, labels, stats, centers, 8);
  int largest = 1;
  for (int i = 2; i < count; ++i) {
    if (stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA)) largest = i;
  }
  cv::Mat piece = (labels == largest) / 255;
  return piece;
}

TEST(Polygon, OpenCvFillsItToTheMaskOfOnePiece) {
  int holes = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const cv::Mat mask = blotch(seed, true);
    ASSERT_EQ(cv::countNonZero(filled_again(mask) != mask), 0) << "seed " << seed;
    cv::Mat background;
    holes += cv::connectedComponents(mask == 0, background, 4) > 2 ? 1 : 0;
  }
  EXPECT_GT(holes, 1000);
}

TEST(Polygon, SmallestMasksComeBack) {
  // Every pattern of 3 x 4 pixels that hangs together.
  for (unsigned bits = 1; bits < 1U << 12; ++bits) {
    cv::Mat mask = cv::Mat::zeros(6, 6, CV_8U);
    for (unsigned i = 0; i < 12; ++i) {
      mask.at<std::uint8_t>(static_cast<int>(1 + i / 3), static_cast<int>(1 + i % 3)) =
          bits >> i & 1U;
    }
    cv::Mat labels;
    if (cv::connectedComponents(mask, labels, 8) != 2) continue;
    ASSERT_EQ(cv::countNonZero(filled_again(mask) != mask), 0) << bits;
  }
}

TEST(Polygon, PiecesAreJoinedByNoMoreThanTheyBring) {
  double sum = 0;
  constexpr int kMasks = 500;
  for (std::uint64_t seed = 0; seed < kMasks; ++seed) {
    const cv::Mat mask = blotch(seed, false);
    const cv::Mat again = filled_again(mask);
    const double both = cv::countNonZero(again & mask);
    const double either = cv::countNonZero(again | mask);
    cv::Mat labels;
    cv::Mat stats;
    cv::Mat centers;
    const int count = cv::connectedComponentsWithStats(mask, labels, stats, centers, 8);
    int largest = 0;
    for (int i = 1; i < count; ++i) {
      largest = std::max(largest, stats.at<int>(i, cv::CC_STAT_AREA));
    }
    EXPECT_GE(both, largest);
    EXPECT_GE(both / either, largest / static_cast<double>(cv::countNonZero(mask)) - 1e-9)
        << "no worse than the largest piece alone, seed " << seed;
    sum += both / either;
  }
  EXPECT_GT(sum / kMasks, 0.9);
}

TEST(Polygon, SaysHowWellItFitsAMaskOfSeveralPieces) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(4, Stream::crowd_generator, i);
    cv::Mat image = cv::Mat::zeros(60, 80, CV_8U);
    const int discs = 1 + static_cast<int>(random.uniform(0, 5));
    for (int k = 0; k < discs; ++k) {
      cv::circle(image,
                 {static_cast<int>(random.uniform(0, 80)), static_cast<int>(random.uniform(0, 60))},
                 static_cast<int>(random.uniform(0, 9)), cv::Scalar(1), cv::FILLED);
    }
    PolygonFit fit;
    std::vector<cv::Point> polygon;
    for (const auto& [x, y] : trace_polygon(to_bitmap(image), &fit)) polygon.emplace_back(x, y);
    const cv::Mat again = filled(polygon, image.size());
    cv::Mat labels;
    EXPECT_EQ(fit.pieces, cv::connectedComponents(image, labels) - 1);
    EXPECT_EQ(fit.mask_px, cv::countNonZero(image));
    const double iou =
        static_cast<double>(cv::countNonZero(image & again)) / cv::countNonZero(image | again);
    EXPECT_GE(iou, fit.iou() - 1e-9);
    EXPECT_LE(iou, fit.iou() + 0.03);
  }
}

TEST(Polygon, NoMaskNoPolygon) { EXPECT_TRUE(trace_polygon(Bitmap{}).empty()); }

// As Ultralytics does: shares times the image's size, cut off to whole numbers; others round.
TEST_F(PolygonExports, YoloLabelsFillToTheMasks) {
  const std::filesystem::path out = exported("yolo-segment");
  int exact = 0;
  int all = 0;
  double sum = 0;
  for (const auto& [stem, people] : people_by_stem(coco())) {
    const auto lines = read_lines(out / "labels/train" / (stem + ".txt"));
    ASSERT_EQ(lines.size(), people.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::vector<double> line = parse_numbers(lines[i]);
      ASSERT_GE(line.size(), 7U);
      ASSERT_EQ(line.size() % 2, 1U);
      std::vector<cv::Point> cut;
      std::vector<cv::Point> rounded;
      for (std::size_t p = 1; p < line.size(); p += 2) {
        const auto x = static_cast<float>(line[p]) * 160;
        const auto y = static_cast<float>(line[p + 1]) * 120;
        cut.emplace_back(static_cast<int>(x), static_cast<int>(y));
        rounded.emplace_back(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
      }
      EXPECT_EQ(cut, rounded);
      const auto expected = annotate::mask_of_runs(
          annotate::runs_of_counts(people[i].at("segmentation").at("counts")), 160, 120);
      const cv::Mat found = filled(cut, {160, 120});
      int both = 0;
      int either = 0;
      for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
          const bool is = expected[static_cast<std::size_t>(y) * 160 + static_cast<std::size_t>(x)];
          const bool was = found.at<std::uint8_t>(y, x) != 0;
          both += is && was ? 1 : 0;
          either += is || was ? 1 : 0;
        }
      }
      exact += both == either ? 1 : 0;
      sum += static_cast<double>(both) / either;
      ++all;
    }
  }
  EXPECT_GT(all, 60);
  EXPECT_GT(exact, 9 * all / 10);
  EXPECT_GT(sum / all, 0.97);
}

}  // namespace
}  // namespace throng::formats
