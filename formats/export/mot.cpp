// MOT Challenge and MOTS: a folder per sequence, frames and pixels counted from 1.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "annotate/rasters/png.h"
#include "formats/dataset/mask.h"
#include "formats/export/makers.h"
#include "formats/export/sequences.h"

namespace throng::formats {

namespace fs = std::filesystem;

namespace {

constexpr int kPedestrian = 1;
constexpr int kMotsPedestrian = 2;
constexpr int kMotsIgnored = 10;
constexpr int kMotsIgnoredId = 10'000;

std::string sequence_info(const DatasetInfo& info, const Image& image) {
  return fmt::format(
      "[Sequence]\nname={}\nimDir=img1\nframeRate={}\nseqLength={}\nimWidth={}\nimHeight={}\n"
      "imExt=.jpg\n",
      image.sequence(), info.rate_hz, info.frames_per_camera, image.width, image.height);
}

/// Common to MOT and MOTS: the folders of a sequence, its images and its text.
class SequenceExporter : public Exporter {
 public:
  SequenceExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), texts_(output_) {}

  void add(const Image& image) override {
    const std::string folder = fmt::format("{}/{}", to_string(image.split), image.sequence());
    bool is_new = false;
    OutputStream& text = texts_.of(image.run, folder + "/gt/gt.txt", is_new);
    if (is_new && maps_[image.split].insert(image.sequence()).second) {
      output_.write(folder + "/seqinfo.ini", sequence_info(info_, image));
    }
    output_.link(fmt::format("{}/img1/{:06}.jpg", folder, image.frame + 1),
                 info_.root / image.file);
    lines_.clear();
    append(lines_, image);
    text.write(lines_);
    add_files(image, folder);
  }

  /// TrackEval's lists of sequences.
  void finish() override {
    texts_.close();
    for (const auto& [split, sequences] : maps_) {
      std::string text = "name\n";
      for (const std::string& sequence : sequences) text += sequence + "\n";
      output_.write(fmt::format("seqmaps/{}.txt", to_string(split)), text);
    }
  }

 protected:
  virtual void append(std::string& lines, const Image& image) const = 0;
  /// Writes further files of an image, below the sequence's folder.
  virtual void add_files(const Image& image, const std::string& folder) = 0;

  const Output& output() const { return output_; }
  SequenceTexts& texts() { return texts_; }

 private:
  const DatasetInfo& info_;
  Output output_;
  SequenceTexts texts_;
  std::map<Split, std::set<std::string>> maps_;  ///< names of sequences
  std::string lines_;
};

class MotExporter : public SequenceExporter {
  using SequenceExporter::SequenceExporter;

  void append(std::string& lines, const Image& image) const override {
    for (const Person& person : image.people) {
      const Box& box = person.amodal;
      fmt::format_to(std::back_inserter(lines), "{},{},{:.3f},{:.3f},{:.3f},{:.3f},{},{},{:.5f}\n",
                     image.frame + 1, person.number_in_run(), box.x + 1, box.y + 1, box.width,
                     box.height, person.is_ignored ? 0 : 1, kPedestrian, person.visibility);
    }
    append_hidden(lines, image);
  }

  /// MOT's tracks go on where nothing of somebody is visible.
  static void append_hidden(std::string& lines, const Image& image) {
    for (const HiddenPerson& person : image.hidden) {
      const Box& box = person.amodal;
      fmt::format_to(std::back_inserter(lines), "{},{},{:.3f},{:.3f},{:.3f},{:.3f},{},{},0\n",
                     image.frame + 1, person.number_in_run(), box.x + 1, box.y + 1, box.width,
                     box.height, person.is_ignored ? 0 : 1, kPedestrian);
    }
  }

  /// Detections of an ideal detector of the visible parts; the score is the visibility.
  void add_files(const Image& image, const std::string& folder) override {
    std::string lines;
    for (const Person& person : image.people) {
      if (person.is_ignored) continue;
      const Box& box = person.box;
      fmt::format_to(std::back_inserter(lines),
                     "{},-1,{:.0f},{:.0f},{:.0f},{:.0f},{:.5f},-1,-1,-1\n", image.frame + 1,
                     box.x + 1, box.y + 1, box.width, box.height, person.visibility);
    }
    bool is_new = false;
    texts().of(image.run, folder + "/det/det.txt", is_new).write(lines);
  }
};

/// class * 1000 + number; numbers that do not fit get more digits, away from the ignored id.
std::int64_t mots_id(std::int64_t number) {
  constexpr std::int64_t kPerClass = 1000;
  constexpr std::int64_t kMore = 1'000'000;
  return kMotsPedestrian * (number < kPerClass ? kPerClass : kMore) + number;
}

class MotsExporter : public SequenceExporter {
  using SequenceExporter::SequenceExporter;

  void append(std::string& lines, const Image& image) const override {
    const auto pixels =
        static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    std::vector<Bitmap> ignored;
    const auto add = [&](std::int64_t id, int category, const std::string& counts) {
      fmt::format_to(std::back_inserter(lines), "{} {} {} {} {} {}\n", image.frame + 1, id,
                     category, image.height, image.width, counts);
    };
    for (const Person& person : image.people) {
      if (person.is_ignored) {
        ignored.push_back(decode_bitmap(decode_runs(person.mask, pixels), image.height));
      } else {
        add(mots_id(person.number_in_run()), kMotsPedestrian, person.mask);
      }
    }
    if (ignored.empty()) return;
    add(kMotsIgnoredId, kMotsIgnored,
        encode_counts(union_runs(ignored, image.width, image.height)));
  }

  /// The same ids as pixels. Ids beyond 16 bits are ignored there.
  void add_files(const Image& image, const std::string& folder) override {
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t pixels = width * static_cast<std::size_t>(image.height);
    std::vector<std::uint16_t> ids(pixels, 0);
    for (const Person& person : image.people) {
      const std::int64_t id = mots_id(person.number_in_run());
      const bool fits = !person.is_ignored && id <= std::numeric_limits<std::uint16_t>::max();
      const Bitmap mask = decode_bitmap(decode_runs(person.mask, pixels), image.height);
      for (int y = mask.y; y < mask.y + mask.height; ++y) {
        for (int x = mask.x; x < mask.x + mask.width; ++x) {
          if (!mask.at(x, y)) continue;
          ids[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] =
              static_cast<std::uint16_t>(fits ? id : kMotsIgnoredId);
        }
      }
    }
    output().write(fmt::format("{}/instances/{:06}.png", folder, image.frame + 1),
                   annotate::png_bytes({image.width, image.height, 1}, ids));
  }
};

}  // namespace

ExporterPointer make_mot(const DatasetInfo& info, Output output) {
  return std::make_unique<MotExporter>(info, std::move(output));
}

ExporterPointer make_mots(const DatasetInfo& info, Output output) {
  return std::make_unique<MotsExporter>(info, std::move(output));
}

}  // namespace throng::formats
