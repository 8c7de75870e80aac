#include "annotate/frame_writers.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "annotate/people/decimals.h"
#include "annotate/people/difficulty.h"
#include "annotate/people/head_labels.h"
#include "annotate/people/keypoints.h"
#include "annotate/rasters/density.h"
#include "annotate/rasters/png.h"
#include "annotate/rasters/zone_counts.h"
#include "base/graphics/images/jpeg_file.h"

namespace throng::annotate {

namespace {

// The heads of the people in the labels, in box coordinates, as the records have them: one at the
// image's border is inside for both or for none.
std::vector<Eigen::Vector2d> head_positions(const FrameLabels& labels,
                                            const camera::Camera& camera) {
  std::vector<Eigen::Vector2d> heads;
  for (const PersonLabel& label : labels.people) {
    const std::optional<Eigen::Vector2d> head = render::head_in(label.person, camera);
    if (!head) continue;
    heads.emplace_back(rounded(head->x(), kPixelDecimals), rounded(head->y(), kPixelDecimals));
  }
  return heads;
}

void write_keypoints(FrameOutput& output) { add_keypoints(output.frame, output.labels); }

void write_skeletons(FrameOutput& output) { add_joints(output.frame, output.labels); }

void write_actions(FrameOutput& output) {
  if (output.actions != nullptr) add_actions(*output.actions, output.frame.time_s, output.labels);
}

void write_amodal(FrameOutput& output) { output.record.whole_masks = true; }

void write_difficulty(FrameOutput& output) {
  const images::JpegFile file(output.jpeg, output.record.file_name);
  const std::vector<std::uint8_t> rgb = file.decode(TJPF_RGB, /*strict=*/true);
  add_difficulty(output.frame, {file.width(), file.height(), rgb}, output.labels);
  output.lap("difficulty");
}

void write_heads(FrameOutput& output) { add_heads(output.frame, output.labels); }

void write_occluders(FrameOutput& output) { add_occluders(output.frame, output.labels); }

void write_density(FrameOutput& output) {
  const int width = output.frame.width();
  const int height = output.frame.height();
  const std::vector<Eigen::Vector2d> heads = head_positions(output.labels, output.frame.camera);
  output.record.density_file = output.ground_truth_file(GroundTruth::density);
  output.add(output.record.density_file,
             npz_bytes(density_map(heads, width, height, output.density_sigma_px)));
  output.record.density_count =
      std::count_if(heads.begin(), heads.end(), [&](const Eigen::Vector2d& head) {
        return head.x() >= 0 && head.y() >= 0 && head.x() < width && head.y() < height;
      });
  output.lap("density");
}

void write_exits(FrameOutput& output) {
  if (output.exits == nullptr) return;
  output.record.exits = output.exits->json(output.frame.camera, output.frame.time_s);
}

void write_hazards(FrameOutput& output) {
  if (output.hazards == nullptr) return;
  output.record.hazards = output.hazards->json(output.frame.camera);
  for (PersonLabel& label : output.labels.people) {
    label.danger = output.hazards->danger(label.agent, label.person.position.head<2>());
  }
}

void write_counts(FrameOutput& output) {
  if (output.zones == nullptr) return;
  output.record.zones = visible_in_zones(output.labels, *output.zones);
}

template <GroundTruth kind, std::string (*png)(const render::Frame&)>
void write_raster(FrameOutput& output) {
  const std::string bytes = png(output.frame);
  output.lap("png");
  output.add(output.ground_truth_file(kind), bytes);
  output.lap("write");
}

constexpr std::array kWriters = {
    FrameWriter{GroundTruth::keypoints, write_keypoints},
    FrameWriter{GroundTruth::skeletons, write_skeletons},
    FrameWriter{GroundTruth::actions, write_actions},
    FrameWriter{GroundTruth::amodal, write_amodal},
    FrameWriter{GroundTruth::difficulty, write_difficulty},
    FrameWriter{GroundTruth::heads, write_heads},
    FrameWriter{GroundTruth::occluders, write_occluders},
    FrameWriter{GroundTruth::density, write_density},
    FrameWriter{GroundTruth::exits, write_exits},
    FrameWriter{GroundTruth::hazards, write_hazards},
    FrameWriter{GroundTruth::counts, write_counts},
    FrameWriter{GroundTruth::depth, write_raster<GroundTruth::depth, depth_png>},
    FrameWriter{GroundTruth::instances, write_raster<GroundTruth::instances, instance_png>},
    FrameWriter{GroundTruth::parts, write_raster<GroundTruth::parts, part_png>},
    FrameWriter{GroundTruth::normals, write_raster<GroundTruth::normals, normal_png>},
    FrameWriter{GroundTruth::flow, write_raster<GroundTruth::flow, flow_png>},
    FrameWriter{GroundTruth::flow_backward,
                write_raster<GroundTruth::flow_backward, flow_backward_png>},
    FrameWriter{GroundTruth::flow_occlusion,
                write_raster<GroundTruth::flow_occlusion, flow_occlusion_png>},
    FrameWriter{GroundTruth::scene_flow, write_raster<GroundTruth::scene_flow, scene_flow_png>},
    FrameWriter{GroundTruth::hazard_opacity,
                write_raster<GroundTruth::hazard_opacity, hazard_opacity_png>},
    FrameWriter{GroundTruth::semantic, write_raster<GroundTruth::semantic, semantic_png>},
};

}  // namespace

std::string FrameOutput::ground_truth_file(GroundTruth kind) const {
  return annotate::ground_truth_file(kind, record.run, record.camera_id, record.frame_index);
}

std::span<const FrameWriter> frame_writers() { return kWriters; }

}  // namespace throng::annotate
