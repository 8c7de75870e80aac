#include "calibration/result.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json/problem_json.h"
#include "base/text/words.h"
#include "calibration/warnings.h"
#include "camera/files.h"
#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

using nlohmann::json;

namespace {

json known(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

template <typename Vector>
json vector_json(const Vector& vector) {
  json list = json::array();
  for (Eigen::Index i = 0; i < vector.size(); ++i) list.push_back(known(vector[i]));
  return list;
}

json covariance_json(const Calibration& calibration) {
  if (calibration.covariance.size() == 0) return nullptr;
  json names = json::array();
  for (const std::size_t place : calibration.places) {
    names.push_back(parameter_name(calibration.lens, place));
  }
  json rows = json::array();
  for (Eigen::Index i = 0; i < calibration.covariance.rows(); ++i) {
    rows.push_back(vector_json(Eigen::VectorXd(calibration.covariance.row(i))));
  }
  return {{"parameters", std::move(names)}, {"matrix", std::move(rows)}};
}

json view_json(const ViewResult& view) {
  json outliers = json::array();
  for (const PointResult& point : view.points) {
    if (!point.used) {
      outliers.push_back({{"point", vector_json(point.point)},
                          {"pixel", vector_json(point.pixel)},
                          {"residual_px", vector_json(point.residual)}});
    }
  }
  return {{"image", view.name},
          {"points", view.used()},
          {"rms_px", known(view.rms_px)},
          {"rotation_vector", vector_json(view.pose.rotation)},
          {"translation", vector_json(view.pose.translation)},
          {"camera_centre", vector_json(view.pose.pose().center())},
          {"pose_std", vector_json(view.pose_sd)},
          {"outliers", std::move(outliers)}};
}

std::string yaml_matrix(const char* name, std::size_t rows, std::size_t columns,
                        const std::vector<double>& data) {
  std::vector<std::string> words;
  for (const double value : data) {
    const std::string word = std::isfinite(value) ? fmt::format("{}", value) : ".Nan";
    const bool plain = word.find_first_of(".en") == std::string::npos;
    words.push_back(plain ? word + ".0" : word);
  }
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n",
                     name, rows, columns, fmt::join(words, ", "));
}

json views_document(const ImageSize& size, json views) {
  return {{"width", size.width}, {"height", size.height}, {"views", std::move(views)}};
}

}  // namespace

json points_json(const Correspondences& found) {
  json views = json::array();
  for (const View& view : found.views) {
    json points = json::array();
    for (const Eigen::Vector2d& pixel : view.pixels) {
      points.push_back({{"pixel", vector_json(pixel)}, {"residual_px", nullptr}, {"used", true}});
    }
    views.push_back({{"image", view.name}, {"points", std::move(points)}});
  }
  return views_document(found.size, std::move(views));
}

json points_json(const Calibration& calibration) {
  json views = json::array();
  for (const ViewResult& view : calibration.views) {
    json points = json::array();
    for (const PointResult& point : view.points) {
      points.push_back({{"pixel", vector_json(point.pixel)},
                        {"residual_px", vector_json(point.residual)},
                        {"used", point.used}});
    }
    views.push_back({{"image", view.name}, {"points", std::move(points)}});
  }
  return views_document(calibration.size, std::move(views));
}

json to_json(const Calibration& calibration) {
  json value = to_json(CameraFile{calibration.lens, calibration.parameters, calibration.size});
  value["kind"] = calibration.kind;
  value["rms_px"] = known(calibration.rms_px);
  value["sigma_px"] = known(calibration.sigma_px);
  value["points"] = calibration.points;
  value["outliers"] = calibration.rejected;
  value["coverage"] = image_coverage(calibration);
  value["iterations"] = calibration.iterations;
  value["converged"] = calibration.converged;
  value["std"] = json::object();
  for (std::size_t i = 0; i < kParameters; ++i) {
    const std::string name = parameter_name(calibration.lens, i);
    if (!name.empty()) value["std"][name] = known(calibration.sd.at(i));
  }
  value["covariance"] = covariance_json(calibration);
  value["views"] = json::array();
  for (const ViewResult& view : calibration.views) value["views"].push_back(view_json(view));
  value["left_out"] = json(calibration.left_out);
  value["warnings"] = calibration.warnings;
  for (const ModelScore& score : calibration.models) {
    value["models"].push_back({{"lens", to_string(score.lens)},
                               {"unknowns", score.unknowns},
                               {"rms_px", score.rms_px},
                               {"bic", score.bic}});
  }
  return value;
}

