// Calibrations as OpenCV and ROS read them.
#include "camera/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace throng::camera {
namespace {

using ::testing::HasSubstr;
using Model = Distortion::Model;

Intrinsics full_hd() {
  Intrinsics k;
  k.width = 1920;
  k.height = 1080;
  k.fx_px = 1480.25;
  k.fy_px = 1481;
  k.cx_px = 962.1;
  k.cy_px = 538.4;
  return k;
}

TEST(CameraFiles, OpenCvReadsTheWrittenFiles) {
  Intrinsics k = full_hd();
  k.distortion = Distortion(Model::brown_conrady, {-0.28, 0.08, 0.0003, -0.0002, 0.001});
  const cv::FileStorage file(opencv_yaml(k), cv::FileStorage::READ | cv::FileStorage::MEMORY);
  ASSERT_TRUE(file.isOpened());
  EXPECT_EQ(static_cast<int>(file["image_width"]), 1920);
  EXPECT_EQ(static_cast<int>(file["image_height"]), 1080);
  cv::Mat matrix;
  cv::Mat distortion;
  file["camera_matrix"] >> matrix;
  file["distortion_coefficients"] >> distortion;
  ASSERT_EQ(matrix.type(), CV_64F);
  EXPECT_EQ(matrix.at<double>(0, 0), 1480.25);
  EXPECT_EQ(matrix.at<double>(1, 1), 1481);
  EXPECT_EQ(matrix.at<double>(0, 2), 962.1);
  EXPECT_EQ(matrix.at<double>(2, 2), 1);
  ASSERT_EQ(distortion.cols, 5);
  EXPECT_EQ(distortion.at<double>(0, 0), -0.28);
  EXPECT_EQ(distortion.at<double>(0, 3), -0.0002);
  EXPECT_EQ(distortion.at<double>(0, 4), 0.001);
}

TEST(CameraFiles, NameTheLensModelAsRosDoes) {
  Intrinsics k = full_hd();
  EXPECT_THAT(ros_yaml(k, "d1"), HasSubstr("distortion_model: plumb_bob\n"));
  EXPECT_THAT(ros_yaml(k, "d1"), HasSubstr("camera_name: d1\n"));
  EXPECT_THAT(ros_yaml(k, "d1"),
              HasSubstr("projection_matrix:\n  rows: 3\n  cols: 4\n  data: [1480.25, 0.0, 962.1, "
                        "0.0, 0.0, 1481.0, 538.4, 0.0, 0.0, 0.0, 1.0, 0.0]\n"));
  k.distortion = Distortion(Model::brown_conrady, {-0.1, 0, 0, 0, 0, 0.01});
  EXPECT_THAT(ros_yaml(k, "d1"), HasSubstr("distortion_model: rational_polynomial\n"));
  EXPECT_THAT(ros_yaml(k, "d1"), HasSubstr("cols: 8\n"));
  k.distortion = Distortion(Model::fisheye, {0.01, 0.002});
  EXPECT_THAT(ros_yaml(k, "d1"),
              HasSubstr("distortion_model: equidistant\ndistortion_coefficients:\n  rows: 1\n  "
                        "cols: 4\n  data: [0.01, 0.002, 0.0, 0.0]\n"));
}

}  // namespace
}  // namespace throng::camera
