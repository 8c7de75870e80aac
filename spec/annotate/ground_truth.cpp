#include "spec/annotate/ground_truth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/error.h"

namespace throng::annotate {

namespace {

constexpr std::string_view kCocoPath = "annotations/instances.json";

constexpr std::array kKinds = {
    GroundTruthKind{.kind = GroundTruth::coco,
                    .name = "coco",
                    .help = "boxes, masks, cameras, activity and appearance of people",
                    .file = kCocoPath,
                    .is_default = true},
    GroundTruthKind{.kind = GroundTruth::keypoints,
                    .name = "keypoints",
                    .help = "COCO's 17 of each person in the image and in the world, with coco",
                    .file = kCocoPath,
                    .content = "keypoints, keypoints_3d",
                    .in_coco = true},
    GroundTruthKind{.kind = GroundTruth::skeletons,
                    .name = "skeletons",
                    .help = "33 joints of each person, turns of 21 bones and gaze, with coco",
                    .file = kCocoPath,
                    .content = "joints, joints_3d, bone_turns, gaze",
                    .needs = {.bone_turns = true},
                    .in_coco = true},
    GroundTruthKind{.kind = GroundTruth::actions,
                    .name = "actions",
                    .help = "of each person over the run, with times, and in images; members of "
                            "groups who are together",
                    .file = "actions/RUN.csv",
                    .content = "a row per person and stretch of time"},
    GroundTruthKind{.kind = GroundTruth::amodal,
                    .name = "amodal",
                    .help = "masks of whole people, with coco",
                    .file = kCocoPath,
                    .content = "amodal_segmentation",
                    .needs = {.whole_masks = true},
                    .in_coco = true},
    GroundTruthKind{.kind = GroundTruth::vehicles,
                    .name = "vehicles",
                    .help = "boxes, masks and 3-D boxes of cars and trains, with coco",
                    .file = kCocoPath,
                    .content = "categories car and train",
                    .needs = {.vehicles = true},
                    .in_coco = true},
    GroundTruthKind{.kind = GroundTruth::difficulty,
                    .name = "difficulty",
                    .help = "contrast, blur and visible keypoints of each person, with coco",
                    .file = kCocoPath,
                    .content = "difficulty",
                    .in_coco = true},
    GroundTruthKind{.kind = GroundTruth::heads,
                    .name = "heads",
                    .help = "box and visible share of each person's head, with coco",
                    .file = kCocoPath,
                    .content = "head_box, head_visibility",
                    .needs = {.whole_masks = true},
                    .in_coco = true},
    GroundTruthKind{.kind = GroundTruth::occluders,
                    .name = "occluders",
                    .help = "what hides each person and how much of them, with coco",
                    .file = kCocoPath,
                    .content = "occluded_by",
                    .needs = {.whole_masks = true},
                    .in_coco = true},
    GroundTruthKind{.kind = GroundTruth::density,
                    .name = "density",
                    .help = "crowd density maps",
                    .file = "density/RUN/CAMERA/FRAME.npz",
                    .content = "people per pixel, float32: array \"density\"",
                    .is_default = true},
    GroundTruthKind{.kind = GroundTruth::exits,
                    .name = "exits",
                    .help = "counts and clogging index per exit and frame",
                    .file = "exits/RUN.csv",
                    .is_default = true},
    GroundTruthKind{.kind = GroundTruth::hazards,
                    .name = "hazards",
                    .help = "place and reach of each disaster, danger to each person, with coco",
                    .file = kCocoPath,
                    .content = "hazards, danger",
                    .in_coco = true},
    GroundTruthKind{.kind = GroundTruth::fields,
                    .name = "fields",
                    .help = "density and velocity on the ground, per frame",
                    .file = "fields/RUN/FRAME.npy",
                    .content = "people per square metre, velocity, Voronoi density; grid in "
                               "fields/RUN.json"},
    GroundTruthKind{.kind = GroundTruth::counts,
                    .name = "counts",
                    .help = "people in zones and across lines since the frame before, with "
                            "identities",
                    .file = "counts/RUN.csv",
                    .content = "a row per frame, zone and line; their places in counts/RUN.json"},
    GroundTruthKind{.kind = GroundTruth::trajectories,
                    .name = "trajectories",
                    .help = "everybody's, seen or not",
                    .file = "trajectories/RUN.npy",
                    .content = "x, y, heading and state of everybody at the times of the frames; "
                               "times and track ids in trajectories/RUN.json"},
    GroundTruthKind{.kind = GroundTruth::events,
                    .name = "events",
                    .help = "escapes, falls, collisions, notices, with time, place and person",
                    .file = "events/RUN.jsonl",
                    .content = "a JSON object for each event, by time"},
    GroundTruthKind{.kind = GroundTruth::depth,
                    .name = "depth",
                    .extent = Extent::pixel,
                    .file = "depth/RUN/CAMERA/FRAME.png",
                    .content = "centimeters, 16 bits, 0 beyond 655.35 m"},
    GroundTruthKind{.kind = GroundTruth::instances,
                    .name = "instances",
                    .extent = Extent::pixel,
                    .file = "instances/RUN/CAMERA/FRAME.png",
                    .content = "red + 256 green + 65536 blue"},
    GroundTruthKind{.kind = GroundTruth::parts,
                    .name = "parts",
                    .help = "of the body",
                    .extent = Extent::pixel,
                    .file = "parts/RUN/CAMERA/FRAME.png",
                    .needs = {.parts = true}},
    GroundTruthKind{.kind = GroundTruth::normals,
                    .name = "normals",
                    .extent = Extent::pixel,
                    .file = "normals/RUN/CAMERA/FRAME.png",
                    .needs = {.normals = true}},
    GroundTruthKind{.kind = GroundTruth::flow,
                    .name = "flow",
                    .help = "motion to the next frame",
                    .extent = Extent::pixel,
                    .file = "flow/RUN/CAMERA/FRAME.png",
                    .content = "KITTI's 16-bit PNG",
                    .needs = {.flow = true}},
    GroundTruthKind{.kind = GroundTruth::flow_backward,
                    .name = "flow_backward",
                    .help = "motion to the previous frame",
                    .extent = Extent::pixel,
                    .file = "flow_backward/RUN/CAMERA/FRAME.png",
                    .content = "KITTI's 16-bit PNG",
                    .needs = {.flow_backward = true}},
    GroundTruthKind{.kind = GroundTruth::flow_occlusion,
                    .name = "flow_occlusion",
                    .help = "whether the next frame shows the same",
                    .extent = Extent::pixel,
                    .file = "flow_occlusion/RUN/CAMERA/FRAME.png",
                    .content = "8 bits: 0 unknown, 1 visible, 2 hidden, 3 outside of the image",
                    .needs = {.flow = true, .flow_depth = true}},
    GroundTruthKind{.kind = GroundTruth::scene_flow,
                    .name = "scene_flow",
                    .help = "motion in the world to the next frame",
                    .extent = Extent::pixel,
                    .file = "scene_flow/RUN/CAMERA/FRAME.png",
                    .content = "16-bit RGB: x, y, z in millimeters + 32768; 0 unknown",
                    .needs = {.flow = true, .flow_depth = true, .scene_flow = true}},
    GroundTruthKind{.kind = GroundTruth::hazard_opacity,
                    .name = "hazard_opacity",
                    .help = "of fire, smoke and gas before what shows",
                    .extent = Extent::pixel,
                    .file = "hazard_opacity/RUN/CAMERA/FRAME.png",
                    .content = "8-bit RGB: fire, smoke and dust, gas; 255 hides all",
                    .needs = {.hazard_opacity = true}},
    GroundTruthKind{.kind = GroundTruth::semantic,
                    .name = "semantic",
                    .help = "the class of the visible surface: road, person, tree, ...",
                    .extent = Extent::pixel,
                    .file = "semantic/RUN/CAMERA/FRAME.png",
                    .content = "8 bits, a number of semantic_classes",
                    .needs = {.semantic = true}},
    GroundTruthKind{.kind = GroundTruth::sensors,
                    .name = "sensors",
                    .help = "a table of their readings and the truth",
                    .extent = Extent::drone,
                    .file = "sensors/RUN/CAMERA.csv"},
};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (static_cast<std::size_t>(kKinds[i].kind) != i) return false;
  }
  return true;
}
static_assert(is_in_order(), "the table has the order of the enumerators");

