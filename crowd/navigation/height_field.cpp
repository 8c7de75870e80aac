#include "crowd/navigation/height_field.h"

#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <cmath>

#include "base/files/files.h"
#include "crowd/description/menge_files/read.h"
#include "crowd/elements/element.h"
#include "crowd/navigation/navigation.h"

namespace throng::crowd {

namespace {

struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // row by row from the top
};

GrayImage read_gray_png(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const auto fail = [&](std::string found) {
    throw InputError(
        Problem{path.filename().string(), "the image", std::move(found), "a PNG image"});
  };
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) {
    fail(header.message);
  }
  header.format = PNG_FORMAT_GRAY;
  constexpr std::uint64_t kMaxPixels = 64'000'000;
  const std::uint64_t pixels = std::uint64_t{header.width} * header.height;
  if (pixels > kMaxPixels) {
    const std::string size = fmt::format("{} x {} pixels", header.width, header.height);
    png_image_free(&header);
    fail(size);
  }
  GrayImage image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.pixels.resize(PNG_IMAGE_SIZE(header));
  if (png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr) == 0) {
    fail(header.message);
  }
  return image;
}

}  // namespace

HeightField::HeightField(const std::filesystem::path& path) {
  const Description description = read_description(path, "HeightField");
  Reading file(description, "HeightField");
  const Attributes attributes(
      file.root(),
      {text("file_name", "of the image"), number("cell_size", "of a pixel in m", 1e-3, 1e4),
       number("vert_scale", "height of white in m", -1e4, 1e4),
       optional(number("x", "least x of the image in m"), "0"),
       optional(number("y", "least y of the image in m"), "0"),
       optional(text("kernel", "not used here: heights are interpolated linearly"))});
  pixel_m_ = attributes.real("cell_size");
  corner_ = {attributes.real("x"), attributes.real("y")};
  const GrayImage image = read_gray_png(file.root().existing_file(attributes.text("file_name")));
  columns_ = image.width;
  rows_ = image.height;
  heights_m_.reserve(image.pixels.size());
  for (int row = rows_ - 1; row >= 0; --row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                                static_cast<std::size_t>(column);
      heights_m_.push_back(attributes.real("vert_scale") * static_cast<float>(image.pixels[pixel]) /
                           255);
    }
  }
}

float HeightField::at(int column, int row) const {
  const int c = std::clamp(column, 0, columns_ - 1);
  const int r = std::clamp(row, 0, rows_ - 1);
  return heights_m_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(c)];
}

float HeightField::height_m(const Eigen::Vector2f& point) const {
  const Eigen::Vector2f size(static_cast<float>(columns_), static_cast<float>(rows_));
  const Eigen::Vector2f pixel = ((point - corner_) / pixel_m_).array() - 0.5F;
  const Eigen::Vector2f inside = pixel.cwiseMax(-1).cwiseMin(size);
  const Eigen::Vector2f low = inside.array().floor();
  const Eigen::Vector2f share = inside - low;
  const int column = static_cast<int>(low.x());
  const int row = static_cast<int>(low.y());
  const float south = at(column, row) + share.x() * (at(column + 1, row) - at(column, row));
  const float north =
      at(column, row + 1) + share.x() * (at(column + 1, row + 1) - at(column, row + 1));
  return south + share.y() * (north - south);
}

Eigen::Vector2f HeightField::gradient(const Eigen::Vector2f& point) const {
  const float half = 0.5F * pixel_m_;
  const Eigen::Vector2f east(half, 0);
  const Eigen::Vector2f north(0, half);
  return {(height_m(point + east) - height_m(point - east)) / pixel_m_,
          (height_m(point + north) - height_m(point - north)) / pixel_m_};
}

std::shared_ptr<const HeightField> shared_height_field(const std::filesystem::path& path,
                                                       SharedParts& parts) {
  return parts.get<HeightField>(path.lexically_normal().string(),
                                [&] { return std::make_shared<HeightField>(path); });
}

namespace {

class OfImage : public Elevation {
 public:
  explicit OfImage(std::shared_ptr<const HeightField> field) : field_(std::move(field)) {}
  float height_m(const Eigen::Vector2f& point) const override { return field_->height_m(point); }
  Eigen::Vector2f gradient(const Eigen::Vector2f& point) const override {
    return field_->gradient(point);
  }

 private:
  std::shared_ptr<const HeightField> field_;
};

std::unique_ptr<Elevation> make_of_image(const Element& element, const Attributes& attributes,
                                         ElevationContext& context) {
  return std::make_unique<OfImage>(
      shared_height_field(element.existing_file(attributes.text("file_name")), context.parts));
}

/// Slopes turn people downhill and make them slower uphill, faster downhill.
class OnSlopes : public VelModifier {
 public:
  OnSlopes(std::shared_ptr<const HeightField> field, const Attributes& attributes)
      : field_(std::move(field)),
        direction_weight_(attributes.real("dir_weight")),
        uphill_scale_(attributes.real("up_hill_scale")),
        downhill_scale_(attributes.real("down_hill_scale")) {}

  void modify(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) const override {
    const Eigen::Vector2f downhill = -field_->gradient(crowd.agents.position[agent]);
    const Eigen::Vector2f turned = preferred.direction + direction_weight_ * downhill;
    const float length = turned.norm();
    constexpr float kNoDirection = 1e-6F;
    if (length > kNoDirection) preferred.direction = turned / length;
    const float descent = preferred.direction.dot(downhill);
    const float scale = descent < 0 ? uphill_scale_ : downhill_scale_;
    preferred.speed *= std::max(0.0F, 1 + scale * descent);
  }

 private:
  std::shared_ptr<const HeightField> field_;
  float direction_weight_;
  float uphill_scale_;
  float downhill_scale_;
};

std::unique_ptr<VelModifier> make_on_slopes(const Element& element, const Attributes& attributes,
                                            BehaviorContext& context) {
  const auto path = element.existing_file(attributes.text("file_name"));
  return std::make_unique<OnSlopes>(shared_height_field(path, *context.crowd.parts), attributes);
}

}  // namespace

ElevationRegistry::Entry height_field_elevation() {
  return {"height_field",
          "heights drawn as an image",
          {text("file_name", "of the height field (.ht)")},
          make_of_image};
}

std::vector<VelModifierRegistry::Entry> slope_modifiers() {
  return {
      {"height_field",
       "slopes turn people downhill, slow them uphill and hurry them downhill",
       {text("file_name", "of the height field (.ht)"),
        optional(number("dir_weight", "of the slope in the direction", 0, 1000), "1.2"),
        optional(number("up_hill_scale", "how much uphill slopes slow down", 0, 1000), "1"),
        optional(number("down_hill_scale", "how much downhill slopes hurry", 0, 1000), "0.2")},
       make_on_slopes},
  };
}

}  // namespace throng::crowd
