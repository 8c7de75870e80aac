// The block "randomize" of a job: fields by their dotted paths ("drones.0.camera.pitch_deg"), each
// with a distribution that is sampled for every run. It may name the fields that the schema marks
// with x-distribution or x-randomize.
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
  std::string pointer;  ///< the path as a JSON pointer
  Quantity quantity;
  Distribution distribution{0};

  /// Samples the field's value in a run.
  nlohmann::json draw(std::uint64_t run_seed) const;
};

/// Reads the block of `job`. Distributions of fields that may hold one (x-distribution) are moved
/// to these fields in `job`; the other fields are returned. Adds to `problems`, with JSON pointers.
std::vector<RandomField> take_randomize(nlohmann::json& job, std::vector<Problem>& problems);

/// The block with these fields; the inverse of take_randomize().
nlohmann::json to_json(const std::vector<RandomField>& fields);

/// Dotted paths of all fields that may be sampled, with "0" as every index into a list.
std::vector<std::string> random_paths();

/// A JSON pointer as a dotted path: "/drones/0/camera" becomes "drones.0.camera".
std::string dotted(const std::string& pointer);

}  // namespace throng::jobs
