// throng calibrate: lenses and poses of real cameras, from images of boards, points and control
// points.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/drawing/drawing.h"
#include "calibration/board.h"
#include "calibration/request.h"
#include "calibration/residual_plot.h"
#include "calibration/result.h"
#include "cli/more/more_commands.h"
#include "cli/shell/input_file.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "spec/calibration/foreign/read_camera_file.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;

struct CalibrateArguments {
  calibrate::Request request;
  std::string board = "chessboard";
  std::string size;
  std::string lens = "brown5";
  std::vector<std::string> fixed;
  std::vector<std::string> tied;
  std::vector<std::string> priors;
  bool keep_outliers = false;
  double sigma_px = 0;
  std::string output;
  std::string opencv;
  std::string ros;
  std::string plot;
};

double parse_number(const std::string& text, const std::string& source, const std::string& whole) {
  try {
    std::size_t end = 0;
    const double value = std::stod(text, &end);
    if (end == text.size()) return value;
  } catch (const std::exception&) {
    // said below
  }
  throw InputError(Problem{source, "", fmt::format("\"{}\"", whole), "a number after the sign"});
}

/// "name<sign>rest"; an empty rest when the sign is not there.
std::pair<std::string, std::string> split(const std::string& text, char sign) {
  const std::size_t at = text.find(sign);
  if (at == std::string::npos) return {text, ""};
  return {text.substr(0, at), text.substr(at + 1)};
}

calibrate::ParameterSettings read_wishes(const CalibrateArguments& arguments) {
  calibrate::ParameterSettings settings = arguments.request.options.settings;
  for (const std::string& text : arguments.fixed) {
    const auto [name, value] = split(text, '=');
    settings.fixed[name] =
        value.empty() ? std::nullopt : std::optional(parse_number(value, "--fix", text));
  }
  for (const std::string& text : arguments.tied) {
    const auto [name, rest] = split(text, '=');
    const auto [to, ratio] = split(rest, '*');
    settings.tied[name] = {to, ratio.empty() ? 1 : parse_number(ratio, "--tie", text)};
  }
  for (const std::string& text : arguments.priors) {
    const auto [name, rest] = split(text, '=');
    const auto [mean, sd] = split(rest, ':');
    settings.priors[name] = {parse_number(mean, "--prior", text),
                             parse_number(sd, "--prior", text)};
  }
  return settings;
}

void write_results(const calibrate::Calibration& calibration, const CalibrateArguments& arguments) {
  const std::string json = calibrate::to_json(calibration).dump(2) + "\n";
  if (arguments.output.empty()) {
    fmt::print("{}", json);
    fmt::print(stderr, "{}", calibrate::summary(calibration));
  } else {
    write_file_atomically(arguments.output, json);
    fmt::print("{}{}\n", calibrate::summary(calibration), arguments.output);
  }
  if (!arguments.opencv.empty()) {
    write_file_atomically(arguments.opencv, calibrate::opencv_yaml(calibration));
  }
  if (!arguments.ros.empty()) {
    write_file_atomically(arguments.ros,
                          calibrate::ros_yaml(calibration, fs::path(arguments.ros).stem()));
  }
  if (!arguments.plot.empty()) {
    drawing::write_drawing(calibrate::residual_plot(calibration), arguments.plot);
  }
}

/// Images and tables are not written over.
void check_outputs(const CalibrateArguments& arguments) {
  const calibrate::Request& request = arguments.request;
  std::vector<std::string> inputs(request.images.begin(), request.images.end());
  for (const fs::path* input : {&request.points, &request.observations, &request.control_points}) {
    inputs.push_back(input->string());
  }
  for (const auto& [option, output] :
       {std::pair{"--output", &arguments.output}, std::pair{"--opencv", &arguments.opencv},
        std::pair{"--ros", &arguments.ros}, std::pair{"--plot", &arguments.plot}}) {
    check_output_file(option, *output, inputs);
  }
}

void run(CalibrateArguments& arguments, const std::string& kind) {
  calibrate::Request& request = arguments.request;
  request.kind = kind;
  request.options.source = "throng calibrate " + kind;
  request.board.kind = calibrate::board_kind_named(arguments.board, "--board");
  calibrate::check_board(request.board, "--board");
  if (!arguments.size.empty()) {
    request.size = calibrate::parse_image_size(arguments.size, "--size");
  }
  request.options.choose_lens = arguments.lens == "auto";
  if (!request.options.choose_lens) {
    request.options.lens = calibrate::lens_named(arguments.lens, "--lens");
  }
  request.options.settings = read_wishes(arguments);
  request.options.fit.reject = !arguments.keep_outliers;
  if (arguments.sigma_px > 0) request.options.fit.sigma_px = arguments.sigma_px;
  check_outputs(arguments);
  const Interrupt interrupt;
  request.options.fit.should_continue = [&] { return !interrupt.token().stop_requested(); };
  calibrate::Calibration calibration;
  {
    ProgressBar bar("calibrating");
    calibration = calibrate::carry_out(
        request, [&](double share, const std::string& what) { bar.show(share, what); });
  }
  write_results(calibration, arguments);
}

void add_results(CLI::App& command, CalibrateArguments& arguments) {
  command.add_option("-o,--output", arguments.output,
                     "Camera JSON to write; default: standard output");
  command.add_option("--opencv", arguments.opencv, "Also write OpenCV's YAML");
  command.add_option("--ros", arguments.ros, "Also write ROS' camera_info (YAML)");
  command.add_option("--plot", arguments.plot,
                     "Also plot residuals and coverage (.svg, .png or .pdf)");
}

