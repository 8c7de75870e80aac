#include "annotate/people_sheet/people_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "annotate/people_sheet/height_chart.h"
#include "annotate/people_sheet/sheet_shots.h"
#include "base/error.h"

namespace throng::annotate {

namespace {

const cv::Scalar kPaper(250, 250, 248);
const cv::Scalar kInk(45, 45, 45);

world::Scenario plain_ground() {
  constexpr double kHalfM = 150;
  world::Scenario scenario;
  scenario.id = "people_sheet";
  scenario.ground = {{-kHalfM, -kHalfM}, {kHalfM, kHalfM}};
  scenario.ground_material = "concrete";
  return scenario;
}

int row_height(const SheetRow& row) {
  int height = 0;
  for (const SheetShot& shot : row.shots) {
    height = std::max(height, shot.camera.intrinsics.height);
  }
  return height;
}

class Page {
 public:
  explicit Page(int width) : unit_(width / 2400.0) { sheet_.width = width; }

  int px(double size) const { return std::max(1, static_cast<int>(std::lround(size * unit_))); }

  void reserve(int height) { height_ += height; }
  void reserve(const SheetRow& row) {
    reserve(row_height(row) + px(6) + (row.title.empty() ? 0 : title_height()));
  }
  int title_height() const { return px(48); }

  void begin() {
    sheet_.height = height_;
    sheet_.rgb.resize(3U * static_cast<std::size_t>(sheet_.width) *
                      static_cast<std::size_t>(height_));
    image_ = cv::Mat(height_, sheet_.width, CV_8UC3, sheet_.rgb.data());
    image_.setTo(kPaper);
  }

  void title(const std::string& words) {
    if (words.empty()) return;
    write(words, {px(12), y_ + px(34)}, 0.9, kInk);
    y_ += title_height();
  }

  void add(const std::string& label, const render::Frame& frame) {
    const cv::Rect place(x_, y_, frame.width(), frame.height());
    const cv::Mat drawn(frame.height(), frame.width(), CV_8UC3,
                        const_cast<std::uint8_t*>(frame.rgb.data()));  // only read
    drawn.copyTo(image_(place));
    const auto shown = std::count_if(frame.id.begin(), frame.id.end(), render::is_agent);
    sheet_.cells.push_back(
        {label, x_, y_, frame.width(), frame.height(), static_cast<std::uint64_t>(shown)});
    x_ += frame.width();
  }

  void end_row(int height) {
    // Last, since a label may reach into the next image.
    for (const SheetCell& cell : sheet_.cells) {
      if (cell.y != y_ || cell.label.empty()) continue;
      write(cell.label, {cell.x + px(5), cell.y + px(16)}, 0.41, {255, 255, 255});
    }
    x_ = 0;
    y_ += height + px(6);
  }

  /// The strip of this height that comes next.
  cv::Mat strip(int height) {
    const cv::Rect place(0, y_, sheet_.width, height);
    y_ += height;
    return image_(place);
  }

  Sheet take() && { return std::move(sheet_); }

 private:
  void write(const std::string& words, cv::Point at, double size, const cv::Scalar& color) {
    const double scale = size * unit_;
    const int thickness = px(size < 0.6 ? 1 : 2);
    if (color != kInk) {
      cv::putText(image_, words, at, cv::FONT_HERSHEY_SIMPLEX, scale, {30, 30, 30},
                  thickness + px(2), cv::LINE_AA);
    }
    cv::putText(image_, words, at, cv::FONT_HERSHEY_SIMPLEX, scale, color, thickness, cv::LINE_AA);
  }

  Sheet sheet_;
  cv::Mat image_;
  double unit_;
  int height_ = 0;
  int x_ = 0;
  int y_ = 0;
};

class Progress {
 public:
  Progress(const SheetProgress& report, std::size_t images) : report_(&report), images_(images) {}
  void next(std::string_view what) {
    if (*report_) (*report_)(static_cast<double>(done_) / static_cast<double>(images_), what);
    ++done_;
  }

 private:
  const SheetProgress* report_;
  std::size_t images_;
  std::size_t done_ = 0;
};

void draw_rows(const std::vector<SheetRow>& rows, render::Renderer& renderer, Page& page,
               Progress& progress) {
  for (const SheetRow& row : rows) {
    page.title(row.title);
    for (const SheetShot& shot : row.shots) {
      progress.next(shot.label);
      render::Scene scene;
      scene.people = shot.people;
      page.add(shot.label, renderer.draw(scene, shot.camera));
    }
    page.end_row(row_height(row));
  }
}

std::size_t shots_in(const std::vector<SheetRow>& rows) {
  std::size_t count = 0;
  for (const SheetRow& row : rows) count += row.shots.size();
  return count;
}

}  // namespace

Sheet draw_people_sheet(const skinning::Population& population, const SheetOptions& options,
                        const SheetProgress& progress) {
  check(!options.portraits.empty() && !options.crowd.empty(), "a sheet shows somebody");
  std::vector<SheetRow> rows = portrait_rows(population, options);
  rows.push_back(drone_row(population, options));
  for (SheetRow& row : motion_rows(population, options)) rows.push_back(std::move(row));
  for (SheetRow& row : act_rows(population, options)) rows.push_back(std::move(row));
  const LevelsApart apart = levels_apart(population, options);
  const std::vector<SheetRow> levels = level_rows(apart, options);

  Page page(options.width_px);
  const std::string heights = "Heights of adults";
  const int chart_height = page.px(320);
  for (const SheetRow& row : rows) page.reserve(row);
  for (const SheetRow& row : levels) page.reserve(row);
  page.reserve(page.title_height() + chart_height);
  page.begin();

  const world::Scenario ground = plain_ground();
  Progress reports(progress, shots_in(rows) + shots_in(levels));
  {
    render::Renderer renderer(ground, population, {}, options.device);
    draw_rows(rows, renderer, page, reports);
  }
  render::Renderer renderer(ground, apart.population, {}, options.device);
  draw_rows(levels, renderer, page, reports);
  page.title(heights);
  draw_height_chart(page.strip(chart_height), population, options.seed);
  return std::move(page).take();
}

}  // namespace throng::annotate
