// Parameters of a scenario generated from a seed, as jobs and command lines specify them.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::scenarios {

constexpr std::array<std::string_view, 4> kPlaceKinds = {"plaza", "street", "campus", "block"};

/// Max seed of generated scenarios and of studies.
inline constexpr int kMaxSeed = 1'000'000'000;

/// Parameters of a generated scenario. Those marked "0: sampled" are sampled from the seed if they
/// are 0.
struct GeneratorSpec {
  std::string kind = "plaza";  ///< "plaza", "street", "campus" or "block"
  std::uint64_t seed = 1;
  double size_m = 0;              ///< length of the longer side, 30 to 200; 0: sampled
  int exits = 0;                  ///< 2 to 8; 0: sampled
  double exit_width_m = 0;        ///< 2 to 12; 0: sampled for each exit
  double building_density = 0.5;  ///< 0 to 1: share of the sites for buildings that are built up
  double clutter = 0.5;           ///< 0 to 1: density of props
  double demand_per_minute = 20;  ///< people who enter by each exit per minute, above 0
  int people = 0;                 ///< people present at the start; 0: a number that suits the size
};

/// Reads the object "generate" of a job's "scenario". Adds to `problems`; `where` is the object's
/// JSON pointer.
GeneratorSpec read_generator_spec(const nlohmann::json& value, const std::string& where,
                                  std::vector<Problem>& problems);
nlohmann::json to_json(const GeneratorSpec& spec);

/// A name for files and lists: kind, seed and a number that depends on all parameters
/// ("plaza_5_...").
std::string generated_name(const GeneratorSpec& spec);

/// The id of the scenario: "generated/" followed by generated_name().
std::string generated_scenario_id(const GeneratorSpec& spec);

}  // namespace throng::scenarios
