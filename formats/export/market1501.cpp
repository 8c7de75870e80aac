// Market-1501 (Zheng et al. 2015): crops of people for re-identification across cameras, divided
// into training, queries and the gallery that these are searched in. Crops are named when a run is
// over: which of them are queries depends on all cameras.
#include <fmt/format.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/compute/random.h"
#include "base/files/files.h"
#include "base/graphics/images/jpeg_file.h"
#include "base/graphics/images/jpeg_writer.h"
#include "formats/dataset/reid_attributes.h"
#include "formats/dataset/reid_identities.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

// Defaults of filters that are not given: smaller or more hidden people show little of
// themselves.
constexpr double kMinCropHeightPx = 32;
constexpr double kMinCropVisibility = 0.5;
constexpr double kMaxCropTruncation = 0.25;
/// A person with less visible than is asked for, but at least this share, is junk in the gallery,
/// which counts neither as found nor as missed.
constexpr double kMinJunkVisibility = 0.2;

constexpr int kCropQuality = 95;  ///< of JPEG

/// Numbers that Market's files use for what is no identity.
constexpr int kDistractor = 0;
constexpr int kJunk = -1;

/// Limits of Market's own data that readers of it check.
constexpr std::size_t kMarketCameras = 6;
constexpr std::size_t kMarketIdentities = 1501;

constexpr std::string_view kTrainFolder = "bounding_box_train";
constexpr std::string_view kGalleryFolder = "bounding_box_test";
constexpr std::string_view kQueryFolder = "query";

/// Pixels [x, x + width) x [y, y + height) of an image.
struct CropBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The whole body, as far as it is in the image, in whole pixels.
CropBox crop_box(const Image& image, const Box& whole) {
  const auto low = [](double value, int size) {
    return static_cast<int>(std::clamp(std::floor(value), 0.0, static_cast<double>(size)));
  };
  const auto high = [](double value, int size) {
    return static_cast<int>(std::clamp(std::ceil(value), 0.0, static_cast<double>(size)));
  };
  const int x = low(whole.x, image.width);
  const int y = low(whole.y, image.height);
  return {x, y, high(whole.x + whole.width, image.width) - x,
          high(whole.y + whole.height, image.height) - y};
}

struct Crop {
  CropBox box;
  std::string_view folder;
  int number = 0;  ///< of the identity, or kDistractor or kJunk
  std::int64_t track_id = 0;
  double visibility = 0;
};

/// The crops of an image of the run.
struct CroppedImage {
  std::string file;
  std::int64_t frame = 0;
  std::string camera_id;
  int camera = 0;  ///< its number, from 1
  std::vector<Crop> crops;
};

std::vector<std::uint8_t> cut(const std::vector<std::uint8_t>& rgb, int width, const CropBox& box) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height));
  for (int y = box.y; y < box.y + box.height; ++y) {
    const auto begin = rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * width + box.x);
    pixels.insert(pixels.end(), begin, begin + 3 * static_cast<std::ptrdiff_t>(box.width));
  }
  return pixels;
}

class Market1501Exporter : public Exporter {
 public:
  Market1501Exporter(const DatasetInfo& info, Output output)
      : info_(info),
        output_(std::move(output)),
        identities_(info.seed),
        crops_csv_(output_.open("crops.csv")),
        attributes_csv_(output_.open("attributes.csv")) {
    const std::vector<Split> splits = info.splits();
    has_train_ = std::find(splits.begin(), splits.end(), Split::train) != splits.end();
    has_test_ = splits.size() > (has_train_ ? 1U : 0U);
    crops_csv_.write("file,image,x,y,width,height,run,camera,track_id,visibility\n");
    attributes_csv_.write(reid_attribute_columns());
  }

  void add(const Image& image) override {
    if (image.run != run_) write_run();
    run_ = image.run;
    const auto next_camera = static_cast<int>(cameras_.size()) + 1;
    const int camera = cameras_.try_emplace(image.camera, next_camera).first->second;
    CroppedImage cropped{image.file, image.frame, image.camera, camera, {}};
    for (const Person& person : image.people) add_crop(image, person, cropped);
    if (!cropped.crops.empty()) images_.push_back(std::move(cropped));
  }

  void finish() override {
    write_run();
    crops_csv_.close();
    attributes_csv_.close();
  }

  std::vector<Problem> warnings() const override {
    std::vector<Problem> warnings;
    const auto warn = [&](std::string found, std::string expected) {
      warnings.push_back({"", "market1501", std::move(found), std::move(expected)});
    };
    if (queries_ == 0) {
      warn("nobody for the test is seen by two cameras: there is no query",
           "two or more cameras that see the same people, near enough for crops");
    }
    if (train_crops_ == 0 && has_train_) {
      warn("no crop to train with", "larger or less hidden people, or lower filters");
    }
    if (cameras_.size() > kMarketCameras) {
      warn(fmt::format("{} cameras", cameras_.size()),
           "up to 6, which Market-1501 has; some of its readers refuse more");
    }
    if (identities_.count() > kMarketIdentities) {
      warn(fmt::format("{} identities", identities_.count()),
           "up to 1501, which Market-1501 has; some of its readers refuse more");
    }
    return warnings;
  }

 private:
  enum class Use : std::uint8_t { none, train, test, distractor };

  /// Training needs runs of train, the test those of val and test, if there are both; else all runs
  /// are for both. People of the one side are never used for the other, but as distractors.
  Use use_of(ReidSide side, Split split) const {
    if (!has_train_) return Use::test;
    const bool is_for_training = side == ReidSide::train;
    if (!has_test_) return is_for_training ? Use::train : Use::test;
    if (split == Split::train) return is_for_training ? Use::train : Use::none;
    return is_for_training ? Use::distractor : Use::test;
  }