void add_fit(CLI::App& command, CalibrateArguments& arguments) {
  calibrate::FitOptions& fit = arguments.request.options.fit;
  command.add_flag("--keep-outliers", arguments.keep_outliers, "Use every point");
  command
      .add_option("--outlier-px", fit.outlier_px,
                  "Residuals above this and above 6 robust standard deviations are outliers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      .add_option("--loss", fit.loss_px,
                  "Scale of Cauchy's loss, px; 0: least squares once outliers are out")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      .add_option("--sigma", arguments.sigma_px,
                  "Standard deviation of a pixel coordinate, px; default: from the residuals")
      ->check(CLI::PositiveNumber);
}

void add_lens(CLI::App& command, CalibrateArguments& arguments) {
  command.add_flag("--skew", arguments.request.options.settings.skew, "Estimate the skew, too");
  command.add_option("--fix", arguments.fixed,
                     "NAME or NAME=VALUE: keep a parameter (k3, cx=320); repeatable");
  command.add_option("--tie", arguments.tied,
                     "NAME=OTHER or NAME=OTHER*RATIO: fx=fy for square pixels; repeatable");
  command.add_option("--prior", arguments.priors,
                     "NAME=MEAN:DEVIATION: prior of a parameter (cx=320:20); repeatable");
}

void add_intrinsics(CLI::App& app) {
  auto* command = app.add_subcommand(
      "intrinsics", "Calibrate the lens from images of a board or from points and their pixels");
  const auto arguments = std::make_shared<CalibrateArguments>();
  calibrate::Request& request = arguments->request;
  command->add_option("images", request.images, "Images of the board");
  command->add_option("--points", request.points,
                      "Instead of images: CSV with the columns image,i,X,Y,Z,u,v");
  command->add_option("--size", arguments->size, "WIDTHxHEIGHT of the images of --points");
  command->add_option("--board", arguments->board, "chessboard, charuco or circles (asymmetric)")
      ->capture_default_str();
  command
      ->add_option("--columns", request.board.columns,
                   "Inner corners of a chessboard, squares of ChArUco, circles in a row")
      ->capture_default_str();
  command->add_option("--rows", request.board.rows, "The same in the other direction")
      ->capture_default_str();
  command
      ->add_option("--square", request.board.square,
                   "Side of a square (circles: half the distance in a row), in any unit")
      ->capture_default_str();
  command->add_option("--marker", request.board.marker,
                      "Side of a ChArUco marker; default: 0.75 squares");
  command->add_option("--dictionary", request.board.dictionary, "Of ChArUco's markers")
      ->capture_default_str();
  command
      ->add_option("--lens", arguments->lens,
                   "pinhole, brown2, brown4, brown5, brown8, fisheye, or auto (least BIC)")
      ->capture_default_str();
  add_lens(*command, *arguments);
  add_fit(*command, *arguments);
  add_results(*command, *arguments);
  command->callback([arguments] { run(*arguments, "intrinsics"); });
}

CLI::App* add_with_control_points(CLI::App& app, const char* name, const char* text,
                                  const std::shared_ptr<CalibrateArguments>& arguments) {
  auto* command = app.add_subcommand(name, text);
  calibrate::Request& request = arguments->request;
  command->add_option("--camera", request.camera, "Camera JSON of throng calibrate")->required();
  command
      ->add_option("--gcp", request.control_points,
                   "Ground control points: CSV with the columns point,X,Y,Z and, if known, sd (m)")
      ->required();
  command
      ->add_option("--observations", request.observations,
                   "Image observations: CSV with the columns image,point,u,v")
      ->required();
  add_fit(*command, *arguments);
  add_results(*command, *arguments);
  return command;
}

/// Other programs' files as throng's, which jobs, the service and the Python package take.
void add_camera(CLI::App& app) {
  struct Arguments {
    std::string file;
    std::string output;
  };
  auto* command = app.add_subcommand(
      "camera", "Convert a camera file of ROS, OpenCV, Kalibr or COLMAP to throng's JSON");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("file", arguments->file, "The file; FILE#NAME is one camera of several")
      ->required();
  command->add_option("-o,--output", arguments->output,
                      "Camera JSON to write; default: standard output");
  command->callback([arguments] {
    check_output_file("--output", arguments->output, {arguments->file});
    const std::string json =
        calibrate::to_json(calibrate::read_camera_file(arguments->file)).dump(2) + "\n";
    if (arguments->output.empty()) {
      fmt::print("{}", json);
    } else {
      write_file_atomically(arguments->output, json);
    }
  });
}

}  // namespace

void add_calibrate(CLI::App& app) {
  auto* command = app.add_subcommand("calibrate", "Calibrate real cameras for use in jobs");
  command->require_subcommand(1);
  add_intrinsics(*command);
  const auto pose = std::make_shared<CalibrateArguments>();
  add_with_control_points(*command, "pose",
                          "Estimate the pose of a calibrated camera from control points", pose)
      ->callback([pose] { run(*pose, "pose"); });
  const auto bundle = std::make_shared<CalibrateArguments>();
  auto* adjust = add_with_control_points(
      *command, "bundle", "Bundle adjustment: poses, points and lens of several images", bundle);
  adjust->add_flag("--fix-lens", bundle->request.fix_lens, "Keep the camera's lens fixed");
  add_lens(*adjust, *bundle);
  adjust->callback([bundle] { run(*bundle, "bundle"); });
  add_camera(*command);
  add_calibrate_selftest(*command);
}

}  // namespace throng::cli
