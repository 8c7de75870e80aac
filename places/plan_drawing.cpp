#include "places/plan_drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace throng::places {

using Eigen::Vector2d;

namespace {

constexpr int kBorderPx = 20;
constexpr int kTitlePx = 30;
constexpr int kLegendPx = 80;
constexpr int kNarrowestPx = 640;  // the legend needs as much
constexpr double kLettersPx = 13;

struct Entry {
  const char* words;
  Ink ink;
};

constexpr std::array<Entry, 10> kLegend = {{{"building", inks::kBuilding},
                                            {"obstacle of the crowd", inks::kObstacle},
                                            {"thing", inks::kProp},
                                            {"open exit", inks::kOpenExit},
                                            {"shut exit", inks::kShutExit},
                                            {"goal", inks::kGoal},
                                            {"person at the start", inks::kPerson},
                                            {"people come in here", inks::kSource},
                                            {"drone", inks::kDrone},
                                            {"danger", inks::kDanger}}};

/// A length for the scale: 1, 2 or 5 times a power of ten, about this long.
double round_length(double length_m) {
  const double power = std::pow(10, std::floor(std::log10(length_m)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= length_m) return digit * power;
  }
  return power;
}

Mark text_mark(const Vector2d& at_px, std::string text, double size_px, const Ink& ink) {
  Mark mark;
  mark.kind = Mark::Kind::text;
  mark.points = {at_px};
  mark.fill = ink;
  mark.width_px = size_px;
  mark.text = std::move(text);
  return mark;
}

}  // namespace

Sheet::Sheet(const world::Rectangle& area, int size_px) : area_(area) {
  const Vector2d size = area.max - area.min;
  px_per_m_ = size_px / size.maxCoeff();
  plan_height_px_ = static_cast<int>(std::ceil(size.y() * px_per_m_));
  drawing_.width_px =
      std::max(kNarrowestPx, static_cast<int>(std::ceil(size.x() * px_per_m_)) + 2 * kBorderPx);
  drawing_.height_px = kTitlePx + plan_height_px_ + 2 * kBorderPx + kLegendPx;
}

Vector2d Sheet::at(const Vector2d& place) const {
  return {kBorderPx + (place.x() - area_.min.x()) * px_per_m_,
          kTitlePx + kBorderPx + plan_height_px_ - (place.y() - area_.min.y()) * px_per_m_};
}

void Sheet::polygon(std::span<const Vector2d> corners, const Ink& fill, const Ink& stroke,
                    double width_px) {
  Mark mark;
  for (const Vector2d& corner : corners) mark.points.push_back(at(corner));
  mark.fill = fill;
  mark.stroke = stroke;
  mark.width_px = width_px;
  drawing_.marks.push_back(std::move(mark));
}

void Sheet::line(std::span<const Vector2d> places, const Ink& stroke, double width_px, bool arrow) {
  Mark mark;
  mark.kind = Mark::Kind::line;
  for (const Vector2d& place : places) mark.points.push_back(at(place));
  mark.stroke = stroke;
  mark.width_px = width_px;
  mark.arrow = arrow;
  drawing_.marks.push_back(std::move(mark));
}

void Sheet::dot(const Vector2d& place, double radius_px, const Ink& fill) {
  Mark mark;
  mark.kind = Mark::Kind::circle;
  mark.points = {at(place)};
  mark.fill = fill;
  mark.width_px = radius_px;
  drawing_.marks.push_back(std::move(mark));
}

void Sheet::ring(const Vector2d& place, double radius_m, const Ink& stroke) {
  Mark mark;
  mark.kind = Mark::Kind::circle;
  mark.points = {at(place)};
  mark.stroke = stroke;
  mark.width_px = std::max(2.0, radius_m * px_per_m_);
  drawing_.marks.push_back(std::move(mark));
}

void Sheet::words(const Vector2d& place, const Vector2d& offset_px, const std::string& text,
                  const Ink& ink) {
  drawing_.marks.push_back(text_mark(at(place) + offset_px, text, kLettersPx, ink));
}

void Sheet::finish(const std::string& title) {
  constexpr double kTitleLettersPx = 18;
  drawing_.marks.push_back(text_mark({kBorderPx, kTitlePx}, title, kTitleLettersPx, inks::kInk));
  constexpr double kArrowPx = 34;
  const double right = drawing_.width_px - 2 * kBorderPx;
  Mark north;
  north.kind = Mark::Kind::line;
  north.points = {Vector2d(right, kTitlePx + kArrowPx), Vector2d(right, kTitlePx)};
  north.stroke = inks::kInk;
  north.width_px = 2;
  north.arrow = true;
  drawing_.marks.push_back(std::move(north));
  drawing_.marks.push_back(
      text_mark({right - 18, kTitlePx + 14}, std::string(1, 'N'), kLettersPx, inks::kInk));
  add_legend(kTitlePx + plan_height_px_ + 2 * kBorderPx);
}

void Sheet::add_legend(double top_px) {
  constexpr double kBarPx = 160;
  constexpr double kLinePx = 22;
  constexpr double kColumnPx = 200;
  const double length_m = round_length(kBarPx / px_per_m_);
  Mark bar;
  bar.kind = Mark::Kind::line;
  const double end = kBorderPx + length_m * px_per_m_;
  bar.points = {Vector2d(kBorderPx, top_px), Vector2d(kBorderPx, top_px + 6),
                Vector2d(end, top_px + 6), Vector2d(end, top_px)};
  bar.stroke = inks::kInk;
  bar.width_px = 2;
  drawing_.marks.push_back(std::move(bar));
  const auto write = [&](const Vector2d& place, const std::string& text) {
    drawing_.marks.push_back(text_mark(place, text, kLettersPx, inks::kInk));
  };
  write({end + 8, top_px + 8}, fmt::format("{:g} m", length_m));
  Vector2d place(kBorderPx, top_px + kLinePx + 6);
  for (const Entry& entry : kLegend) {
    if (place.x() + kColumnPx > drawing_.width_px) {
      place = {static_cast<double>(kBorderPx), place.y() + kLinePx};
    }
    Mark box;
    box.points = {place, place + Vector2d(12, 0), place + Vector2d(12, 10),
                  place + Vector2d(0, 10)};
    box.fill = entry.ink;
    box.fill.opacity = 1;
    drawing_.marks.push_back(std::move(box));
    write(place + Vector2d(18, 10), entry.words);
    place.x() += kColumnPx;
  }
}

}  // namespace throng::places
