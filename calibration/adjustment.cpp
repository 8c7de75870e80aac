#include "calibration/adjustment.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <glog/logging.h>

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/error.h"
#include "calibration/projection.h"

namespace throng::calibrate {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kPoseNumbers = 6;
constexpr int kPointNumbers = 3;
constexpr int kLensNumbers = static_cast<int>(kParameters);

/// Data shared by all residuals of an adjustment.
struct Model {
  bool fisheye;
  const Rules* rules;
  double sigma_px;
};

template <typename T>
bool reproject(const Model& model, const Vector2d& observed, const T* lens, const T* pose,
               const T* point, T* residual) {
  std::array<T, kParameters> full;
  for (std::size_t i = 0; i < kParameters; ++i) {
    full[i] = model.rules->ratio[i] * lens[model.rules->source[i]];
  }
  std::array<T, kPointNumbers> seen;
  ceres::AngleAxisRotatePoint(pose, point, seen.data());
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += pose[kPointNumbers + i];
  std::array<T, 2> pixel;
  if (!project(model.fisheye, full.data(), seen.data(), pixel.data())) return false;
  residual[0] = (pixel[0] - observed.x()) / model.sigma_px;
  residual[1] = (pixel[1] - observed.y()) / model.sigma_px;
  return true;
}

struct KnownPointCost {
  Model model;
  Vector2d observed;
  Vector3d point;

  template <typename T>
  bool operator()(const T* lens, const T* pose, T* residual) const {
    const std::array<T, kPointNumbers> p = {T(point.x()), T(point.y()), T(point.z())};
    return reproject(model, observed, lens, pose, p.data(), residual);
  }
};

struct FreePointCost {
  Model model;
  Vector2d observed;

  template <typename T>
  bool operator()(const T* lens, const T* pose, const T* point, T* residual) const {
    return reproject(model, observed, lens, pose, point, residual);
  }
};

struct LensPriorCost {
  std::size_t place;
  Prior prior;

  template <typename T>
  bool operator()(const T* lens, T* residual) const {
    residual[0] = (lens[place] - prior.mean) / prior.sd;
    return true;
  }
};

struct PointPriorCost {
  Vector3d measured;
  double sd;

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    for (int i = 0; i < kPointNumbers; ++i) residual[i] = (point[i] - measured[i]) / sd;
    return true;
  }
};

/// The adjustment as Ceres has it, on numbers of its own.
class CeresProblem {
 public:
  CeresProblem(const Adjustment& adjustment, double loss_px)
      : lens_(adjustment.parameters),
        model_{adjustment.lens == Lens::fisheye, &adjustment.rules, adjustment.sigma_px} {
    for (const ViewPose& pose : adjustment.poses) {
      poses_.push_back({pose.rotation.x(), pose.rotation.y(), pose.rotation.z(),
                        pose.translation.x(), pose.translation.y(), pose.translation.z()});
    }
    for (const WorldPoint& point : adjustment.points) points_.push_back(point.position);
    const double scale = loss_px / adjustment.sigma_px;
    for (const Observation& seen : adjustment.observations) {
      if (seen.used) add(adjustment, seen, scale);
    }
    add_points(adjustment);
    add_lens(adjustment);
  }

  ceres::Problem& problem() { return problem_; }
  std::size_t lens_unknowns() const { return lens_free_; }

  /// The blocks with unknowns: the lens (if any is free), poses, points.
  std::vector<double*> free_blocks() {
    std::vector<double*> blocks;
    if (lens_free_ > 0) blocks.push_back(lens_.data());
    for (auto& pose : poses_) {
      if (problem_.HasParameterBlock(pose.data())) blocks.push_back(pose.data());
    }
    for (Vector3d& point : points_) {
      if (problem_.HasParameterBlock(point.data())) blocks.push_back(point.data());
    }
    return blocks;
  }

  /// Eliminates points first where there are any, else poses.
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering() {
    auto order = std::make_shared<ceres::ParameterBlockOrdering>();
    bool any_point = false;
    for (Vector3d& point : points_) {
      if (!problem_.HasParameterBlock(point.data())) continue;
      order->AddElementToGroup(point.data(), 0);
      any_point = true;
    }
    for (auto& pose : poses_) {
      if (problem_.HasParameterBlock(pose.data())) {
        order->AddElementToGroup(pose.data(), any_point ? 1 : 0);
      }
    }
    if (problem_.HasParameterBlock(lens_.data())) order->AddElementToGroup(lens_.data(), 1);
    return order;
  }

