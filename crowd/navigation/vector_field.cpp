#include "crowd/navigation/vector_field.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "crowd/elements/number_file.h"
#include "crowd/navigation/navigation.h"
#include "crowd/navigation/steering.h"

namespace throng::crowd {

VectorField::VectorField(const TextFile& source) {
  NumberFile file(source);
  rows_ = file.count("the number of rows", 1, 2);
  columns_ = file.count("the number of columns", 1, 2);
  cell_size_m_ = file.real("the size of a cell in m", 1e-3, 1e4);
  min_.x() = file.real("the least x in m");
  min_.y() = file.real("the least y in m");
  // Rows come one by one, so that a file that is too short fails before much room is made.
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const float x = file.real("x of a vector", -100, 100);
      vectors_.emplace_back(x, file.real("y of a vector", -100, 100));
    }
  }
  if (!file.at_end()) {
    file.fail("more vectors", fmt::format("{} rows of {} vectors", rows_, columns_));
  }
}

const Eigen::Vector2f& VectorField::at(int row, int column) const {
  const int r = std::clamp(row, 0, rows_ - 1);
  const int c = std::clamp(column, 0, columns_ - 1);
  return vectors_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(c)];
}

Eigen::Vector2f VectorField::nearest(const Eigen::Vector2f& point) const {
  const Eigen::Vector2f cell = cell_of(point);
  return at(static_cast<int>(std::floor(cell.y())), static_cast<int>(std::floor(cell.x())));
}

Eigen::Vector2f VectorField::interpolated(const Eigen::Vector2f& point) const {
  const Eigen::Vector2f center = cell_of(point).array() - 0.5F;
  const Eigen::Vector2f corner = center.array().floor();
  const Eigen::Vector2f share = center - corner;
  const int row = static_cast<int>(corner.y());
  const int column = static_cast<int>(corner.x());
  const Eigen::Vector2f below = (1 - share.x()) * at(row, column) + share.x() * at(row, column + 1);
  const Eigen::Vector2f above =
      (1 - share.x()) * at(row + 1, column) + share.x() * at(row + 1, column + 1);
  return (1 - share.y()) * below + share.y() * above;
}

namespace {

class AlongField : public VelComponent {
 public:
  AlongField(std::shared_ptr<const VectorField> field, bool use_nearest)
      : field_(std::move(field)), use_nearest_(use_nearest) {}

  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) override {
    const Eigen::Vector2f& p = crowd.agents.position[agent];
    const Eigen::Vector2f v = use_nearest_ ? field_->nearest(p) : field_->interpolated(p);
    const float length = v.norm();
    constexpr float kNoDirection = 1e-6F;
    if (length > kNoDirection) preferred.direction = v / length;
    preferred.speed = length * crowd.agents[Property::pref_speed][agent];
  }

 private:
  std::shared_ptr<const VectorField> field_;
  bool use_nearest_;
};

std::unique_ptr<VelComponent> make_along_field(const Element& element, const Attributes& attributes,
                                               BehaviorContext& context) {
  const TextFile file = element.text_file(attributes.text("file_name"));
  return std::make_unique<AlongField>(
      context.crowd.parts->get<VectorField>(file.key(),
                                            [&] { return std::make_shared<VectorField>(file); }),
      attributes.boolean("use_nearest"));
}

}  // namespace

VelComponentRegistry::Entry vector_field_component() {
  return {"vel_field",
          "as a field of vectors says, times the preferred speed",
          {text("file_name", "of the field"),
           optional(boolean("use_nearest", "1: one vector per cell, 0: interpolated"), "1")},
          make_along_field};
}

}  // namespace throng::crowd
