// WILDTRACK (Chavdarova et al. 2018): people seen by several cameras at once, by their place on the
// ground. Each run is a set of its own; it is written when it is over, since the grid of places
// spans all of it.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/dataset/image_camera.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

constexpr double kCellM = 0.025;      // WILDTRACK's
constexpr double kCentimeters = 100;  // WILDTRACK's unit of calibrations, in a meter

// A camera that stays within these is fixed: less than a pixel at 10 m and more.
constexpr double kFixedM = 0.01;
constexpr double kFixedRad = 1e-3;

/// A body's box in whole pixels of the image, the last ones included.
using ViewBox = std::array<int, 4>;  // xmin, ymin, xmax, ymax

struct Sighting {
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();
  bool is_seen = false;          ///< by a camera: then it has a place
  std::map<int, ViewBox> views;  ///< by the camera's number
};

struct View {
  std::string name;  ///< the drone's
  camera::Camera camera;
  std::map<std::int64_t, camera::Pose> poses;  ///< by frame
};

/// In box coordinates; nothing of it may be in the image.
bool find_view_box(const Image& image, const Box& box, ViewBox& pixels) {
  const auto low = [](double value) { return std::max(static_cast<int>(std::floor(value)), 0); };
  const auto high = [](double value, int size) {
    return std::min(static_cast<int>(std::ceil(value)), size) - 1;
  };
  pixels = {low(box.x), low(box.y), high(box.x + box.width, image.width),
            high(box.y + box.height, image.height)};
  return pixels[0] <= pixels[2] && pixels[1] <= pixels[3];
}

bool is_fixed(const View& view) {
  const camera::Pose& first = view.poses.begin()->second;
  return std::all_of(view.poses.begin(), view.poses.end(), [&](const auto& entry) {
    const camera::Pose& pose = entry.second;
    const double turned_rad = Eigen::AngleAxisd(pose.R * first.R.transpose()).angle();
    return (pose.center() - first.center()).norm() <= kFixedM && turned_rad <= kFixedRad;
  });
}

/// A matrix as cv::FileStorage has it in XML, row by row.
void append_matrix(std::string& xml, const char* name, int rows, int columns,
                   const std::vector<double>& values) {
  fmt::format_to(std::back_inserter(xml),
                 "<{} type_id=\"opencv-matrix\">\n  <rows>{}</rows>\n  <cols>{}</cols>\n"
                 "  <dt>d</dt>\n  <data>\n   ",
                 name, rows, columns);
  for (const double value : values) fmt::format_to(std::back_inserter(xml), " {}", value);
  xml += fmt::format("</data></{}>\n", name);
}

std::string opencv_storage(const std::string& content) {
  return "<?xml version=\"1.0\"?>\n<opencv_storage>\n" + content + "</opencv_storage>\n";
}

std::string intrinsics_xml(const camera::Intrinsics& k) {
  std::string xml;
  append_matrix(xml, "camera_matrix", 3, 3,
                {k.fx_px, k.skew_px, k.cx_px, 0, k.fy_px, k.cy_px, 0, 0, 1});
  std::vector<double> coefficients(5, 0);
  bool is_fisheye = false;
  if (k.distortion) {
    is_fisheye = k.distortion->model() == camera::Distortion::Model::fisheye;
    const auto& all = k.distortion->coefficients();
    coefficients.assign(all.begin(), is_fisheye ? all.begin() + 4 : all.end());
  }
  append_matrix(xml, "distortion_coefficients", 1, static_cast<int>(coefficients.size()),
                coefficients);
  if (is_fisheye) xml += "<model>fisheye</model>\n";
  return opencv_storage(xml);
}

std::string extrinsics_xml(const camera::Pose& pose) {
  const Eigen::AngleAxisd turn(pose.R);
  const Eigen::Vector3d r = turn.angle() * turn.axis();
  const Eigen::Vector3d t = kCentimeters * pose.t;
  return opencv_storage(fmt::format("<rvec>\n  {} {} {}</rvec>\n<tvec>\n  {} {} {}</tvec>\n", r.x(),
                                    r.y(), r.z(), t.x(), t.y(), t.z()));
}

/// Places on the ground that people of a run are at.
struct PlaceGrid {
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  ///< of cell 0
  std::int64_t columns = 1;                            ///< along x
  std::int64_t rows = 1;

  std::int64_t cell_of(const Eigen::Vector2d& place_m) const {
    const Eigen::Vector2d cell = ((place_m - origin_m) / kCellM).array().round();
    return static_cast<std::int64_t>(cell.x()) + columns * static_cast<std::int64_t>(cell.y());
  }
};

