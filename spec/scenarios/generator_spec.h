// Parameters of a scenario generated from a seed, as jobs and command lines give them.
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

/// Parameters of a generated scenario. Absent ones are sampled from the seed.
struct GeneratorSpec {
  std::string kind = "plaza";  ///< "plaza", "street", "campus" or "block"
  std::uint64_t seed = 1;
  double size_m = 0;              ///< of its longer side, 30 to 200; 0: sampled
  int exits = 0;                  ///< 2 to 8; 0: sampled
  double exit_width_m = 0;        ///< 2 to 12; 0: sampled for each
  double building_density = 0.5;  ///< 0 to 1: how many of the sites for buildings are built up
  double clutter = 0.5;           ///< 0 to 1: density of props
  double demand_per_minute = 20;  ///< people who come in by each exit, above 0
  int people = 0;                 ///< who are there from the start; 0: as many as suit the size
};

/// Reads the object of a job's "scenario": {"generate": ...}. Adds to `problems`; `where` is its
/// pointer.
GeneratorSpec read_generator_spec(const nlohmann::json& value, const std::string& where,
                                  std::vector<Problem>& problems);
nlohmann::json to_json(const GeneratorSpec& spec);

/// A word for files and lists: "plaza_5_" and a number that differs where any parameter does.
std::string generated_name(const GeneratorSpec& spec);

/// The id of the scenario: "generated/" and the word.
std::string generated_scenario_id(const GeneratorSpec& spec);

}  // namespace throng::scenarios
