#include "server/routes/resources.h"

namespace throng::server {

namespace {

/// A figure over the runs.
ValueType quartiles() {
  return object({{"median", "number?"}, {"low", "number?"}, {"high", "number?"}});
}

}  // namespace

std::vector<NamedSchema> study_schemas() {
  return {
      {"Study",
       row(words({"queued", "running", "succeeded", "failed", "cancelled"}),
           object({{"stage?", words({"simulating", "summing up", "finished"})},
                   {"runs_done?", "integer"},
                   {"runs_total?", "integer"},
                   {"cells?", "integer[][]", "Numbers of finished runs, per case and policy."},
                   {"remaining_s?", "number?"}}),
           {{"study?", "object?", "The document as it was sent. Not in lists."},
            {"plan?", "StudyPlan"},
            {"summary?", "StudySummary?"}})},
      {"StudyList", object({{"studies", "Study[]"}, {"next", "string?"}})},
      {"StudyPlan",
       object({{"name", "string"},
               {"seed", "integer"},
               {"runs", "integer", "Number of runs of each case and policy."},
               {"baseline", "string", "The policy that others are compared with."},
               {"cases", list(object({{"id", "string"},
                                      {"title", "string"},
                                      {"scenario", "string"},
                                      {"duration_s", "number"},
                                      {"horizons_s", "number[]"}}))},
               {"policies", list(object({{"id", "string"}, {"title", "string"}}))},
               {"simulations", "integer", "Number of all simulations."},
               {"people", "integer", "Maximum number of people at the beginning of a run."},
               {"memory_mib", "integer", "Estimated memory of the largest simulation, MiB."},
               {"valid?", constant(true)}})},
      {"StudySummary",
       object(
           {{"name", "string"},
            {"seed", "integer"},
            {"generator", "string"},
            {"baseline", "string"},
            {"took_s?", "number", "Time that it took to make a summary of unfinished runs, s."},
            {"rows",
             list(object(
                 {{"case", "string"},
                  {"policy", "string"},
                  {"runs", "integer"},
                  {"times", map(quartiles()), "Median and quartiles of t25_s to t99_s."},
                  {"all_out", "integer"},
                  {"not_escaped", "number"},
                  {"casualties", "number"},
                  {"restricted_means",
                   list(object({{"until_s", "number"},
                                {"restricted_mean_s", quartiles()},
                                {"mean_s", "number?"},
                                {"inside", "number"},
                                {"ratio_to_baseline", "number?"},
                                {"difference_s", "number?"},
                                {"difference_95_s", "number?[]"},
                                {"wilcoxon",
                                 object({{"n", "integer"}, {"w_plus", "number"}, {"p", "number"}})},
                                {"holm_p", "number?"}}))},
                  {"t90_to_bound", "number?"},
                  {"mean_to_bound", "number?"},
                  {"t90_to_reference", "number?"},
                  {"mean_to_reference", "number?"},
                  {"followed", "number"},
                  {"left_by_no_exit?", "number",
                   "People who left where there is no exit, mean over the runs; above 0 the "
                   "outline has a gap."},
                  {"exit_use", map("number")}}))}}),
       "The summary, as summary.json of `throng study`, over the runs that every policy of a case "
       "has."},
      {"StudyValues",
       object({{"baseline", "string"},
               {"cases",
                list(object({{"id", "string"},
                             {"horizons_s", "number[]"},
                             {"runs", "integer[]",
                              "Numbers of the runs that every policy of the case has."},
                             {"policies", list(object({{"id", "string"},
                                                       {"means_s", "number?[][]",
                                                        "Restricted means up to either horizon."},
                                                       {"t50_s", "number?[]"},
                                                       {"t90_s", "number?[]"},
                                                       {"t95_s", "number?[]"},
                                                       {"not_escaped", "number?[]"}}))}}))}}),
       "The figures of each run, in the order of `runs`."}};
}

}  // namespace throng::server
