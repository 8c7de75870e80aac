// Makes libsdformat find included models in known folders only.
#pragma once

#include <filesystem>
#include <sdf/ParserConfig.hh>

#include "places/imports/sdf/local_files.h"

namespace throng::imports {

/// While it lives, libsdformat looks for what a file includes by LocalFiles: by the parser's
/// configuration, and by its global callback, which it uses for models that included models merge,
/// whatever the configuration says. Only one at a time.
class ModelFinder {
 public:
  /// `files` must outlive this object; `file` is the file that includes.
  ModelFinder(const LocalFiles& files, std::filesystem::path file);
  ~ModelFinder();
  ModelFinder(const ModelFinder&) = delete;
  ModelFinder& operator=(const ModelFinder&) = delete;

  const sdf::ParserConfig& config() const { return config_; }

 private:
  sdf::ParserConfig config_;
};

}  // namespace throng::imports
