// Contributions of each kind of ground truth to a run's output. One table; those to each frame are
// written by annotate/frame_writers.h.
#pragma once

#include <span>
#include <vector>

#include "jobs/queue/dataset/publication.h"
#include "metrics/exits/exits.h"
#include "spec/annotate/ground_truth.h"
#include "spec/job/spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::jobs {

/// A run on its way into the dataset.
struct RunOutput {
  const JobSpec& job;
  int run = 0;
  const world::Scenario& scenario;
  const world::Trace& trace;
  const std::vector<metrics::ExitSeries>& exits;
  Publication& publication;
};

struct RunWriter {
  annotate::GroundTruth kind{};
  void (*write)(RunOutput& output) = nullptr;
};

/// In the order of the kinds. Kinds that are not here have no part in a run's output.
std::span<const RunWriter> run_writers();

}  // namespace throng::jobs
