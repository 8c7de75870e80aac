// The file of a robot, loaded by libsdformat, and the places of its elements for messages.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

#include "base/error.h"
#include "places/imports/parts/imported_scenario.h"
#include "places/imports/sdf/local_files.h"
#include "places/imports/sdf/sdf_text.h"

namespace throng::imports {

/// A loaded description: SDF, with its includes, or URDF, which libsdformat converts.
class RobotSource {
 public:
  /// Throws InputError (file, line) if the file is no robot, if anything of it or of the files that
  /// it includes cannot be read, or if it is a xacro file; and EnvironmentError.
  RobotSource(std::filesystem::path file, const LocalFiles& files);

  const sdf::Model& model() const { return *root_.Model(); }

  /// Names an element that is left out, with its file and line.
  Skipped skipped(const sdf::ElementPtr& element, const std::string& name,
                  const std::string& why) const;
  /// A problem at an element.
  Problem problem(const sdf::ElementPtr& element, const std::string& found,
                  const std::string& expected) const;
  /// Complaints of libsdformat about what does not matter for an airframe.
  const std::vector<Skipped>& complaints() const { return complaints_; }

 private:
  void load_sdf(const std::string& text, const sdf::ParserConfig& config);
  void load_urdf(const std::string& text, const sdf::ParserConfig& config);
  void take_errors(const sdf::Errors& errors);
  std::pair<std::string, int> place_of(const sdf::ElementPtr& element) const;

  std::filesystem::path file_;
  sdf::Root root_;
  std::optional<SdfText> text_;            ///< of an SDF file
  std::map<std::string, int> urdf_lines_;  ///< of a URDF file: lines of the elements with a name
  std::vector<Skipped> complaints_;
};

}  // namespace throng::imports