  void copy_to(Adjustment& adjustment) const {
    adjustment.parameters = lens_;
    apply_ties(adjustment.rules, adjustment.parameters);
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      adjustment.poses[i].rotation = Vector3d(poses_[i][0], poses_[i][1], poses_[i][2]);
      adjustment.poses[i].translation = Vector3d(poses_[i][3], poses_[i][4], poses_[i][5]);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) adjustment.points[i].position = points_[i];
  }

 private:
  void add(const Adjustment& adjustment, const Observation& seen, double loss_scale) {
    // Ceres owns what it is given.
    auto loss = loss_scale > 0 ? std::make_unique<ceres::CauchyLoss>(loss_scale) : nullptr;
    double* pose = poses_[seen.view].data();
    if (adjustment.points[seen.point].sd == 0.0) {
      using Cost = ceres::AutoDiffCostFunction<KnownPointCost, 2, kLensNumbers, kPoseNumbers>;
      auto residual = std::make_unique<KnownPointCost>(
          KnownPointCost{model_, seen.pixel, adjustment.points[seen.point].position});
      problem_.AddResidualBlock(std::make_unique<Cost>(residual.release()).release(),
                                loss.release(), lens_.data(), pose);
      return;
    }
    using Cost =
        ceres::AutoDiffCostFunction<FreePointCost, 2, kLensNumbers, kPoseNumbers, kPointNumbers>;
    auto residual = std::make_unique<FreePointCost>(FreePointCost{model_, seen.pixel});
    problem_.AddResidualBlock(std::make_unique<Cost>(residual.release()).release(), loss.release(),
                              lens_.data(), pose, points_[seen.point].data());
  }

  void add_points(const Adjustment& adjustment) {
    using Cost = ceres::AutoDiffCostFunction<PointPriorCost, kPointNumbers, kPointNumbers>;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const WorldPoint& point = adjustment.points[i];
      if (!problem_.HasParameterBlock(points_[i].data()) || !point.sd) continue;
      auto residual = std::make_unique<PointPriorCost>(PointPriorCost{point.measured, *point.sd});
      problem_.AddResidualBlock(std::make_unique<Cost>(residual.release()).release(), nullptr,
                                points_[i].data());
    }
  }

  void add_lens(const Adjustment& adjustment) {
    if (!problem_.HasParameterBlock(lens_.data())) return;
    std::vector<int> constant;
    for (std::size_t i = 0; i < kParameters; ++i) {
      if (adjustment.rules.free[i]) {
        ++lens_free_;
      } else {
        constant.push_back(static_cast<int>(i));
      }
    }
    if (lens_free_ == 0) {
      problem_.SetParameterBlockConstant(lens_.data());
      return;
    }
    if (!constant.empty()) {
      problem_.SetManifold(
          lens_.data(), std::make_unique<ceres::SubsetManifold>(kLensNumbers, constant).release());
    }
    using Cost = ceres::AutoDiffCostFunction<LensPriorCost, 1, kLensNumbers>;
    for (std::size_t i = 0; i < kParameters; ++i) {
      if (!adjustment.rules.priors[i]) continue;
      auto residual =
          std::make_unique<LensPriorCost>(LensPriorCost{i, *adjustment.rules.priors[i]});
      problem_.AddResidualBlock(std::make_unique<Cost>(residual.release()).release(), nullptr,
                                lens_.data());
    }
  }

  Parameters lens_;
  std::vector<std::array<double, kPoseNumbers>> poses_;
  std::vector<Vector3d> points_;
  Model model_;
  std::size_t lens_free_ = 0;
  ceres::Problem problem_;
};

class ContinueCallback : public ceres::IterationCallback {
 public:
  explicit ContinueCallback(const std::function<bool()>& should_continue)
      : should_continue_(&should_continue) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    return (*should_continue_)() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_ABORT;
  }

 private:
  const std::function<bool()>* should_continue_;
};

using Sparse = Eigen::SparseMatrix<double>;

/// J'J at the solution.
Sparse normal_matrix(CeresProblem& ceres) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = ceres.free_blocks();
  options.apply_loss_function = false;
  ceres::CRSMatrix crs;
  check(ceres.problem().Evaluate(options, nullptr, nullptr, nullptr, &crs),
        "the solution can be evaluated");
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> jacobian(
      crs.num_rows, crs.num_cols, static_cast<Eigen::Index>(crs.values.size()), crs.rows.data(),
      crs.cols.data(), crs.values.data());
  return jacobian.transpose() * jacobian;
}

/// Largest entries of the direction in which the scaled matrix is (nearly) singular.
std::vector<Eigen::Index> open_directions(const Sparse& scaled) {
  constexpr double kShift = 1e-12;
  constexpr int kRounds = 4;
  constexpr double kTakesPart = 0.2;
  Sparse shifted = scaled;
  for (Eigen::Index i = 0; i < shifted.rows(); ++i) shifted.coeffRef(i, i) += kShift;
  const Eigen::SimplicialLDLT<Sparse> solver(shifted);
  Eigen::VectorXd direction = Eigen::VectorXd::LinSpaced(scaled.rows(), 1, 2).normalized();
  for (int i = 0; i < kRounds; ++i) direction = solver.solve(direction).normalized();
  std::vector<Eigen::Index> entries;
  const double largest_entry = direction.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    if (std::abs(direction[i]) > kTakesPart * largest_entry) entries.push_back(i);
  }
  return entries;
}