class WildtrackExporter : public Exporter {
 public:
  WildtrackExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    if (image.run != run_) write_run();
    run_ = image.run;
    folder_ = fmt::format("{}/{}", to_string(image.split), image.run);
    const int view = view_of(image);
    views_[static_cast<std::size_t>(view)].poses[image.frame] = {image.R, image.t};
    output_.link(fmt::format("{}/Image_subsets/C{}/{:08}.jpg", folder_, view + 1, image.frame),
                 info_.root / image.file);
    std::map<std::int64_t, Sighting>& people = frames_[image.frame];
    const auto add_box = [&](std::int64_t person, const Box& box) {
      ViewBox pixels;
      if (find_view_box(image, box, pixels)) people[person].views[view] = pixels;
    };
    for (const HiddenPerson& person : image.hidden) {
      if (!person.is_ignored) add_box(person.number_in_run(), person.amodal);
    }
    for (const Person& person : image.people) {
      if (person.is_ignored) continue;
      add_box(person.number_in_run(), person.amodal);
      Sighting& sighting = people[person.number_in_run()];
      sighting.is_seen = true;
      sighting.place_m = person.position.head<2>();
    }
  }

  void finish() override { write_run(); }

  std::vector<Problem> warnings() const override {
    std::vector<Problem> warnings;
    if (!moving_.empty()) {
      std::string names;
      for (const std::string& name : moving_) names += (names.empty() ? "" : ", ") + name;
      warnings.push_back({"", "wildtrack", "cameras that move: " + names,
                          "hovering drones without wind; these have extrinsics for each frame"});
    }
    if (is_single_) {
      warnings.push_back(
          {"", "wildtrack", "runs with one camera", "two or more drones, whose views are joined"});
    }
    return warnings;
  }

 private:
  /// The number of an image's camera in its run, from 0.
  int view_of(const Image& image) {
    const auto found = std::find_if(views_.begin(), views_.end(),
                                    [&](const View& view) { return view.name == image.camera; });
    if (found != views_.end()) return static_cast<int>(found - views_.begin());
    views_.push_back({image.camera, image_camera(image), {}});
    return static_cast<int>(views_.size()) - 1;
  }

  void write_run() {
    if (views_.empty()) return;
    is_single_ = is_single_ || views_.size() == 1;
    for (std::size_t view = 0; view < views_.size(); ++view) write_calibration(view);
    const PlaceGrid grid = grid_of_run();
    for (const auto& [frame, people] : frames_) {
      output_.write(fmt::format("{}/annotations_positions/{:08}.json", folder_, frame),
                    grid_positions(people, grid).dump(1) + "\n");
    }
    write_grid(grid);
    views_.clear();
    frames_.clear();
  }

  void write_calibration(std::size_t number) {
    const View& view = views_[number];
    const std::string folder = folder_ + "/calibrations/";
    const camera::Intrinsics& intrinsics = view.camera.intrinsics;
    output_.write(fmt::format("{}intrinsic_{}/intr_C{}.xml", folder,
                              intrinsics.distortion ? "original" : "zero", number + 1),
                  intrinsics_xml(intrinsics));
    if (is_fixed(view)) {
      output_.write(fmt::format("{}extrinsic/extr_C{}.xml", folder, number + 1),
                    extrinsics_xml(view.poses.begin()->second));
      return;
    }
    moving_.insert(view.name);
    for (const auto& [frame, pose] : view.poses) {
      output_.write(fmt::format("{}extrinsic/C{}/{:08}.xml", folder, number + 1, frame),
                    extrinsics_xml(pose));
    }
  }

  PlaceGrid grid_of_run() const {
    Eigen::AlignedBox2d bounds;
    for (const auto& [frame, people] : frames_) {
      for (const auto& [id, sighting] : people) {
        if (sighting.is_seen) bounds.extend(sighting.place_m);
      }
    }
    if (bounds.isEmpty()) return {};
    PlaceGrid grid;
    grid.origin_m = bounds.min().array().floor();
    const Eigen::Vector2d last = ((bounds.max() - grid.origin_m) / kCellM).array().ceil();
    grid.columns = static_cast<std::int64_t>(last.x()) + 1;
    grid.rows = static_cast<std::int64_t>(last.y()) + 1;
    return grid;
  }

  nlohmann::json grid_positions(const std::map<std::int64_t, Sighting>& people,
                                const PlaceGrid& grid) const {
    nlohmann::json positions = nlohmann::json::array();
    for (const auto& [id, sighting] : people) {
      if (!sighting.is_seen || sighting.views.empty()) continue;
      nlohmann::json views = nlohmann::json::array();
      for (int view = 0; view < static_cast<int>(views_.size()); ++view) {
        const auto found = sighting.views.find(view);
        const ViewBox box = found == sighting.views.end() ? ViewBox{-1, -1, -1, -1} : found->second;
        views.push_back({{"viewNum", view},
                         {"xmin", box[0]},
                         {"ymin", box[1]},
                         {"xmax", box[2]},
                         {"ymax", box[3]}});
      }
      positions.push_back({{"personID", id},
                           {"positionID", grid.cell_of(sighting.place_m)},
                           {"views", std::move(views)}});
    }
    return positions;
  }

  void write_grid(const PlaceGrid& grid) const {
    nlohmann::json cameras = nlohmann::json::array();
    for (const View& view : views_) cameras.push_back(view.name);
    const nlohmann::json content = {{"origin_m", {grid.origin_m.x(), grid.origin_m.y()}},
                                    {"cell_m", kCellM},
                                    {"columns", grid.columns},
                                    {"rows", grid.rows},
                                    {"cameras", std::move(cameras)},
                                    {"rate_hz", info_.rate_hz},
                                    {"from_s", info_.from_s}};
    output_.write(folder_ + "/grid.json", content.dump(1) + "\n");
  }

  const DatasetInfo& info_;
  Output output_;
  std::string run_;
  std::string folder_;                                               ///< of the run
  std::vector<View> views_;                                          ///< of the run, by number
  std::map<std::int64_t, std::map<std::int64_t, Sighting>> frames_;  ///< of the run, by person
  std::set<std::string> moving_;
  bool is_single_ = false;
};

}  // namespace

ExporterPointer make_wildtrack(const DatasetInfo& info, Output output) {
  return std::make_unique<WildtrackExporter>(info, std::move(output));
}

}  // namespace throng::formats
