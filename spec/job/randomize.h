// The block "randomize" of a job: fields by their dotted paths ("drones.0.camera.pitch_deg"), each
// with a distribution that is sampled again for every run. Which fields may be named there is what
// the schema marks with x-distribution or x-randomize.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "spec/job/distribution.h"

namespace throng::jobs {

/// A field that differs between runs.
struct RandomField {
  std::string path;     ///< dotted
  std::string pointer;  ///< the same as a JSON pointer
  Quantity quantity;
  Distribution distribution{0};

  /// The field's value in a run.
  nlohmann::json draw(std::uint64_t run_seed) const;
};

/// Reads the block of `job`. Fields that hold distributions themselves (x-distribution) are put
/// into `job` where they belong; the others are returned. Problems carry JSON pointers.
std::vector<RandomField> take_randomize(nlohmann::json& job, std::vector<Problem>& problems);

/// The block, as take_randomize() reads it back.
nlohmann::json to_json(const std::vector<RandomField>& fields);

/// Dotted paths of all fields that may be sampled, with "0" for the place in a list.
std::vector<std::string> random_paths();

/// "/drones/0/camera" as "drones.0.camera".
std::string dotted(const std::string& pointer);

}  // namespace throng::jobs
