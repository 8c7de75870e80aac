// Tables, cameras and results as files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "base/files/files.h"
#include "calibration/control_points.h"
#include "calibration/intrinsics.h"
#include "calibration/request.h"
#include "calibration/residual_plot.h"
#include "calibration/result.h"
#include "spec/calibration/foreign/read_camera_file.h"
#include "tests/calibration/boards.h"

namespace throng::calibrate {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

class Files : public ::testing::Test {
 protected:
  Files() : base_(fs::temp_directory_path() / ("throng_calib_" + std::to_string(::getpid()))) {
    fs::create_directories(base_);
  }
  ~Files() override { fs::remove_all(base_); }
  fs::path write(const std::string& name, const std::string& text) const {
    write_file_atomically(base_ / name, text);
    return base_ / name;
  }
  /// A table of views; `change` may spoil a line.
  static std::string table(int views,
                           const std::function<void(int, int, std::string&)>& change = {}) {
    const SyntheticViews all = synthetic_views({}, views, 0.1, 5);
    std::string text = "image,i,X,Y,Z,u,v\n";
    for (std::size_t v = 0; v < all.all.views.size(); ++v) {
      const View& view = all.all.views[v];
      for (std::size_t i = 0; i < view.points.size(); ++i) {
        std::ostringstream line;
        line.precision(17);
        line << view.name << ',' << i << ',' << view.points[i].x() << ',' << view.points[i].y()
             << ",0," << view.pixels[i].x() << ',' << view.pixels[i].y();
        std::string words = line.str();
        if (change) change(static_cast<int>(v), static_cast<int>(i), words);
        text += words + "\n";
      }
    }
    return text;
  }
  template <typename Action>
  static std::string error_of(const Action& action) {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  const fs::path base_;
};

TEST_F(Files, ViewsWithBadLinesAreLeftOut) {
  const fs::path file = write("points.csv", table(8, [](int view, int point, std::string& line) {
                                if (view == 1 && point == 3) line = "view1,3,0,0,0,nan,12";
                                if (view == 2 && point == 5) line = "view2,5,0,0";
                                if (view == 3 && point == 7) line = "view3,7,0,0,0,inf,12";
                                if (view == 4 && point == 1)
                                  line = "view4,1,-0.12,-0.09,0,800,500";  // point 0 again
                              }));
  const Correspondences all = read_correspondences(file, {1920, 1080});
  EXPECT_EQ(all.views.size(), 4U);
  ASSERT_EQ(all.left_out.size(), 4U);
  EXPECT_THAT(all.left_out[0].text(), HasSubstr("points.csv: line 68, image view1: found \"nan\""));
  EXPECT_THAT(all.left_out[3].text(), HasSubstr("1 points given twice"));
  EXPECT_NEAR(calibrate_intrinsics(all, {}).parameters[kFx], 1200, 30);
}

TEST_F(Files, TablesThatAreNoneAreRefused) {
  EXPECT_THAT(error_of([&] {
                read_correspondences(write("a.csv", "image,X,Y\n1,2,3\n"), {9, 9});
              }),
              HasSubstr("a header without the column \"Z\""));
  EXPECT_THAT(error_of([&] {
                read_correspondences(write("b.csv", "image,X,Y,Z,u,v\n"), {9, 9});
              }),
              HasSubstr("no rows"));
  EXPECT_THAT(error_of([&] {
                read_correspondences(write("c.csv", table(2)), {100, 50});
              }),
              HasSubstr("2 of 2 images have points outside"));
  EXPECT_THROW(read_correspondences(base_ / "none.csv", {9, 9}), EnvironmentError);
  EXPECT_THAT(error_of([&] { parse_image_size("640", "--size"); }), HasSubstr("WIDTHxHEIGHT"));
}

// As spreadsheets write them where the comma is the decimal sign.
TEST_F(Files, TablesMayHaveSemicolonsAndDecimalCommas) {
  std::string text = table(6);
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '.', ',');
  const Correspondences expected = read_correspondences(write("a.csv", table(6)), {1920, 1080});
  const Correspondences all = read_correspondences(write("b.csv", text), {1920, 1080});
  ASSERT_EQ(all.views.size(), expected.views.size());
  for (std::size_t i = 0; i < all.views.size(); ++i) {
    ASSERT_EQ(all.views[i].pixels.size(), expected.views[i].pixels.size());
    for (std::size_t k = 0; k < all.views[i].pixels.size(); ++k) {
      EXPECT_EQ(all.views[i].pixels[k], expected.views[i].pixels[k]);
      EXPECT_EQ(all.views[i].points[k], expected.views[i].points[k]);
    }
  }
}

TEST_F(Files, ACameraNeedsOnlyItsParameters) {
  const json camera = {{"width", 640}, {"height", 480}, {"lens", "pinhole"}, {"fx", 500},
                       {"fy", 501},    {"cx", 320},     {"cy", 240}};
  const fs::path file = write("camera.json", camera.dump());
  EXPECT_EQ(read_camera_file(file).parameters[kFy], 501);
  json other = camera;
  other["type"] = "other-camera";
  EXPECT_THAT(error_of([&] { camera_from_json(other, "camera.json"); }),
              HasSubstr("\"throng-camera\", or no type"));
  other = camera;
  other["version"] = 2;
  EXPECT_THAT(error_of([&] { camera_from_json(other, "camera.json"); }), HasSubstr("/version"));
  EXPECT_THAT(error_of([&] { camera_from_json(json::array(), "camera.json"); }),
              HasSubstr("an object"));
}

TEST_F(Files, MistakesInControlPointsAreReported) {
  const ControlPoints good =
      read_control_points(write("gcp.csv", "point,X,Y,Z,sd\na,1,2,3,0.02\nb,4,5,6,\n"));
  EXPECT_EQ(good.at("a").sd_m, 0.02);
  EXPECT_EQ(good.at("b").sd_m, 0);
  const std::string error = error_of(
      [&] { read_control_points(write("bad.csv", "point,X,Y,Z\na,1,2,3\na,1,2,4\nb,1,x,4\n")); });
  EXPECT_THAT(error, HasSubstr("line 3: found point a again"));
  EXPECT_THAT(error, HasSubstr("line 4: found \"x\""));
  EXPECT_THAT(error_of([&] {
                read_named_pixels(write("seen.csv", "image,point,u,v\nf,a,1,2\nf,a,3,4\n"));
              }),
              HasSubstr("each point once per image"));
}

TEST_F(Files, ACameraComesBackAsItWas) {
  const CameraFile camera{Lens::brown8,
                          {500, 501, 320, 240, 0.5, -0.1, 0.2, 0.001, -0.002, 0.3, 0.4, 0.5, 0.6},
                          {640, 480}};
  const CameraFile back = read_camera_file(write("c.json", to_json(camera).dump()));
  EXPECT_EQ(back.parameters, camera.parameters);
  EXPECT_EQ(back.size, camera.size);
  EXPECT_EQ(back.lens, camera.lens);
  json value = to_json(camera);
  value["fx"] = -1;
  EXPECT_THAT(error_of([&] { camera_from_json(value, "c.json"); }), HasSubstr("c.json: /fx"));
  value.erase("fx");
  EXPECT_THAT(error_of([&] { camera_from_json(value, "c.json"); }), HasSubstr("nothing"));
  value = to_json(camera);
  value["lens"] = "fish";
  EXPECT_THROW(camera_from_json(value, "c.json"), InputError);
  EXPECT_THROW(camera_from_json(json::array(), "c.json"), InputError);
  EXPECT_THROW(read_camera_file(write("d.json", "{")), InputError);
}

TEST_F(Files, ResultsSayHowSureTheyAre) {
  SyntheticViews views = synthetic_views({}, 12, 0.2, 5);
  add_outliers(views.all, 0.02, 15, 4);
  const Calibration found = calibrate_intrinsics(views.all, {});
  const json value = to_json(found);
  EXPECT_EQ(value.at("fx"), found.parameters[kFx]);
  EXPECT_EQ(value.at("k3"), found.parameters[9]);
  EXPECT_EQ(value.at("rms_px"), found.rms_px);
  EXPECT_EQ(value.at("covariance").at("parameters").size(), 9U);
  const double variance = value.at("covariance").at("matrix").at(0).at(0);
  EXPECT_NEAR(std::sqrt(variance), value.at("std").at("fx").get<double>(), 1e-12);
  EXPECT_EQ(value.at("views").size(), 12U);
  std::size_t outliers = 0;
  for (const json& view : value.at("views")) outliers += view.at("outliers").size();
  EXPECT_EQ(outliers, found.rejected);
  EXPECT_EQ(camera_from_json(value, "x").parameters, found.parameters);
  // OpenCV reads the values of the text.
  const cv::FileStorage yaml(opencv_yaml(found), cv::FileStorage::READ | cv::FileStorage::MEMORY);
  cv::Mat matrix;
  cv::Mat poses;
  yaml["camera_matrix"] >> matrix;
  yaml["extrinsic_parameters"] >> poses;
  EXPECT_EQ(matrix.at<double>(0, 0), found.parameters[kFx]);
  ASSERT_EQ(poses.rows, 12);
  EXPECT_EQ(poses.at<double>(3, 5), found.views[3].pose.translation.z());
  EXPECT_THAT(ros_yaml(found, "d1"), HasSubstr("camera_name: d1"));
  EXPECT_THAT(summary(found), HasSubstr("12 views"));
  const drawing::Drawing plot = residual_plot(found);
  EXPECT_THAT(drawing::to_svg(plot), HasSubstr("<svg"));
  const auto red_dots =
      std::count_if(plot.shapes.begin(), plot.shapes.end(), [](const auto& shape) {
        return shape.fill.rgb == std::array<std::uint8_t, 3>{255, 0, 0};
      });
  EXPECT_EQ(red_dots, found.rejected);
  EXPECT_GT(red_dots, 0);
}

TEST_F(Files, RequestsAreCheckedFieldByField) {
  write("points.csv", table(5));
  const auto read = [&](const char* text) { return request_from_json(json::parse(text), base_); };
  const Request good = read(
      R"({"points": "points.csv", "size": "1920x1080", "lens": "auto", "skew": false,
          "fix": {"cx": 960, "cy": null}, "tie": {"fy": {"to": "fx"}},
          "prior": {"k1": {"mean": 0, "sd": 0.5}}})");
  EXPECT_TRUE(good.options.choose_lens);
  EXPECT_EQ(good.options.settings.fixed.at("cx"), 960);
  EXPECT_EQ(good.options.settings.tied.at("fy").to, "fx");
  double last = 0;
  const Calibration found = carry_out(read(R"({"points": "points.csv", "size": "1920x1080"})"),
                                      [&](double share, const std::string&) { last = share; });
  EXPECT_NEAR(found.parameters[kFx], 1200, 30);
  EXPECT_GT(last, 0.5);
  const auto error = [&](const char* text) { return error_of([&] { read(text); }); };
  EXPECT_THAT(error(R"({"points": "../points.csv", "size": "9x9"})"), HasSubstr("/points"));
  EXPECT_THAT(error(R"({"points": "other.csv", "size": "9x9"})"), HasSubstr("/points"));
  EXPECT_THAT(error(R"({"points": "points.csv"})"), HasSubstr("the size of the images"));
  EXPECT_THAT(error(R"({"kind": "guess"})"), HasSubstr("/kind"));
  EXPECT_THAT(error(R"({"colour": 1})"), HasSubstr("/colour"));
  EXPECT_THAT(error(R"({"board": {"columns": 1.5}})"), HasSubstr("/board/columns"));
  EXPECT_THAT(error(R"({"kind": "pose"})"), HasSubstr("observed points"));
  EXPECT_THAT(error(R"([1])"), HasSubstr("an object"));
  EXPECT_THAT(error(R"({"fix": {"k1": "a"}})"), HasSubstr("/fix/k1"));
}

