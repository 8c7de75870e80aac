#include "annotate/people_sheet/height_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "skinning/wardrobe/person.h"

namespace throng::annotate {

namespace {

constexpr int kSampled = 4000;
constexpr double kAdultFrom = 18;  // years
// Range of the axis and its bins.
constexpr double kMinHeightM = 1.36;
constexpr double kMaxHeightM = 2.04;
constexpr double kBinWidth = 0.02;
constexpr std::size_t kBins = 34;

const std::array<cv::Scalar, 2> kColors = {cv::Scalar(196, 92, 60), cv::Scalar(48, 104, 158)};

struct Adult {
  double height_m;
  double lost_m;  // to age
};

// Adults by sex; women first.
std::array<std::vector<Adult>, 2> sampled_adults(std::uint64_t seed) {
  std::array<std::vector<Adult>, 2> adults;
  for (int i = 0; i < kSampled; ++i) {
    const skinning::PersonSpec person = skinning::sample_person(seed, i);
    if (person.age_years < kAdultFrom) continue;
    adults[person.male ? 1 : 0].push_back(
        {person.height_m, skinning::height_lost_m(person.male, person.age_years)});
  }
  return adults;
}

// Expected share of adults per meter, given how much each has lost.
double density(const std::vector<Adult>& adults, bool male, double height_m) {
  const skinning::AdultHeights norm = skinning::adult_heights(male);
  double sum = 0;
  for (const Adult& adult : adults) {
    const double z = (height_m - norm.mean_m + adult.lost_m) / norm.sd_m;
    sum += std::exp(-0.5 * z * z);
  }
  const double area = norm.sd_m * std::sqrt(2 * std::numbers::pi);
  return sum / (area * static_cast<double>(adults.size()));
}

class Chart {
 public:
  explicit Chart(cv::Mat image)
      : image_(std::move(image)),
        scale_(image_.rows / 320.0),
        left_(px(30)),
        right_(image_.cols - px(30)),
        bottom_(image_.rows - px(52)),
        top_(px(20)) {}

  int px(double size) const { return static_cast<int>(std::lround(size * scale_)); }
  int x_of(double height_m) const {
    const double share = (height_m - kMinHeightM) / (kMaxHeightM - kMinHeightM);
    return static_cast<int>(std::lround(std::lerp(left_, right_, share)));
  }
  int y_of(double per_m) const {
    constexpr double kMaxDensityPerM = 7.2;  // per meter
    return static_cast<int>(std::lround(std::lerp(bottom_, top_, per_m / kMaxDensityPerM)));
  }

  void text(const std::string& words, int x, int y, const cv::Scalar& color) {
    cv::putText(image_, words, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.45 * scale_, color,
                std::max(1, px(1)), cv::LINE_AA);
  }

  void axis() {
    cv::line(image_, {left_, bottom_}, {right_, bottom_}, {60, 60, 60}, std::max(1, px(1)));
    for (int cm = 140; cm <= 200; cm += 10) {
      const int x = x_of(0.01 * cm);
      cv::line(image_, {x, bottom_}, {x, bottom_ + px(5)}, {60, 60, 60}, std::max(1, px(1)));
      text(fmt::format("{:.1f} m", 0.01 * cm), x - px(18), image_.rows - px(10), {60, 60, 60});
    }
  }

  void bars(const std::vector<Adult>& adults, bool male) {
    std::array<int, kBins> count{};
    for (const Adult& adult : adults) {
      const double bin = (adult.height_m - kMinHeightM) / kBinWidth;
      if (bin >= 0 && bin < kBins) ++count[static_cast<std::size_t>(bin)];
    }
    cv::Mat filled = image_.clone();
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      const double per_m = count[bin] / (kBinWidth * static_cast<double>(adults.size()));
      const double from_m = kMinHeightM + kBinWidth * static_cast<double>(bin);
      cv::rectangle(filled, {x_of(from_m) + 1, y_of(per_m)},
                    {x_of(from_m + kBinWidth) - 1, bottom_}, kColors[male ? 1 : 0], cv::FILLED);
    }
    cv::addWeighted(filled, 0.45, image_, 0.55, 0, image_);
  }

  void curve(const std::vector<Adult>& adults, bool male) {
    constexpr int kPoints = 137;
    std::vector<cv::Point> points;
    for (int i = 0; i < kPoints; ++i) {
      const double height_m = std::lerp(kMinHeightM, kMaxHeightM, i / (kPoints - 1.0));
      points.emplace_back(x_of(height_m), y_of(density(adults, male, height_m)));
    }
    cv::polylines(image_, points, false, kColors[male ? 1 : 0], std::max(1, px(2)), cv::LINE_AA);
  }

  void tick(double height_m, bool male) {
    if (height_m < kMinHeightM || height_m > kMaxHeightM) return;
    const int x = x_of(height_m);
    cv::line(image_, {x, bottom_ + px(8)}, {x, bottom_ + px(22)}, kColors[male ? 1 : 0],
             std::max(1, px(1)));
  }

  void legend(const std::vector<Adult>& adults, bool male) {
    const skinning::AdultHeights norm = skinning::adult_heights(male);
    double sum = 0;
    double squares = 0;
    for (const Adult& adult : adults) {
      const double height_m = adult.height_m + adult.lost_m;
      sum += height_m;
      squares += height_m * height_m;
    }
    const auto count = static_cast<double>(adults.size());
    const double mean_m = sum / count;
    const double sd_m = std::sqrt(std::max(0.0, squares / count - mean_m * mean_m));
    const int line = male ? 2 : 1;
    text(fmt::format("{}: normal {:.2f} +- {:.3f} m less what age takes; {} sampled have {:.3f} +- "
                     "{:.3f} m before that",
                     male ? "men" : "women", norm.mean_m, norm.sd_m, adults.size(), mean_m, sd_m),
         left_, px(6 + 20 * line), kColors[male ? 1 : 0]);
  }

 private:
  cv::Mat image_;
  double scale_;
  int left_;
  int right_;
  int bottom_;
  int top_;
};

}  // namespace

void draw_height_chart(cv::Mat image, const skinning::Population& population, std::uint64_t seed) {
  image.setTo(cv::Scalar(250, 250, 248));
  const std::array<std::vector<Adult>, 2> adults = sampled_adults(seed);
  Chart chart(image);
  for (const bool male : {false, true}) chart.bars(adults[male ? 1 : 0], male);
  for (const bool male : {false, true}) {
    chart.curve(adults[male ? 1 : 0], male);
    chart.legend(adults[male ? 1 : 0], male);
  }
  chart.axis();
  for (const skinning::Character& who : population.characters) {
    if (who.age_years >= static_cast<float>(kAdultFrom)) chart.tick(who.stature_m, who.male);
  }
}

}  // namespace throng::annotate