void note_open(const std::vector<Eigen::Index>& entries, Linearization& result) {
  for (const Eigen::Index entry : entries) {
    const auto i = static_cast<std::size_t>(entry);
    if (i < result.places.size()) {
      result.undetermined.push_back(result.places[i]);
    } else {
      result.poses_determined = false;
    }
  }
}

}  // namespace

Vector3d ViewPose::to_camera(const Vector3d& world) const {
  Vector3d seen;
  ceres::AngleAxisRotatePoint(rotation.data(), world.data(), seen.data());
  return seen + translation;
}

camera::Pose ViewPose::pose() const {
  camera::Pose pose;
  const double angle = rotation.norm();
  if (angle > 0) pose.R = Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
  pose.t = translation;
  return pose;
}

ViewPose to_view_pose(const camera::Pose& pose) {
  const Eigen::AngleAxisd turn(pose.R);
  return {turn.angle() * turn.axis(), pose.t};
}

Vector2d Adjustment::residual(const Observation& observation) const {
  const Vector3d seen = poses[observation.view].to_camera(points[observation.point].position);
  Vector2d pixel;
  if (!project(lens == Lens::fisheye, parameters.data(), seen.data(), pixel.data())) {
    return Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return pixel - observation.pixel;
}

std::ptrdiff_t Adjustment::surplus() const {
  std::vector<bool> point_seen(points.size(), false);
  std::vector<bool> view_seen(poses.size(), false);
  std::ptrdiff_t count = 0;
  for (const Observation& seen : observations) {
    if (!seen.used) continue;
    count += 2;
    point_seen[seen.point] = true;
    view_seen[seen.view] = true;
  }
  for (std::size_t i = 0; i < kParameters; ++i) {
    count += (rules.priors[i] ? 1 : 0) - (rules.free[i] ? 1 : 0);
  }
  count -= kPoseNumbers * std::count(view_seen.begin(), view_seen.end(), true);
  // One that is measured has as many equations of its own as unknowns.
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (point_seen[i] && !points[i].sd) count -= kPointNumbers;
  }
  return count;
}

SolveReport solve(Adjustment& adjustment, const SolveOptions& options) {
  // A step that fails is tried smaller; nobody needs to read of it.
  FLAGS_minloglevel = google::GLOG_FATAL;
  CeresProblem ceres(adjustment, options.loss_px);
  constexpr std::size_t kDenseViews = 100;
  ceres::Solver::Options solver;
  solver.linear_solver_type =
      adjustment.poses.size() <= kDenseViews ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  solver.linear_solver_ordering = ceres.ordering();
  solver.max_num_iterations = options.max_iterations;
  constexpr double kTolerance = 1e-14;
  solver.function_tolerance = options.tolerance;
  solver.parameter_tolerance = kTolerance;
  solver.gradient_tolerance = kTolerance;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ContinueCallback should_continue(options.should_continue);
  if (options.should_continue) solver.callbacks.push_back(&should_continue);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &ceres.problem(), &summary);
  if (summary.termination_type == ceres::USER_FAILURE) throw Cancelled();
  if (summary.IsSolutionUsable()) ceres.copy_to(adjustment);
  return {
      summary.termination_type == ceres::CONVERGENCE, static_cast<int>(summary.iterations.size()),
      summary.IsSolutionUsable() ? summary.final_cost : std::numeric_limits<double>::infinity()};
}

Linearization linearize(const Adjustment& adjustment) {
  CeresProblem ceres(adjustment, 0);
  Linearization result;
  if (ceres.lens_unknowns() > 0) result.places = adjustment.rules.free_places();
  const Sparse normal = normal_matrix(ceres);
  const Eigen::Index count = normal.rows();
  const Eigen::VectorXd diagonal = normal.diagonal();
  std::vector<Eigen::Index> empty;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!(diagonal[i] > 0)) empty.push_back(i);
  }
  if (!empty.empty()) {
    note_open(empty, result);
    return result;
  }
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  const Sparse scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  const Eigen::SimplicialLDLT<Sparse> factors(scaled);
  // Rounding error of a pivot that should be 0.
  constexpr double kNothing = 1e-13;
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > kNothing)) {
    note_open(open_directions(scaled), result);
    return result;
  }
  const auto wanted =
      static_cast<Eigen::Index>(result.places.size() + kPoseNumbers * adjustment.poses.size());
  const Eigen::Index columns = std::min(wanted, count);
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(count, columns);
  const Eigen::MatrixXd inverse = factors.solve(unit).topRows(columns);
  result.covariance = scale.head(columns).asDiagonal() * inverse * scale.head(columns).asDiagonal();
  return result;
}

}  // namespace throng::calibrate
