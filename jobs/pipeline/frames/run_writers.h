// Table of the kinds of ground truth that write files per run. annotate/frame_writers.h has those
// that write per frame.
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

/// A run and the publication that receives its files.
struct RunOutput {
  const JobSpec& job;
  int run = 0;
  const world::Scenario& scenario;
  const world::Trace& trace;
  const std::vector<metrics::ExitSeries>& exits;
  Publication& publication;
};

/// A row of the table: the function that adds the files of a kind.
struct RunWriter {
  annotate::GroundTruth kind{};
  void (*write)(RunOutput& output) = nullptr;
};

/// The table, in the order of the kinds; other kinds write nothing per run.
std::span<const RunWriter> run_writers();

}  // namespace throng::jobs