std::string help_of_extent(Extent extent) {
  std::vector<std::string> parts;
  for (const GroundTruthKind& kind : kKinds) {
    if (kind.extent != extent) continue;
    parts.push_back(kind.help.empty() ? std::string(kind.name)
                                      : fmt::format("{} ({})", kind.name, kind.help));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::span<const GroundTruthKind> ground_truth_kinds() { return kKinds; }

const GroundTruthKind& ground_truth_kind(GroundTruth kind) {
  return kKinds.at(static_cast<std::size_t>(kind));
}

bool needs_images(const GroundTruthKind& kind) {
  return kind.file == kCocoPath || kind.file.find("CAMERA") != std::string_view::npos;
}

const GroundTruthKind* find_kind(std::string_view name) {
  const auto* found = std::find_if(kKinds.begin(), kKinds.end(),
                                   [&](const GroundTruthKind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : found;
}

bool holds(std::span<const std::string> names, GroundTruth kind) {
  return std::find(names.begin(), names.end(), ground_truth_kind(kind).name) != names.end();
}

RenderNeeds render_needs(std::span<const std::string> names) {
  RenderNeeds needs;
  for (const std::string& name : names) {
    const GroundTruthKind* kind = find_kind(name);
    check(kind != nullptr, "the job schema knows the kinds of ground truth");
    if (kind->in_coco && !holds(names, GroundTruth::coco)) continue;
    needs.normals |= kind->needs.normals;
    needs.flow |= kind->needs.flow;
    needs.flow_backward |= kind->needs.flow_backward;
    needs.flow_depth |= kind->needs.flow_depth;
    needs.hazard_opacity |= kind->needs.hazard_opacity;
    needs.scene_flow |= kind->needs.scene_flow;
    needs.parts |= kind->needs.parts;
    needs.semantic |= kind->needs.semantic;
    needs.whole_masks |= kind->needs.whole_masks;
    needs.bone_turns |= kind->needs.bone_turns;
    needs.vehicles |= kind->needs.vehicles;
  }
  return needs;
}

std::vector<std::string> default_ground_truth() {
  std::vector<std::string> names;
  for (const GroundTruthKind& kind : kKinds) {
    if (kind.is_default) names.emplace_back(kind.name);
  }
  return names;
}

std::string ground_truth_help() {
  return fmt::format("Which ground truth is written: {}; per pixel, as PNG: {}; per drone: {}.",
                     help_of_extent(Extent::scene), help_of_extent(Extent::pixel),
                     help_of_extent(Extent::drone));
}

std::string_view ground_truth_folder(const GroundTruthKind& kind) {
  return kind.file.substr(0, kind.file.find('/'));
}

std::string ground_truth_file(GroundTruth kind, std::string_view run, std::string_view camera,
                              std::int64_t frame) {
  std::string file(ground_truth_kind(kind).file);
  const std::string number = fmt::format("{:06}", frame);
  // From the last to the first: a camera's id may hold such a word itself.
  for (const auto& [name, value] : {std::pair<std::string_view, std::string_view>{"FRAME", number},
                                    {"CAMERA", camera},
                                    {"RUN", run}}) {
    if (const auto at = file.find(name); at != std::string::npos) {
      file.replace(at, name.size(), value);
    }
  }
  return file;
}

}  // namespace throng::annotate
