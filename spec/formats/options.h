// Options of exports: splits, filters and classes.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::formats {

enum class Split : std::uint8_t { train, val, test };
inline constexpr std::array<std::string_view, 3> kSplitNames = {"train", "val", "test"};
inline std::string_view to_string(Split split) {
  return kSplitNames.at(static_cast<std::size_t>(split));
}

/// Assignment of runs to splits. A run is never divided, since its frames resemble each other.
struct SplitOptions {
  /// Shares of the runs, by Split. Their sum is above 0 and at most 1; a lesser sum is scaled to 1.
  /// Runs are assigned in their order; each split begins at the run to which the sum of the
  /// previous shares rounds.
  std::array<double, 3> share = {1, 0, 0};
  /// Runs that are assigned by name ("run003"); the others are divided by `share`.
  std::map<std::string, Split> runs;
};

/// Sets the share of training to the remainder unless it is given (`has_train`). Adds a problem
/// with the pointer `where` if the sum of the shares is not above 0 or exceeds 1.
void settle_shares(bool has_train, const std::string& where, SplitOptions& splits,
                   std::vector<Problem>& problems);

/// Conditions for a person to be labeled. The others become ignore regions in formats that have
/// them.
struct FilterOptions {
  double min_visibility = 0;
  double min_height_px = 0;
  /// Share outside of the image; nothing: no limit.
  std::optional<double> max_truncation = std::nullopt;
  /// CIELAB difference from the surroundings, of the mean or along the outline (`difficulty`).
  double min_contrast = 0;
};

/// The property of people that determines their class; "none": all are of the class person.
struct ClassOptions {
  std::string by = "none";
  std::map<std::string, std::string> names;  ///< class names that replace values of the property
};

/// Options of `webdataset` exports.
struct WebDatasetOptions {
  double shard_mb = 1000;  ///< size in 10^6 bytes at which the next tar file is started
};

/// Options of all exports of a dataset.
struct ExportOptions {
  SplitOptions splits;
  FilterOptions filters;
  ClassOptions classes;
  WebDatasetOptions webdataset;
};

/// Values of a property, in a fixed order, which are the classes. Empty for an unknown property.
std::vector<std::string> class_values(std::string_view property);
/// Parses text such as "female=woman", a class name for a value of the property, into `classes`.
/// Throws InputError naming `where`.
void add_class_name(const std::string& text, const std::string& where, ClassOptions& classes);
/// The properties that may determine classes: "none", "sex", "age_band", "state", "carries".
std::vector<std::string_view> class_properties();

}  // namespace throng::formats
