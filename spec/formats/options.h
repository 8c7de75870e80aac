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

/// Whole runs go to one split: frames of one run resemble each other too much to be apart.
struct SplitOptions {
  /// Shares of the runs, in their order; at most 1 in all, and scaled to that if they are less.
  /// Each split begins at the run that the shares before it round to.
  std::array<double, 3> share = {1, 0, 0};
  /// Runs that are asked for by name ("run003"); the others are shared out.
  std::map<std::string, Split> runs;
};

/// Gives training what the others leave, unless its share is given, and adds to `problems` shares
/// that are none or more than everything. `where` says where they stand.
void settle_shares(bool has_train, const std::string& where, SplitOptions& splits,
                   std::vector<Problem>& problems);

/// People that get a label. The rest become ignore regions if a format has them.
struct FilterOptions {
  double min_visibility = 0;
  double min_height_px = 0;
  std::optional<double> max_truncation = std::nullopt;  ///< share outside of the image; none: any
  /// CIELAB difference to the surroundings, in the mean or along the outline (`difficulty`).
  double min_contrast = 0;
};

/// Classes by a property that people have; "none": everybody is a person.
struct ClassOptions {
  std::string by = "none";
  std::map<std::string, std::string> names;  ///< other names for values of that property
};

struct WebDatasetOptions {
  double shard_mb = 1000;  ///< 10^6 bytes that a tar file may reach before the next is begun
};

struct ExportOptions {
  SplitOptions splits;
  FilterOptions filters;
  ClassOptions classes;
  WebDatasetOptions webdataset;
};

/// Values of a property, in a fixed order; they are the classes. Empty for an unknown property.
std::vector<std::string> class_values(std::string_view property);
/// "female=woman": another name for a value of the property. Throws InputError naming `where`.
void add_class_name(const std::string& text, const std::string& where, ClassOptions& classes);
/// "none", "sex", "age_band", "state", "carries".
std::vector<std::string_view> class_properties();

}  // namespace throng::formats
