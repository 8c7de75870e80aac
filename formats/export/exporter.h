// A format: a name, what it needs, and an exporter that is fed image by image.
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

/// Writes one format. Images come in the dataset's order; memory must not grow with their number.
class Exporter {
 public:
  Exporter() = default;
  virtual ~Exporter() = default;
  Exporter(const Exporter&) = delete;
  Exporter& operator=(const Exporter&) = delete;
  virtual void add(const Image& image) = 0;
  virtual void finish() = 0;
  /// Once finished: what of the data the format's programs want and the dataset lacks.
  virtual std::vector<Problem> warnings() const { return {}; }
};

struct Format {
  std::string_view name;        ///< what jobs and the command line call it; also its folder
  std::string_view summary;     ///< for lists
  annotate::GroundTruth needs;  ///< what it is made of: coco, or another kind beside it
  /// The info outlives the exporter.
  std::unique_ptr<Exporter> (*make)(const DatasetInfo& info, Output output);
  annotate::GroundTruth needs_also = annotate::GroundTruth::coco;  ///< another kind
};

/// All formats there are: the one table (format_table.cpp).
std::span<const Format> all_formats();

/// The format of this name; null if there is none.
const Format* find_format(std::string_view name);

/// Throws InputError for a name that is none, twice the same, or one whose needs the dataset lacks.
/// `where` says where the names stand, for the message.
std::vector<const Format*> choose_formats(const std::vector<std::string>& names,
                                          const std::vector<std::string>& annotations,
                                          const std::string& where);

/// Warnings about splits without a run: formats whose programs want them.
std::vector<Problem> split_warnings(const DatasetInfo& info,
                                    const std::vector<const Format*>& formats);

/// One pass over the dataset: each format below `output`, in a folder of its name. `also` is fed
/// with them, if given. Gives the formats' warnings.
std::vector<Problem> export_dataset(const DatasetInfo& info,
                                    const std::vector<const Format*>& formats,
                                    const std::filesystem::path& output, Exporter* also = nullptr);

}  // namespace throng::formats
