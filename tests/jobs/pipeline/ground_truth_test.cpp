// Every kind of ground truth of the table is written and checked by code that is registered for it.
#include "spec/annotate/ground_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "annotate/frame_writers.h"
#include "checks/ground_truth_checks.h"
#include "formats/export/exporter.h"
#include "jobs/pipeline/frames/run_writers.h"
#include "spec/job/spec.h"

namespace throng::jobs {
namespace {

using annotate::GroundTruth;
using nlohmann::json;

template <typename Rows>
std::multiset<GroundTruth> kinds_in(const Rows& rows) {
  std::multiset<GroundTruth> kinds;
  for (const auto& row : rows) kinds.insert(row.kind);
  return kinds;
}

TEST(GroundTruthTables, EveryKindIsWritten) {
  const auto of_frames = kinds_in(annotate::frame_writers());
  const auto of_runs = kinds_in(run_writers());
  for (const annotate::GroundTruthKind& kind : annotate::ground_truth_kinds()) {
    EXPECT_LE(of_frames.count(kind.kind), 1U) << kind.name;
    EXPECT_LE(of_runs.count(kind.kind), 1U) << kind.name;
    // The shard writes the COCO records of what the renderer measures.
    if (kind.kind == GroundTruth::coco || kind.kind == GroundTruth::vehicles) continue;
    EXPECT_GE(of_frames.count(kind.kind) + of_runs.count(kind.kind), 1U)
        << "nothing writes " << kind.name;
  }
}

TEST(GroundTruthTables, EveryKindWithFilesOfItsOwnIsChecked) {
  const auto checked = kinds_in(checks::ground_truth_checkers());
  for (const annotate::GroundTruthKind& kind : annotate::ground_truth_kinds()) {
    const bool is_record = kind.file == ground_truth_kind(GroundTruth::coco).file;
    EXPECT_EQ(checked.contains(kind.kind), !is_record) << kind.name;
  }
}

TEST(GroundTruthTables, TheJobSchemaListsTheKinds) {
  const json rules = job_schema().at("/properties/outputs/properties/annotations"_json_pointer);
  json names = json::array();
  json defaults = json::array();
  for (const annotate::GroundTruthKind& kind : annotate::ground_truth_kinds()) {
    names.push_back(kind.name);
    if (kind.is_default) defaults.push_back(kind.name);
  }
  EXPECT_EQ(rules["items"]["enum"], names);
  EXPECT_EQ(rules["maxItems"], names.size());
  EXPECT_EQ(rules["default"], defaults);
  EXPECT_EQ(rules["description"], annotate::ground_truth_help());
}

TEST(GroundTruthTables, NamesAndFoldersAreUnique) {
  std::set<std::string_view> names;
  std::map<std::string_view, std::string_view> folders;
  for (const annotate::GroundTruthKind& kind : annotate::ground_truth_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(annotate::find_kind(kind.name), &ground_truth_kind(kind.kind));
    const auto [folder, is_new] = folders.emplace(ground_truth_folder(kind), kind.file);
    EXPECT_TRUE(is_new || folder->second == kind.file) << kind.name;
  }
  EXPECT_EQ(annotate::find_kind("cocoa"), nullptr);
}

TEST(GroundTruthTables, FilesAreNamedByRunCameraAndFrame) {
  EXPECT_EQ(ground_truth_file(GroundTruth::depth, "run007", "d1", 12),
            "depth/run007/d1/000012.png");
  EXPECT_EQ(ground_truth_file(GroundTruth::fields, "run007", "d1", 12), "fields/run007/000012.npy");
  EXPECT_EQ(ground_truth_file(GroundTruth::exits, "run007"), "exits/run007.csv");
  EXPECT_EQ(ground_truth_file(GroundTruth::coco, "run007"), "annotations/instances.json");
  // Ids of drones are letters, digits, '_' and '-': also such words.
  EXPECT_EQ(ground_truth_file(GroundTruth::flow, "run000", "RUN-CAMERA_FRAME", 3),
            "flow/run000/RUN-CAMERA_FRAME/000003.png");
}

TEST(GroundTruthTables, TheRendererIsAskedForTheBuffersOfTheKinds) {
  const auto needs = [](std::vector<std::string> names) { return annotate::render_needs(names); };
  EXPECT_FALSE(needs({"coco", "depth", "instances"}).parts);
  EXPECT_TRUE(needs({"parts"}).parts);
  EXPECT_TRUE(needs({"coco", "normals"}).normals);
  EXPECT_TRUE(needs({"flow"}).flow);
  EXPECT_TRUE(needs({"coco", "amodal"}).whole_masks);
  EXPECT_TRUE(needs({"coco", "skeletons"}).bone_turns);
  EXPECT_FALSE(needs({"coco", "keypoints"}).bone_turns);
  EXPECT_FALSE(needs({"amodal"}).whole_masks) << "whole masks are part of the records";
}

}  // namespace
}  // namespace throng::jobs
