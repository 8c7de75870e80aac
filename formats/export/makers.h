// Factories of all exporters, which have one file each; format_table.cpp lists them.
#pragma once

#include <memory>

#include "formats/export/exporter.h"

namespace throng::formats {

using ExporterPointer = std::unique_ptr<Exporter>;

ExporterPointer make_coco(const DatasetInfo& info, Output output);
ExporterPointer make_coco_keypoints(const DatasetInfo& info, Output output);
ExporterPointer make_coco_wholebody(const DatasetInfo& info, Output output);
ExporterPointer make_openpose(const DatasetInfo& info, Output output);
ExporterPointer make_jta(const DatasetInfo& info, Output output);
ExporterPointer make_coco_panoptic(const DatasetInfo& info, Output output);
ExporterPointer make_yolo_detect(const DatasetInfo& info, Output output);
ExporterPointer make_yolo_segment(const DatasetInfo& info, Output output);
ExporterPointer make_yolo_pose(const DatasetInfo& info, Output output);
ExporterPointer make_mot(const DatasetInfo& info, Output output);
ExporterPointer make_mots(const DatasetInfo& info, Output output);
ExporterPointer make_visdrone_det(const DatasetInfo& info, Output output);
ExporterPointer make_visdrone_mot(const DatasetInfo& info, Output output);
ExporterPointer make_uavdt(const DatasetInfo& info, Output output);
ExporterPointer make_points(const DatasetInfo& info, Output output);
ExporterPointer make_points_adaptive(const DatasetInfo& info, Output output);
ExporterPointer make_points_perspective(const DatasetInfo& info, Output output);
ExporterPointer make_dronecrowd(const DatasetInfo& info, Output output);
ExporterPointer make_nwpu(const DatasetInfo& info, Output output);
ExporterPointer make_jhu_crowd(const DatasetInfo& info, Output output);
ExporterPointer make_up_count(const DatasetInfo& info, Output output);
ExporterPointer make_moving_drone_crowd(const DatasetInfo& info, Output output);
ExporterPointer make_kitti(const DatasetInfo& info, Output output);
ExporterPointer make_voc(const DatasetInfo& info, Output output);
ExporterPointer make_cvat(const DatasetInfo& info, Output output);
ExporterPointer make_cvat_video(const DatasetInfo& info, Output output);
ExporterPointer make_label_studio(const DatasetInfo& info, Output output);
ExporterPointer make_fiftyone(const DatasetInfo& info, Output output);
ExporterPointer make_webdataset(const DatasetInfo& info, Output output);
ExporterPointer make_imagefolder(const DatasetInfo& info, Output output);
ExporterPointer make_depth_exr(const DatasetInfo& info, Output output);
ExporterPointer make_flow_flo(const DatasetInfo& info, Output output);
ExporterPointer make_cityscapes(const DatasetInfo& info, Output output);
ExporterPointer make_uavid(const DatasetInfo& info, Output output);
ExporterPointer make_jupedsim(const DatasetInfo& info, Output output);
ExporterPointer make_eth_ucy(const DatasetInfo& info, Output output);
ExporterPointer make_trajnet(const DatasetInfo& info, Output output);
ExporterPointer make_mcap(const DatasetInfo& info, Output output);
ExporterPointer make_market1501(const DatasetInfo& info, Output output);
ExporterPointer make_wildtrack(const DatasetInfo& info, Output output);
ExporterPointer make_table(const DatasetInfo& info, Output output);

}  // namespace throng::formats
