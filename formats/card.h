// Dataset card: dataset.json for programs and README.md for people.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "formats/export/exporter.h"

namespace throng::formats {

/// Counts images and labels, then writes the description of the dataset.
class DatasetCard : public Exporter {
 public:
  /// `manifest` is the content of manifest.json without the list of files. `info` must outlive this
  /// object.
  DatasetCard(const DatasetInfo& info, nlohmann::json manifest, Output output);

  void add(const Image& image) override;
  /// Writes dataset.json and README.md.
  void finish() override;

 private:
  /// Counts the character of a track at its first annotation.
  void add_character(const Person& person);
  /// The number of annotations of a category other than people.
  std::int64_t count_annotations(int category) const;
  /// Names of the COCO file's categories by id.
  nlohmann::json classes() const;
  nlohmann::json statistics() const;
  nlohmann::json description() const;
  std::string readme() const;

  const DatasetInfo& info_;
  nlohmann::json manifest_;
  Output output_;
  std::int64_t images_ = 0;
  std::int64_t people_ = 0;
  std::map<int, std::int64_t> objects_;  ///< annotations of drones and vehicles, by category
  std::int64_t truncated_ = 0;
  std::int64_t ignored_ = 0;
  std::int64_t max_in_image_ = 0;
  std::map<std::string, std::int64_t> by_height_;
  std::map<std::string, std::int64_t> by_visibility_;
  std::map<std::string, std::int64_t> by_count_;  ///< images by number of people
  std::map<std::string, std::int64_t> by_light_;  ///< images by position of the sun
  std::map<std::string, std::int64_t> by_weather_;
  std::map<std::string, std::int64_t> by_state_;
  std::map<std::string, std::int64_t> by_split_;
  std::set<std::int64_t> tracks_;     ///< tracks whose characters have been counted
  std::set<std::string> characters_;  ///< characters of the library that occur in images
};

}  // namespace throng::formats
