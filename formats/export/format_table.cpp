#include <algorithm>
#include <array>

#include "formats/export/exporter.h"
#include "formats/export/makers.h"

namespace throng::formats {

using annotate::GroundTruth;

namespace {

constexpr std::array kFormats = {
    Format{"coco", "COCO instances: boxes and RLE masks", GroundTruth::coco, make_coco},
    Format{"coco-keypoints", "COCO person keypoints", GroundTruth::keypoints, make_coco_keypoints},
    Format{"coco-wholebody", "COCO-WholeBody: keypoints of bodies and feet", GroundTruth::skeletons,
           make_coco_wholebody, GroundTruth::keypoints},
    Format{"openpose", "OpenPose: BODY_25 joints, a JSON file per image", GroundTruth::skeletons,
           make_openpose},
    Format{"jta", "JTA: 22 joints in the image and in the camera's frame, tracks",
           GroundTruth::skeletons, make_jta},
    Format{"coco-panoptic", "COCO panoptic: PNG and segments", GroundTruth::instances,
           make_coco_panoptic},
    Format{"yolo-detect", "YOLO boxes with data.yaml", GroundTruth::coco, make_yolo_detect},
    Format{"yolo-segment", "YOLO polygons with data.yaml", GroundTruth::coco, make_yolo_segment},
    Format{"yolo-pose", "YOLO boxes and keypoints with data.yaml", GroundTruth::keypoints,
           make_yolo_pose},
    Format{"mot", "MOT Challenge: tracks of whole bodies", GroundTruth::coco, make_mot},
    Format{"mots", "MOTS: tracks of masks", GroundTruth::coco, make_mots},
    Format{"visdrone-det", "VisDrone DET: a text file per image", GroundTruth::coco,
           make_visdrone_det},
    Format{"visdrone-mot", "VisDrone MOT: a text for each sequence", GroundTruth::coco,
           make_visdrone_mot},
    Format{"uavdt", "UAVDT: texts for each sequence", GroundTruth::coco, make_uavdt},
    Format{"shanghaitech", "heads as .mat, density of sigma 4 as .h5 and .npy", GroundTruth::coco,
           make_points},
    Format{"shanghaitech-adaptive", "the same, sigma from the nearest heads", GroundTruth::coco,
           make_points_adaptive},
    Format{"shanghaitech-perspective", "the same, sigma from the distance to the camera",
           GroundTruth::coco, make_points_perspective},
    Format{"dronecrowd", "DroneCrowd: tracks of heads", GroundTruth::coco, make_dronecrowd},
    Format{"nwpu", "NWPU-Crowd: heads as points and boxes", GroundTruth::heads, make_nwpu},
    Format{"jhu-crowd", "JHU-CROWD++: heads with size, occlusion and blur", GroundTruth::heads,
           make_jhu_crowd, GroundTruth::difficulty},
    Format{"up-count", "UP-COUNT: heads as points, the drone's height", GroundTruth::coco,
           make_up_count},
    Format{"movingdronecrowd", "MovingDroneCrowd: tracks of head boxes, a table per clip",
           GroundTruth::heads, make_moving_drone_crowd},
    Format{"kitti", "KITTI: boxes in the image and in the camera's frame", GroundTruth::coco,
           make_kitti},
    Format{"voc", "Pascal VOC: an XML file per image", GroundTruth::coco, make_voc},
    Format{"cvat", "CVAT for images 1.1", GroundTruth::coco, make_cvat},
    Format{"cvat-video", "CVAT for video 1.1: tracks, a task per sequence", GroundTruth::coco,
           make_cvat_video},
    Format{"label-studio", "Label Studio: tasks with boxes and the labeling interface",
           GroundTruth::coco, make_label_studio},
    Format{"fiftyone", "FiftyOne: data/ and labels.json of detections", GroundTruth::coco,
           make_fiftyone},
    Format{"webdataset", "WebDataset: tar shards of images and JSON", GroundTruth::coco,
           make_webdataset},
    Format{"imagefolder", "Hugging Face ImageFolder with metadata.jsonl", GroundTruth::coco,
           make_imagefolder},
    Format{"depth-exr", "depth as OpenEXR, meters", GroundTruth::depth, make_depth_exr},
    Format{"flow-flo", "flow as Middlebury's .flo", GroundTruth::flow, make_flow_flo},
    Format{"cityscapes", "Cityscapes: label, train and instance ids, colors", GroundTruth::semantic,
           make_cityscapes},
    Format{"uavid", "UAVid: classes as colors", GroundTruth::semantic, make_uavid},
    Format{"jupedsim", "JuPedSim and PedPy: everybody's trajectories as text",
           GroundTruth::trajectories, make_jupedsim},
    Format{"eth-ucy", "ETH/UCY: frame, person, x, y of everybody", GroundTruth::trajectories,
           make_eth_ucy},
    Format{"trajnet", "TrajNet++: scenes and tracks as ndjson", GroundTruth::trajectories,
           make_trajnet},
    Format{"mcap", "MCAP for ROS 2, one per run: images, depth, tf, sensors, people as tracks",
           GroundTruth::coco, make_mcap},
    Format{"market1501", "Market-1501: people's crops to train, query and search, attributes",
           GroundTruth::coco, make_market1501},
    Format{"wildtrack", "WILDTRACK: places on the ground, boxes in all views, calibrations",
           GroundTruth::coco, make_wildtrack},
    Format{"table", "one CSV of all people in all images", GroundTruth::coco, make_table},
};

}  // namespace

std::span<const Format> all_formats() { return kFormats; }

const Format* find_format(std::string_view name) {
  const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                  [&](const Format& format) { return format.name == name; });
  return found == kFormats.end() ? nullptr : &*found;
}

}  // namespace throng::formats