std::string opencv_yaml(const Calibration& calibration) {
  std::string text = camera::opencv_yaml(calibration.intrinsics());
  const Parameters& sd = calibration.sd;
  text += yaml_matrix("std_deviations_intrinsics", 1, kParameters - 1,
                      {sd[kFx], sd[kFy], sd[kCx], sd[kCy], sd[5], sd[6], sd[7], sd[8], sd[9],
                       sd[10], sd[11], sd[12]});
  text += fmt::format("avg_reprojection_error: {}\nnframes: {}\n", calibration.rms_px,
                      calibration.views.size());
  std::vector<double> errors;
  std::vector<double> poses;
  for (const ViewResult& view : calibration.views) {
    errors.push_back(view.rms_px);
    poses.insert(poses.end(), view.pose.rotation.begin(), view.pose.rotation.end());
    poses.insert(poses.end(), view.pose.translation.begin(), view.pose.translation.end());
  }
  constexpr std::size_t kNumbersOfAPose = 6;
  return text + yaml_matrix("per_view_reprojection_errors", errors.size(), 1, errors) +
         yaml_matrix("extrinsic_parameters", calibration.views.size(), kNumbersOfAPose, poses);
}

std::string ros_yaml(const Calibration& calibration, const std::string& camera_name) {
  return camera::ros_yaml(calibration.intrinsics(), camera_name);
}

std::string summary(const Calibration& calibration) {
  std::string text = fmt::format(
      "{}: {}, {} ({}), RMS {:.4f} px, {} x {} px, lens {}\n", calibration.kind,
      counted(static_cast<std::int64_t>(calibration.views.size()), "view"),
      counted(static_cast<std::int64_t>(calibration.points), "point"),
      counted(static_cast<std::int64_t>(calibration.rejected), "outlier"), calibration.rms_px,
      calibration.size.width, calibration.size.height, to_string(calibration.lens));
  for (std::size_t i = 0; i < kParameters; ++i) {
    const std::string name = parameter_name(calibration.lens, i);
    if (name.empty() || (calibration.sd.at(i) == 0 && calibration.parameters.at(i) == 0)) continue;
    text += fmt::format("  {:<5}{:>14.6g} +- {:.2g}\n", name, calibration.parameters.at(i),
                        calibration.sd.at(i));
  }
  for (const ViewResult& view : calibration.views) {
    text +=
        fmt::format("  {}: {} of {}, RMS {:.4f} px\n", view.name, view.used(),
                    counted(static_cast<std::int64_t>(view.points.size()), "point"), view.rms_px);
    if (calibration.kind == "intrinsics") continue;
    const Eigen::Vector3d at = view.pose.pose().center();
    text += fmt::format("    camera at {:.4f} {:.4f} {:.4f}\n", at.x(), at.y(), at.z());
  }
  for (const ModelScore& score : calibration.models) {
    text += fmt::format("  model {:<8} BIC {:12.1f}  RMS {:.4f} px\n", to_string(score.lens),
                        score.bic, score.rms_px);
  }
  for (const Problem& problem : calibration.left_out) {
    text += fmt::format("left out: {}\n", problem.text());
  }
  for (const std::string& warning : calibration.warnings) {
    text += fmt::format("warning: {}\n", warning);
  }
  return text;
}

}  // namespace throng::calibrate