  /// Whether a crop is large and whole enough.
  bool is_usable(const Person& person, const CropBox& box) const {
    const FilterOptions& filters = info_.options.filters;
    const double min_height_px =
        filters.min_height_px > 0 ? filters.min_height_px : kMinCropHeightPx;
    return person.amodal.height >= min_height_px && box.height >= min_height_px && box.width > 0 &&
           person.truncation <= filters.max_truncation.value_or(kMaxCropTruncation);
  }

  void add_crop(const Image& image, const Person& person, CroppedImage& cropped) {
    const FilterOptions& filters = info_.options.filters;
    const double min_visibility =
        filters.min_visibility > 0 ? filters.min_visibility : kMinCropVisibility;
    const bool is_hidden = person.visibility < min_visibility;
    const CropBox box = crop_box(image, person.amodal);
    if (!is_usable(person, box) || (person.is_ignored && !is_hidden)) return;
    const ReidSide side = identities_.side_for(person);
    const Use use = use_of(side, image.split);
    if (use == Use::none || (use == Use::train && is_hidden)) return;
    Crop crop{box, kGalleryFolder, kDistractor, person.track_id, person.visibility};
    if (is_hidden) {
      if (person.visibility < kMinJunkVisibility) return;
      crop.number = kJunk;
    } else if (use != Use::distractor) {
      const bool is_train = use == Use::train;
      const auto [number, is_new] = identities_.number_of(person);
      if (is_new) {
        attributes_csv_.write(
            reid_attribute_line(number, is_train ? ReidSide::train : ReidSide::test, person));
      }
      crop.number = number;
      if (is_train) crop.folder = kTrainFolder;
      train_crops_ += is_train ? 1 : 0;
    }
    cropped.crops.push_back(crop);
  }

  /// One query for each camera and identity, as long as the gallery keeps an image of another
  /// camera for each of them. All others stay in the gallery.
  void choose_queries() {
    std::map<int, std::map<int, std::vector<Crop*>>> by_camera;  // of each identity
    for (CroppedImage& image : images_) {
      for (Crop& crop : image.crops) {
        if (crop.number <= 0 || crop.folder != kGalleryFolder) continue;
        by_camera[crop.number][image.camera].push_back(&crop);
      }
    }
    for (auto& [number, cameras] : by_camera) choose_queries_of(number, cameras);
  }

  void choose_queries_of(int number, std::map<int, std::vector<Crop*>>& cameras) {
    std::size_t left = 0;  // in the gallery
    for (const auto& [camera, crops] : cameras) left += crops.size();
    std::map<int, std::size_t> last_crop_of;  // by camera, of those with a query
    for (auto& [camera, crops] : cameras) {
      if (queried_.contains({number, camera})) continue;
      last_crop_of[camera] = crops.size() - 1;
      const bool is_found = std::all_of(last_crop_of.begin(), last_crop_of.end(),
                                        [&](const auto& entry) { return left - 1 > entry.second; });
      if (!is_found) {
        last_crop_of.erase(camera);
        continue;
      }
      --left;
      constexpr std::uint64_t kQueries = std::uint64_t{1} << 45;
      constexpr std::uint64_t kMaxCameras = 1000;
      Random drawing(info_.seed, Stream::participants,
                     kQueries + kMaxCameras * static_cast<std::uint64_t>(number) +
                         static_cast<std::uint64_t>(camera));
      crops[drawing.below(static_cast<std::uint32_t>(crops.size()))]->folder = kQueryFolder;
      queried_.insert({number, camera});
      ++queries_;
    }
  }

  void write_run() {
    choose_queries();
    for (const CroppedImage& image : images_) write_crops(image);
    images_.clear();
  }

  void write_crops(const CroppedImage& image) {
    const std::string bytes = read_file(info_.root / image.file);
    const images::JpegFile jpeg(bytes, (info_.root / image.file).string());
    const std::vector<std::uint8_t> rgb = jpeg.decode(TJPF_RGB, /*strict=*/true);
    const auto run = std::find(info_.runs.begin(), info_.runs.end(), run_) - info_.runs.begin();
    std::map<int, int> written;  // by number: distractors and junk come more than once
    for (const Crop& crop : image.crops) {
      const std::string number = crop.number == kJunk ? "-1" : fmt::format("{:04}", crop.number);
      const std::string name =
          fmt::format("{}/{}_c{}s{}_{:06}_{:02}.jpg", crop.folder, number, image.camera, run + 1,
                      image.frame, written[crop.number]++);
      const CropBox& box = crop.box;
      output_.write(name, images::jpeg_bytes(cut(rgb, jpeg.width(), box), box.width, box.height,
                                             kCropQuality));
      crops_csv_.write(fmt::format("{},{},{},{},{},{},{},{},{},{}\n", name, image.file, box.x,
                                   box.y, box.width, box.height, run_, image.camera_id,
                                   crop.track_id, crop.visibility));
    }
  }

  const DatasetInfo& info_;
  Output output_;
  ReidIdentities identities_;
  OutputStream crops_csv_;
  OutputStream attributes_csv_;
  bool has_train_ = false;
  bool has_test_ = false;  ///< runs of val or test
  std::string run_;
  std::vector<CroppedImage> images_;       ///< of the run
  std::map<std::string, int> cameras_;     ///< numbers from 1
  std::set<std::pair<int, int>> queried_;  ///< identity and camera
  std::size_t queries_ = 0;
  std::size_t train_crops_ = 0;
};

}  // namespace

ExporterPointer make_market1501(const DatasetInfo& info, Output output) {
  return std::make_unique<Market1501Exporter>(info, std::move(output));
}

}  // namespace throng::formats
