// Reports of comparisons made by hand.
#include "validation/experiments/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "validation/experiments/plots.h"
#include "validation/experiments/summary.h"

namespace throng::validation {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A door with two people, and a loop with two points; the second model is blocked at the door.
Comparison made_by_hand() {
  ComparedExperiment door;
  door.name = "door";
  door.people = 2;
  door.quantities = {{"flow", "1/(m s)", 2, 0, {{{1.8, 2.0}}, {{0, 0}}}},
                     {"speed", "m/s", 0.5, 0, {{{0.53, 0.53}}, {{std::nan(""), 0.1}}}},
                     {"T90", "s", 20, 0, {{{22, 22}}, {{kNever, 20}}}},
                     {"band index", "", std::nan(""), 0, {{{1, 1}}, {{1, 1}}}}};
  door.recorded_passages_s = {3, 9};
  door.passages_s = {{{4, 10}, {5, 12}}, {{}, {7}}};
  door.curve_differences = {{{0.5, 0.5}}, {{1, 0.5}}};
  ComparedExperiment loop;
  loop.name = "loop";
  loop.quantities = {{"flow at 1.0 /m²", "1/(m s)", 1, 1.0, {{{1.1, 1.1}}, {{1, 1}}}},
                     {"flow at 2.0 /m²", "1/(m s)", 1, 2.0, {{{1.0, 1.0}}, {{1.2, 1.2}}}}};
  return {{"ttc", "orca"}, 2, {door, loop}};
}

TEST(Summary, HasTheErrorsOfEachModel) {
  const std::vector<Aspect> aspects = summarize(made_by_hand());
  ASSERT_EQ(aspects.size(), 4U);
  EXPECT_EQ(aspects[0].title, "exit flow");
  EXPECT_NEAR(aspects[0].models[0].max, 0.05, 1e-9);
  EXPECT_TRUE(aspects[0].models[0].holds);
  EXPECT_NEAR(aspects[0].models[1].max, 1, 1e-9) << "blocked";
  EXPECT_FALSE(aspects[0].models[1].holds);
  EXPECT_EQ(aspects[1].title, "speed");
  EXPECT_TRUE(aspects[1].models[0].holds) << "6 %";
  EXPECT_FALSE(aspects[1].models[1].holds) << "not measured in one run";
  EXPECT_EQ(aspects[2].title, "T90");
  EXPECT_FALSE(aspects[2].max_mean_error);
  EXPECT_NEAR(aspects[2].models[0].max, 0.1, 1e-9);
  EXPECT_TRUE(aspects[2].models[0].holds) << "at most 12 %";
  EXPECT_EQ(aspects[2].models[1].max, kNever) << "one of the runs never gets there";
  EXPECT_FALSE(aspects[2].models[1].holds);
  EXPECT_EQ(aspects[3].title, "diagram");
  EXPECT_EQ(aspects[3].quantities, 2U);
  EXPECT_NEAR(aspects[3].models[0].mean, 0.05, 1e-9);
  EXPECT_NEAR(aspects[3].models[0].max, 0.1, 1e-9);
  EXPECT_TRUE(aspects[3].models[0].holds);
  EXPECT_FALSE(aspects[3].models[1].holds) << "20 %";
}

TEST(Summary, HoldsMeansToAStricterCriterion) {
  Comparison comparison = made_by_hand();
  comparison.experiments[1].quantities[0].models[0].values = {1.12, 1.12};
  comparison.experiments[1].quantities[1].models[0].values = {0.9, 0.9};
  const Aspect diagram = summarize(comparison).at(3);
  EXPECT_LT(diagram.models[0].max, 0.15);
  EXPECT_NEAR(diagram.models[0].mean, 0.11, 1e-9);
  EXPECT_FALSE(diagram.models[0].holds);
}

TEST(Summary, LeavesOutWhatWasNotRecorded) {
  Comparison comparison = made_by_hand();
  comparison.experiments.erase(comparison.experiments.begin());
  const std::vector<Aspect> aspects = summarize(comparison);
  ASSERT_EQ(aspects.size(), 1U);
  EXPECT_EQ(aspects[0].title, "diagram");
}

TEST(ComparisonPage, HasASummaryAndATablePerExperiment) {
  const std::string page = markdown(made_by_hand());
  EXPECT_THAT(page, StartsWith("# "));
  EXPECT_THAT(page, HasSubstr("| error of | quantities | criterion | ttc | orca |\n"
                              "|---|---|---|---|---|\n"
                              "| exit flow | 1 | each at most 15 %, mean at most 8 % | **+** mean "
                              "5 %, greatest 5 % | **-** mean 100 %, greatest 100 % |\n"));
  EXPECT_THAT(page, HasSubstr("| T90 | 1 | each at most 12 % | **+** mean 10 %, greatest 10 % | "
                              "**-** mean ∞, greatest ∞ |\n"));
  EXPECT_THAT(page, HasSubstr("## door\n\n2 people; everybody passes the line.\n\n"
                              "| quantity | people | ttc | orca |\n|---|---|---|---|\n"));
  // Student's t with one degree of freedom: 12.706 times 0.1.
  EXPECT_THAT(page, HasSubstr("| flow, 1/(m s) | 2.00 | 1.90 ± 1.27 (-5 %) | "));
  EXPECT_THAT(page, HasSubstr("| T90, s | 20.0 | 22.0 ± 0.000 (+10 %) | not reached |\n"));
  EXPECT_THAT(page, HasSubstr("| band index | not measured | 1.00 ± 0.000 | 1.00 ± 0.000 |\n"));
  EXPECT_THAT(page, HasSubstr("| greatest difference of N-t curves | | 50 % | 75 % |\n"));
  EXPECT_THAT(page, HasSubstr("## loop\n\nPeople walk around in a closed corridor.\n"));
  EXPECT_THAT(page, Not(HasSubstr("![")));
}

TEST(ComparisonPage, LinksItsFigures) {
  const std::string page = markdown(made_by_hand(), {"a_curves.svg", "a_diagram.svg"});
  EXPECT_THAT(page, HasSubstr("](a_curves.svg)"));
  EXPECT_THAT(page, HasSubstr("](a_diagram.svg)"));
}

TEST(ComparisonPage, SaysThatNobodyPasses) {
  Comparison comparison = made_by_hand();
  comparison.experiments[0].recorded_passages_s = {};
  EXPECT_THAT(markdown(comparison), HasSubstr("2 people, of whom nobody passes the line"));
  comparison.experiments[0].recorded_passages_s = {3};
  EXPECT_THAT(markdown(comparison), HasSubstr("2 people; 1 of them pass"));
}

TEST(ComparisonJson, HasAllValues) {
  const auto document = nlohmann::json::parse(comparison_json(made_by_hand()));
  EXPECT_EQ(document["models"], (nlohmann::json{"ttc", "orca"}));
  EXPECT_EQ(document["seeds"], 2);
  const auto& door = document["experiments"][0];
  EXPECT_EQ(door["people"], 2);
  EXPECT_EQ(door["passages_s"], (nlohmann::json{3.0, 9.0}));
  EXPECT_EQ(door["models"][0]["passages_s"][1], (nlohmann::json{5.0, 12.0}));
  EXPECT_EQ(door["quantities"][0]["models"][0]["values"], (nlohmann::json{1.8, 2.0}));
  EXPECT_NEAR(door["quantities"][0]["models"][0]["relative_error"].get<double>(), -0.05, 1e-9);
  EXPECT_TRUE(door["quantities"][2]["models"][1]["mean"].is_null()) << "not reached";
  EXPECT_TRUE(door["quantities"][3]["recorded"].is_null()) << "not measured";
  EXPECT_EQ(document["experiments"][1]["quantities"][1]["density_per_m2"], 2.0);
  EXPECT_EQ(document["summary"].size(), 4U);
  EXPECT_EQ(document["summary"][0]["models"][0]["holds"], true);
}

std::size_t lines_of_width(const drawing::Drawing& drawing, double width_px) {
  std::size_t lines = 0;
  for (const drawing::Shape& shape : drawing.shapes) {
    lines += shape.kind == drawing::Shape::Kind::line && shape.width_px == width_px ? 1 : 0;
  }
  return lines;
}

TEST(Plots, DrawCurvesOfRecordings) {
  const auto curves = curves_plot(made_by_hand());
  ASSERT_TRUE(curves);
  EXPECT_EQ(lines_of_width(*curves, 2), 1U) << "the people, in one panel";
  EXPECT_EQ(lines_of_width(*curves, 1.5), 2U) << "two models";
  EXPECT_THAT(drawing::to_svg(*curves), HasSubstr("<svg"));
  for (const drawing::Shape& shape : curves->shapes) {
    for (const Eigen::Vector2d& point : shape.points) {
      EXPECT_TRUE(point.allFinite());
      EXPECT_LE(point.x(), curves->width_px);
      EXPECT_LE(point.y(), curves->height_px);
      EXPECT_GE(point.minCoeff(), 0);
    }
  }
}

TEST(Plots, AreDrawnOfWhatThereIs) {
  Comparison comparison = made_by_hand();
  ASSERT_TRUE(diagram_plot(comparison));
  comparison.experiments.pop_back();
  EXPECT_FALSE(diagram_plot(comparison));
  EXPECT_TRUE(curves_plot(comparison));
  comparison.experiments[0].recorded_passages_s = {};
  comparison.experiments[0].passages_s = {{{}, {}}, {{}, {}}};
  EXPECT_TRUE(curves_plot(comparison)) << "nobody passes";
  EXPECT_FALSE(curves_plot({{"ttc"}, 1, {}}));
}

}  // namespace
}  // namespace throng::validation
