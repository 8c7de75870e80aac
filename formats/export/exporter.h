// Export formats: the interface of exporters, the table of formats, and the export of a dataset.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/dataset/dataset.h"
#include "formats/dataset/output.h"

namespace throng::formats {

/// Writes a dataset in one format. Memory must not grow with the number of images.
class Exporter {
 public:
  Exporter() = default;
  virtual ~Exporter() = default;
  Exporter(const Exporter&) = delete;
  Exporter& operator=(const Exporter&) = delete;
  /// Adds an image with its labels; called once for each image, in the dataset's order.
  virtual void add(const Image& image) = 0;
  /// Called once after the last image.
  virtual void finish() = 0;
  /// After finish(): data that programs for this format expect and the dataset lacks.
  virtual std::vector<Problem> warnings() const { return {}; }
};

/// A row of the table of formats.
struct Format {
  std::string_view name;        ///< name in jobs and on the command line; also the folder's name
  std::string_view summary;     ///< one line for lists
  annotate::GroundTruth needs;  ///< required kind of ground truth
  /// Creates an exporter. `info` must outlive it.
  std::unique_ptr<Exporter> (*make)(const DatasetInfo& info, Output output);
  annotate::GroundTruth needs_also = annotate::GroundTruth::coco;  ///< second required kind

  /// Whether it is made of images or their labels, which jobs without drones do not have.
  bool needs_images() const;
};

/// The table of all formats (format_table.cpp).
std::span<const Format> all_formats();

/// The format with this name; null if there is none.
const Format* find_format(std::string_view name);

/// The formats with these names. Throws InputError for an unknown name, a repeated name, or a
/// format whose required ground truth is not in `annotations`; `where` is the location of the names
/// in the message.
std::vector<const Format*> choose_formats(const std::vector<std::string>& names,
                                          const std::vector<std::string>& annotations,
                                          const std::string& where);

/// Warnings about splits without runs, for formats whose programs expect them.
std::vector<Problem> split_warnings(const DatasetInfo& info,
                                    const std::vector<const Format*>& formats);

/// Writes all formats in one pass over the dataset's labels, if it has any, each to the folder
/// `output`/NAME. `also`, if not null, receives the same images. Returns the formats' warnings.
/// Throws InputError and EnvironmentError.
std::vector<Problem> export_dataset(const DatasetInfo& info,
                                    const std::vector<const Format*>& formats,
                                    const std::filesystem::path& output, Exporter* also = nullptr);

}  // namespace throng::formats