TEST_F(Files, RequestsSayAllThatIsWrongWithThem) {
  const auto error = [&](const char* text) {
    return error_of([&] { request_from_json(json::parse(text), base_); });
  };
  const std::string all = error(
      R"({"knd": "pose", "skew": 1, "loss_px": -1, "lens": "brown6", "images": ["a.jpg"],
          "board": {"colums": 9, "rows": 2}, "tie": {"fx": {"ratio": 1}},
          "prior": {"cx": {"mean": 1, "sd": 0}}})");
  for (const char* expected :
       {R"(/knd: unknown field "knd"; did you mean "kind"?)",
        "/skew: found 1, expected true or false",
        "/loss_px: found -1, expected a number of at least 0",
        R"(/lens: found "brown6", expected one of "auto", "pinhole")",
        R"(/images/0: found "a.jpg", expected the name of a file that was sent along)",
        R"(/board/colums: unknown field "colums"; did you mean "columns"?)",
        "/board/rows: found 2, expected an integer from 3 to 100", "/tie/fx/to: found nothing",
        "/prior/cx/sd: found 0, expected a number above 0"}) {
    EXPECT_THAT(all, HasSubstr(expected));
  }
  EXPECT_THAT(error(R"({"images": "a.jpg"})"), HasSubstr("expected a list of files"));
}

}  // namespace
}  // namespace throng::calibrate
