#include "spec/calibration/foreign/read_camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "camera/files.h"

namespace throng::calibrate {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class ReadCameraFile : public testing::Test {
 protected:
  CameraFile read(const std::string& content, const std::string& name = "camera") const {
    write_file_atomically(folder.path() / "camera", content);
    return read_camera_file(folder.path() / name);
  }

  std::string refusal_of(const std::string& content, const std::string& name = "camera") const {
    try {
      read(content, name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  StagingFolder folder{std::filesystem::temp_directory_path() / "throng-camera"};
};

/// fx, fy, cx, cy, skew and the coefficients.
void expect_camera(const CameraFile& camera, Lens lens, int width, int height,
                   const std::vector<double>& parameters) {
  EXPECT_EQ(to_string(camera.lens), to_string(lens));
  EXPECT_EQ(camera.size.width, width);
  EXPECT_EQ(camera.size.height, height);
  for (std::size_t i = 0; i < kParameters; ++i) {
    EXPECT_DOUBLE_EQ(camera.parameters.at(i), i < parameters.size() ? parameters[i] : 0) << i;
  }
}

constexpr const char* kRos = R"(image_width: 1280
image_height: 960
camera_name: narrow
camera_matrix:
  rows: 3
  cols: 3
  data: [1138.5,   -0.67, 635.5,
            0.     , 1139.5, 508.5,
            0.     ,    0.     ,    1.     ]
distortion_model: )";

TEST_F(ReadCameraFile, CameraInfoOfRosInAllOfItsModels) {
  const auto ros = [&](const std::string& model, const std::string& data) {
    return read(kRos + model + "\ndistortion_coefficients:\n  rows: 1\n  cols: 4\n  data: " + data +
                "\n");
  };
  const std::vector<double> k = {1138.5, 1139.5, 635.5, 508.5, -0.67};
  const auto with = [&](std::vector<double> coefficients) {
    coefficients.insert(coefficients.begin(), k.begin(), k.end());
    return coefficients;
  };
  expect_camera(ros("equidistant", "[0.03, 0.009, -0.01, 1e-3]"), Lens::fisheye, 1280, 960,
                with({0.03, 0.009, -0.01, 1e-3}));
  expect_camera(ros("plumb_bob", "[-0.3, .1, 0, 0.001, 0.0]"), Lens::brown5, 1280, 960,
                with({-0.3, 0.1, 0, 0.001, 0}));
  expect_camera(ros("plumb_bob", "[-0.3, .1, 0, 0.001]"), Lens::brown4, 1280, 960,
                with({-0.3, 0.1, 0, 0.001}));
  expect_camera(ros("rational_polynomial", "[1, 2, 3, 4, 5, 6, 7, 8]"), Lens::brown8, 1280, 960,
                with({1, 2, 3, 4, 5, 6, 7, 8}));
  expect_camera(ros("\"\"", "[]"), Lens::pinhole, 1280, 960, k);
  EXPECT_THAT(refusal_of(std::string(kRos) + "scaramuzza\n"),
              HasSubstr("/distortion_model: found \"scaramuzza\", expected plumb_bob"));
}

// As `ros2 topic echo` prints it.
TEST_F(ReadCameraFile, AMessageOfRos) {
  expect_camera(read("header:\n  frame_id: cam\nheight: 480\nwidth: 640\n"
                     "distortion_model: plumb_bob\nd:\n- -0.1\n- 0.2\n- 0.0\n- 0.0\n- 0.0\n"
                     "k: [500.0, 0.0, 320.0, 0.0, 501.0, 240.0, 0.0, 0.0, 1.0]\n---\n"),
                Lens::brown5, 640, 480, {500, 501, 320, 240, 0, -0.1, 0.2});
}

TEST_F(ReadCameraFile, RegionsAndBinningOfRosAreTheImages) {
  const auto message = [&](const std::string& roi, const std::string& binning) {
    return "height: 480\nwidth: 640\ndistortion_model: plumb_bob\nD: [-0.1, 0.2, 0, 0, 0]\n"
           "K: [500.0, 0.0, 320.0, 0.0, 501.0, 240.0, 0.0, 0.0, 1.0]\nbinning_x: " +
           binning + "\nbinning_y: " + binning + "\nroi: {x_offset: 100, y_offset: 50, " + roi +
           ", do_rectify: false}\n";
  };
  expect_camera(read(message("height: 300, width: 400", "0")), Lens::brown5, 400, 300,
                {500, 501, 220, 190, 0, -0.1, 0.2});
  // A pixel of two by two: the edges at -0.5 stay, and its center lies between four.
  expect_camera(read(message("height: 300, width: 400", "2")), Lens::brown5, 200, 150,
                {250, 250.5, 109.75, 94.75, 0, -0.1, 0.2});
  expect_camera(read(message("height: 0, width: 0", "1")), Lens::brown5, 640, 480,
                {500, 501, 320, 240, 0, -0.1, 0.2});
  EXPECT_THAT(refusal_of(message("height: 300, width: 600", "1")),
              HasSubstr("/roi: found 600 x 300 pixels at 100, 50"));
}

TEST_F(ReadCameraFile, OpenCvAsYamlXmlAndJson) {
  const std::vector<double> expected = {535.5,  536.5,   342.5,  235.5,    0,
                                        -0.266, -0.0386, 0.0017, -0.00028, 0.238};
  const char* const matrix = "535.5, 0., 342.5, 0., 536.5, 235.5, 0., 0., 1.";
  const char* const lens = "-0.266, -3.86e-02, 0.0017, -0.00028, 0.238";
  expect_camera(
      read(std::string("%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n"
                       "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                       "   data: [ ") +
           matrix + " ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n" +
           "   dt: d\n   data: [ " + lens + " ]\n"),
      Lens::brown5, 640, 480, expected);
  const auto blanks = [](std::string list) {
    std::erase(list, ',');
    return list;
  };
  expect_camera(read("<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_Width>640</image_Width>\n"
                     "<image_Height>480</image_Height>\n<Camera_Matrix type_id=\"opencv-matrix\">\n"
                     "  <rows>3</rows><cols>3</cols><dt>d</dt>\n  <data>\n    " +
                     blanks(matrix) +
                     "</data></Camera_Matrix>\n<Distortion_Coefficients "
                     "type_id=\"opencv-matrix\"><rows>5</rows><cols>1</cols><dt>d</dt>"
                     "<data>" +
                     blanks(lens) + "</data></Distortion_Coefficients>\n</opencv_storage>\n"),
                Lens::brown5, 640, 480, expected);
  expect_camera(read(R"({"image_width": 640, "image_height": 480, "cameraMatrix": {"type_id":
 "opencv-matrix", "rows": 3, "cols": 3, "dt": "d", "data": [535.5, 0, 342.5, 0, 536.5, 235.5, 0, 0,
 1]}, "distCoeffs": [[-0.266, -0.0386, 0.0017, -0.00028, 0.238]]})"),
                Lens::brown5, 640, 480, expected);
  expect_camera(read("imageSize: [64, 48]\nK: [[50, 0, 32], [0, 51, 24], [0, 0, 1]]\n"),
                Lens::pinhole, 64, 48, {50, 51, 32, 24, 0});
  // The sample program's word for fisheyes.
  expect_camera(read("image_width: 64\nimage_height: 48\nfisheye_model: 1\n"
                     "K: [[50, 0, 32], [0, 51, 24], [0, 0, 1]]\nD: [0.1, 0.2, 0.3, 0.4]\n"),
                Lens::fisheye, 64, 48, {50, 51, 32, 24, 0, 0.1, 0.2, 0.3, 0.4});
}

// cv::fisheye::calibrate() and cv::calibrateCamera() with four coefficients give the same file.
TEST_F(ReadCameraFile, FourCoefficientsNeedAModel) {
  const std::string size = "%YAML:1.0\n---\nimage_width: 1280\nimage_height: 800\n";
  const std::string k =
      "K: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ 330., 0., 640., 0., 330., 400., 0., 0., 1. ]\n";
  const std::string d =
      "D: !!opencv-matrix\n   rows: 4\n   cols: 1\n   dt: d\n"
      "   data: [ -0.02, 0.005, -0.003, 0.0007 ]\n";
  EXPECT_THAT(refusal_of(size + k + d),
              HasSubstr("/D: found 4 coefficients without a model, expected \"distortion_model\""));
  const std::vector<double> expected = {330, 330, 640, 400, 0, -0.02, 0.005, -0.003, 0.0007};
  expect_camera(read(size + k + d + "distortion_model: equidistant\n"), Lens::fisheye, 1280, 800,
                expected);
  expect_camera(read(size + k + d + "distortion_model: plumb_bob\n"), Lens::brown4, 1280, 800,
                expected);
  EXPECT_THAT(refusal_of("image_size: [64, 48]\ncameraMatrix: [[50, 0, 32], [0, 51, 24], [0, 0, 1]]"
                         "\ndistCoeffs: [[0.1], [0.2], [0.3], [0.4]]\n"),
              HasSubstr("/distCoeffs: found 4 coefficients"));
}

TEST_F(ReadCameraFile, PrincipalPointsAreInsideOfTheImage) {
  EXPECT_THAT(refusal_of("1 OPENCV 1280 720 1600.09 948.289 0 0 -0.529335 0.146421 0.1 0.018\n"),
              HasSubstr("found a principal point of (-0.5, -0.5) px, not inside an image of 1280 x "
                        "720, expected one near the middle (639.5, 359.5)"));
  const auto ros = [&](const std::string& cx, const std::string& cy) {
    return "image_width: 64\nimage_height: 48\ncamera_matrix: [50, 0, " + cx + ", 0, 51, " + cy +
           ", 0, 0, 1]\n";
  };
  for (const auto& [cx, cy] :
       {std::pair{"0", "0"}, {"0", "24"}, {"32", "47"}, {"-3", "24"}, {"640", "480"}}) {
    EXPECT_THAT(refusal_of(ros(cx, cy)), HasSubstr("a principal point of (")) << cx << " " << cy;
  }
  EXPECT_EQ(read(ros("3", "45")).parameters[kCy], 45);
  EXPECT_THAT(refusal_of(R"({"width": 64, "height": 48, "lens": "pinhole", "fx": 50, "fy": 50,
 "cx": 0, "cy": 0})"),
              HasSubstr("a principal point of (0.0, 0.0)"));
}

TEST_F(ReadCameraFile, CoefficientsThatThrongDoesNotHaveMustBeZero) {
  const std::string start =
      "image_width: 64\nimage_height: 48\ncamera_matrix: [50, 0, 32, 0, 51, 24, 0, 0, 1]\n"
      "distortion_coefficients: [1, 2, 3, 4, 5, 6, 7, 8, ";
  EXPECT_EQ(to_string(read(start + "0, 0, 0, 0, 0, 0]\n").lens), "brown8");
  EXPECT_THAT(refusal_of(start + "0, 0.1, 0, 0]\n"), HasSubstr("no thin prism"));
}

TEST_F(ReadCameraFile, MissingMembersAreNamed) {
  EXPECT_THAT(refusal_of("camera_matrix: [50, 0, 32, 0, 51, 24, 0, 0, 1]\n"),
              HasSubstr("add image_width"));
  EXPECT_THAT(refusal_of("image_width: 9\ncamera_matrix: [50, 0, 32, 0, 51, 24, 0, 0, 1]\n"),
              HasSubstr("add image_height"));
  EXPECT_THAT(refusal_of("image_width: 1e300\nimage_height: 8\ncamera_matrix: [1]\n"),
              HasSubstr("/image_width: found 1e+300"));
  EXPECT_THAT(refusal_of("image_size: [64, 48, 3]\ncamera_matrix: [1]\n"),
              HasSubstr("/image_size: found 3 numbers"));
  EXPECT_THAT(refusal_of("image_width: 9\nimage_height: 8\ncamera_matrix: {rows: 3}\n"),
              HasSubstr("/camera_matrix: found no member \"data\""));
  EXPECT_THAT(refusal_of("image_width: wide\nimage_height: 8\ncamera_matrix: [1]\n"),
              HasSubstr("/image_width: found \"wide\""));
  EXPECT_THAT(refusal_of(R"({"width": 64, "height": 48, "lens": "pinhole", "fx": null})"),
              HasSubstr("/fx: found null"));
  EXPECT_THAT(refusal_of("a: [1, 2\n"), HasSubstr("line "));
  EXPECT_THAT(refusal_of("image_width: br\xEAit\nimage_height: 8\ncamera_matrix: [1]\n"),
              HasSubstr("/image_width: found \"br\uFFFDit\""));
  EXPECT_THAT(refusal_of("<a><b></a>"), HasSubstr("XML"));
  EXPECT_NE(refusal_of(std::string(100'000, '[')), "");
  EXPECT_NE(refusal_of("just words"), "");
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) bomb += (k > 0 ? ", *a" : "*a") + std::to_string(i - 1);
    bomb += "]\n";
  }
  EXPECT_THAT(refusal_of(bomb), HasSubstr("too many values"));
}

constexpr const char* kCam0 = R"(cam0:
  cam_overlaps: []
  camera_model: pinhole
  distortion_coeffs: [-0.4, 0.15, -0.001, 0.0002]
  distortion_model: radtan
  intrinsics: [1073.5, 1074.5, 639.5, 350.5]
  resolution: [1280, 800]
  rostopic: /cam0/image_raw
)";
constexpr const char* kCam1 = R"(cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, 0.1]
  camera_model: pinhole
  distortion_coeffs: [0.1, 0.2, 0.3, 0.4]
  distortion_model: equidistant
  intrinsics: [400, 401, 320, 240]
  resolution: [640, 480]
)";

TEST_F(ReadCameraFile, KalibrsChains) {
  expect_camera(read(kCam0), Lens::brown4, 1280, 800,
                {1073.5, 1074.5, 639.5, 350.5, 0, -0.4, 0.15, -0.001, 0.0002});
  const std::string both = std::string(kCam0) + kCam1;
  expect_camera(read(both, "camera#cam1"), Lens::fisheye, 640, 480,
                {400, 401, 320, 240, 0, 0.1, 0.2, 0.3, 0.4});
  EXPECT_THAT(refusal_of(both), HasSubstr("FILE#NAME with one of: cam0, cam1"));
  EXPECT_THAT(refusal_of(both, "camera#cam2"), HasSubstr("one of: cam0, cam1"));
  std::string omni = kCam0;
  omni.replace(omni.find("pinhole"), 7, "omni");
  EXPECT_THAT(refusal_of(omni), HasSubstr("found omni-radtan, expected pinhole-radtan"));
}

/// Pixels at which the camera shows a ray at an angle to the axis, along x and along y.
std::pair<double, double> shown_at(const CameraFile& camera, double angle_rad) {
  const Parameters& p = camera.parameters;
  const double a = angle_rad;
  double radius = a;
  for (std::size_t i = 0; i < 4; ++i) {
    radius += p.at(kCoefficients + i) * std::pow(a, 3 + 2 * static_cast<int>(i));
  }
  return {p[kFx] * radius + p[kCx], p[kFy] * radius + p[kCy]};
}

// The reference is each model's projection of the ray (sin a, 0, cos a), in Cartesian coordinates.
TEST_F(ReadCameraFile, LensesThatBendByTheAngleBecomeFisheyes) {
  const auto chain = [](const char* model, const char* own, const char* distortion,
                        const char* coefficients) {
    return std::string("cam0:\n  camera_model: ") + model + "\n  distortion_coeffs: [" +
           coefficients + "]\n  distortion_model: " + distortion + "\n  intrinsics: [" + own +
           "158, 157, 255.5, 256.5]\n  resolution: [512, 512]\n";
  };
  const auto expect_shown = [](const CameraFile& camera, double angle_rad, double radius) {
    EXPECT_EQ(to_string(camera.lens), "fisheye");
    const auto [u, v] = shown_at(camera, angle_rad);
    EXPECT_NEAR(u, 255.5 + 158 * radius, 0.05) << angle_rad;
    EXPECT_NEAR(v, 256.5 + 157 * radius, 0.05) << angle_rad;
  };
  const CameraFile sphere = read(chain("ds", "-0.18, 0.59, ", "none", ""));
  const CameraFile unified = read(chain("eucm", "0.63, 1.04, ", "none", ""));
  const CameraFile view = read(chain("pinhole", "", "fov", "0.9"));
  for (const double angle : {0.05, 0.4, 0.8, 1.2, 1.5}) {
    const double x = std::sin(angle);
    const double z = std::cos(angle);
    const double d2 = std::sqrt(x * x + (z - 0.18) * (z - 0.18));
    expect_shown(sphere, angle, x / (0.59 * d2 + 0.41 * (z - 0.18)));
    const double d = std::sqrt(1.04 * x * x + z * z);
    expect_shown(unified, angle, x / (0.63 * d + 0.37 * z));
    expect_shown(view, angle, std::atan2(2 * x * std::tan(0.45), z) / 0.9);
  }
  EXPECT_THAT(refusal_of(chain("ds", "-0.18, 0.59, ", "radtan", "1, 2, 3, 4")),
              HasSubstr("found ds-radtan"));
  EXPECT_THAT(refusal_of(chain("ds", "", "none", "")), HasSubstr("found 4 numbers"));
  EXPECT_THAT(refusal_of(chain("ds", "-3, 0.5, ", "none", "")), HasSubstr("parameters of no lens"));
  EXPECT_THAT(refusal_of(chain("pinhole", "", "fov", ".nan")), Not(IsEmpty()));
}

// The references are the equations of camodocal's models, at the ray (sin a, 0, cos a).
TEST_F(ReadCameraFile, CamodocalsModels) {
  const auto camera = [](const std::string& model, const std::string& groups) {
    return "%YAML:1.0\n---\nmodel_type: " + model +
           "\ncamera_name: cam0\nimage_width: 752\nimage_height: 480\n" + groups;
  };
  const std::string pinhole =
      "distortion_parameters:\n   k1: -2.1e-01\n   k2: 5.0e-02\n   p1: 1.0e-03\n   p2: -2e-03\n"
      "projection_parameters:\n   fx: 900.5\n   fy: 901.25\n   cx: 340.2\n   cy: 239.5\n";
  expect_camera(read(camera("PINHOLE", pinhole)), Lens::brown4, 752, 480,
                {900.5, 901.25, 340.2, 239.5, 0, -0.21, 0.05, 0.001, -0.002});
  expect_camera(read(camera("KANNALA_BRANDT",
                            "projection_parameters:\n   k2: -0.02\n   k3: 0.005\n   k4: -0.003\n"
                            "   k5: 0.0007\n   mu: 330\n   mv: 331\n   u0: 370\n   v0: 240\n")),
                Lens::fisheye, 752, 480, {330, 331, 370, 240, 0, -0.02, 0.005, -0.003, 0.0007});
  const auto mei = [&](const std::string& p1) {
    return camera("MEI",
                  "mirror_parameters:\n   xi: 1.2\ndistortion_parameters:\n   k1: -0.1\n"
                  "   k2: 0.02\n   p1: " +
                      p1 +
                      "\n   p2: 0\nprojection_parameters:\n"
                      "   gamma1: 700\n   gamma2: 701\n   u0: 370\n   v0: 240\n");
  };
  for (const double angle : {0.05, 0.3, 0.7, 1.0}) {
    const double m = std::sin(angle) / (std::cos(angle) + 1.2);
    const double radius = m * (1 - 0.1 * m * m + 0.02 * m * m * m * m);
    EXPECT_NEAR(shown_at(read(mei("0")), angle).first, 370 + 700 * radius, 0.1) << angle;
  }
  EXPECT_THAT(refusal_of(mei("0.001")), HasSubstr("found p1 = 0.001 of MEI, expected 0"));
  EXPECT_THAT(
      refusal_of(camera("SCARAMUZZA", "")),
      HasSubstr("/model_type: found \"SCARAMUZZA\" of camodocal, expected one of: PINHOLE"));
  EXPECT_THAT(refusal_of(camera("PINHOLE", "projection_parameters:\n   fx: 9\n")),
              HasSubstr("/fy: found nothing, expected the focal length of PINHOLE"));
}

// Lengths are in units of the longer side, from the middle of the image.
TEST_F(ReadCameraFile, OpenSfmsModels) {
  const auto camera = [](const std::string& name, const std::string& rest) {
    return "\"" + name + "\": {\"projection_type\": " + rest + "}";
  };
  const std::string brown = camera(
      "v2 acme q1 4000 3000 brown 0.85",
      R"("brown", "width": 4000, "height": 3000, "focal_x": 0.85, "focal_y": 0.852, "c_x": 0.002,
 "c_y": -0.001, "k1": -0.02, "k2": 0.01, "p1": 0.0003, "p2": -0.0002, "k3": 0.004)");
  const std::vector<double> expected = {3400,  3408, 2007.5, 1495.5,  0,
                                        -0.02, 0.01, 0.0003, -0.0002, 0.004};
  expect_camera(read("{" + brown + "}"), Lens::brown5, 4000, 3000, expected);
  const std::string two =
      "{" + brown + ", " +
      camera("b", R"("perspective", "width": 480, "height": 640, "focal": 0.9, "k1": -0.1)") + "}";
  EXPECT_THAT(refusal_of(two), HasSubstr("FILE#NAME with one of: b, v2 acme"));
  expect_camera(read(two, "camera#v2 acme q1 4000 3000 brown 0.85"), Lens::brown5, 4000, 3000,
                expected);
  expect_camera(read(two, "camera#b"), Lens::brown2, 480, 640, {576, 576, 239.5, 319.5, 0, -0.1});
  const std::string fisheye =
      R"("width": 400, "height": 300, "focal_x": 0.5, "focal_y": 0.5, "k1": 0.1, "k4": 0.2)";
  expect_camera(read("{" + camera("a", "\"fisheye_opencv\", " + fisheye) + "}"), Lens::fisheye, 400,
                300, {200, 200, 199.5, 149.5, 0, 0.1, 0, 0, 0.2});
  EXPECT_THAT(refusal_of("{" + camera("a", "\"fisheye62\", \"p1\": 0.1, " + fisheye) + "}"),
              HasSubstr("found p1 = 0.1 of fisheye62, expected 0"));
  EXPECT_THAT(refusal_of("{" + camera("a", "\"equirectangular\", " + fisheye) + "}"),
              HasSubstr("/projection_type: found \"equirectangular\" of OpenSfM"));
}

TEST_F(ReadCameraFile, OtherFormatsAreRefusedByName) {
  EXPECT_THAT(refusal_of("# oST version 5.0 parameters\n\n[image]\n\nwidth\n640\n\nheight\n480\n\n"
                         "[narrow_stereo]\n\ncamera matrix\n500 0 320\n0 500 240\n0 0 1\n"),
              HasSubstr("found ROS' .ini, expected the .yaml of the same calibration"));
  EXPECT_THAT(
      refusal_of("<?xml version=\"1.0\"?>\n<calibration>\n  <projection>frame</projection>\n"
                 "  <width>4000</width>\n</calibration>\n"),
      HasSubstr("found Agisoft Metashape's XML"));
  EXPECT_THAT(refusal_of("%YAML:1.0\nCamera.type: \"PinHole\"\nCamera.fx: 458.654\n"),
              HasSubstr("found ORB-SLAM's settings"));
  EXPECT_THAT(refusal_of(R"({"camera_angle_x": 0.7, "frames": []})"), HasSubstr("transforms.json"));
  EXPECT_THAT(refusal_of("focal: 3\nsensor: big\n"),
              HasSubstr("found no camera of a format that throng knows"));
}

template <typename Value>
void append(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

// COLMAP counts pixels from the corner of the image, throng from the middle of the first pixel.
TEST_F(ReadCameraFile, ColmapsTextBinaryAndJson) {
  const std::vector<double> expected = {1400, 1402, 959.5, 539.5, 0, -0.1, 0.02, 0.0003, 0.0001};
  const std::string line = "7 OPENCV 1920 1080 1400 1402 960 540 -0.1 0.02 0.0003 0.0001\n";
  const std::string head = "# Camera list with one line of data per camera:\n";
  expect_camera(read(head + line), Lens::brown4, 1920, 1080, expected);
  const std::string two = head + "3 SIMPLE_RADIAL 640 480 500 320 240 -0.1\n" + line;
  expect_camera(read(two, "camera#7"), Lens::brown4, 1920, 1080, expected);
  expect_camera(read(two, "camera#3"), Lens::brown2, 640, 480, {500, 500, 319.5, 239.5, 0, -0.1});
  EXPECT_THAT(refusal_of(two), HasSubstr("FILE#CAMERA_ID with one of: 3, 7"));
  const CameraFile fov = read("1 FOV 640 480 300 301 320 240 0.9\n");
  EXPECT_NEAR(shown_at(fov, 0.5).first,
              319.5 + 300 * std::atan(2 * std::tan(0.5) * std::tan(0.45)) / 0.9, 0.05);
  EXPECT_THAT(refusal_of("1 DIVISION 640 480 1 2 3 4 5\n"),
              HasSubstr("line 1: found COLMAP's camera model \"DIVISION\", expected one of"));
  expect_camera(read(two + "9 THIN_PRISM_FISHEYE 640 480 1 2 3 4 0 0 1 1 0 0 0 0\n", "camera#3"),
                Lens::brown2, 640, 480, {500, 500, 319.5, 239.5, 0, -0.1});
  expect_camera(read("9 THIN_PRISM_FISHEYE 640 480 300 301 320 240 .1 .2 0 0 .3 .4 0 0\n"),
                Lens::fisheye, 640, 480, {300, 301, 319.5, 239.5, 0, .1, .2, .3, .4});
  EXPECT_THAT(refusal_of("9 THIN_PRISM_FISHEYE 640 480 300 301 320 240 .1 .2 0 0 .3 .4 0.1 0\n"),
              HasSubstr("found sx1 = 0.1 of THIN_PRISM_FISHEYE, expected 0"));
  EXPECT_THAT(refusal_of("1 PINHOLE 640 480 1 2 3\n"), HasSubstr("found 3 parameters"));
  expect_camera(read(R"({"model": "OPENCV", "width": 1920, "height": 1080, "params":
 [1400, 1402, 960, 540, -0.1, 0.02, 0.0003, 0.0001]})"),
                Lens::brown4, 1920, 1080, expected);
  std::string binary;
  append<std::uint64_t>(binary, 1);
  append<std::uint32_t>(binary, 7);
  append<std::int32_t>(binary, 4);
  append<std::uint64_t>(binary, 1920);
  append<std::uint64_t>(binary, 1080);
  for (const double value : {1400., 1402., 960., 540., -0.1, 0.02, 0.0003, 0.0001}) {
    append(binary, value);
  }
  expect_camera(read(binary), Lens::brown4, 1920, 1080, expected);
  EXPECT_NE(refusal_of(binary.substr(0, binary.size() - 3)), "");
}

TEST_F(ReadCameraFile, OwnFilesForOthersAreReadBack) {
  for (const Lens lens : {Lens::pinhole, Lens::brown5, Lens::brown8, Lens::fisheye}) {
    CameraFile camera;
    camera.lens = lens;
    camera.size = {640, 480};
    for (std::size_t i = 0; i < kParameters; ++i) {
      if (!parameter_name(lens, i).empty()) camera.parameters.at(i) = 0.01 * (1. + i);
    }
    camera.parameters[kSkew] = 0;
    camera.parameters[kFx] = 500.25;
    camera.parameters[kFy] = 501.5;
    const camera::Intrinsics lens_of = camera.intrinsics();
    for (const std::string& text :
         {camera::opencv_yaml(lens_of), camera::ros_yaml(lens_of, "front")}) {
      const camera::Intrinsics back = read(text).intrinsics();
      EXPECT_NEAR(back.fx_px, 500.25, 1e-9) << text;
      EXPECT_NEAR(back.fy_px, 501.5, 1e-9) << text;
      if (!lens_of.distortion) continue;
      ASSERT_TRUE(back.distortion) << text;
      EXPECT_EQ(back.distortion->model(), lens_of.distortion->model());
      for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_NEAR(back.distortion->coefficients().at(i), lens_of.distortion->coefficients().at(i),
                    1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace throng::calibrate
