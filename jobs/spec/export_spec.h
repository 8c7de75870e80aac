// What a job says of other formats: which, how runs are split, who is worth a label, what classes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "base/error.h"
#include "jobs/spec/spec.h"

namespace throng::jobs {

/// Reads the fields of a job's `outputs`, which the schema has allowed; adds what is wrong with
/// them to `problems`. Whether the formats exist is checked by resolve().
void read_exports(const nlohmann::json& outputs, int runs, OutputSpec& spec,
                  std::vector<Problem>& problems);

/// The same fields with every default.
nlohmann::json exports_json(const OutputSpec& spec);

}  // namespace throng::jobs
