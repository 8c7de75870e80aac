#include "annotate/people/labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "annotate/people/run_lengths.h"
#include "tests/annotate/rle.h"
#include "tests/annotate/synthetic_frame.h"

namespace throng::annotate {
namespace {

using testing::ElementsAre;

// The expected labels, pixel by pixel.
struct Expected {
  std::vector<bool> mask;
  int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
  std::uint64_t area = 0;
};

std::map<std::uint32_t, Expected> look_at_each_pixel(const render::Frame& frame) {
  std::map<std::uint32_t, Expected> people;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * frame.width() + x;
      if (!render::is_agent(frame.id[at])) continue;
      Expected& person = people[render::agent_of_id(frame.id[at])];
      person.mask.resize(frame.id.size());
      person.mask[at] = true;
      person.left = std::min(person.left, x);
      person.right = std::max(person.right, x);
      person.top = std::min(person.top, y);
      person.bottom = std::max(person.bottom, y);
      ++person.area;
    }
  }
  return people;
}

void expect_exact(const render::Frame& frame) {
  const FrameLabels labels = label_people(frame);
  const auto expected = look_at_each_pixel(frame);
  ASSERT_EQ(labels.people.size(), expected.size());
  auto next = expected.begin();
  for (const PersonLabel& label : labels.people) {
    const auto& [agent, person] = *next++;
    ASSERT_EQ(label.agent, agent) << "people come in the order of their ids";
    EXPECT_EQ(label.person.agent, agent);
    EXPECT_EQ(label.box.x, person.left);
    EXPECT_EQ(label.box.y, person.top);
    EXPECT_EQ(label.box.width, person.right - person.left + 1);
    EXPECT_EQ(label.box.height, person.bottom - person.top + 1);
    EXPECT_EQ(label.area_px, person.area);
    EXPECT_EQ(mask_of_runs(label.mask, frame.width(), frame.height()), person.mask);
    for (std::size_t i = 1; i < label.mask.size(); ++i) EXPECT_GT(label.mask[i], 0U);
    const std::string counts = coco_counts(label.mask);
    EXPECT_THAT(runs_of_counts(counts), testing::ElementsAreArray(label.mask));
    EXPECT_DOUBLE_EQ(label.visibility,
                     static_cast<double>(person.area) / label.person.amodal_area_px);
    EXPECT_GT(label.visibility, 0);
    EXPECT_LE(label.visibility, 1);
  }
}

TEST(LabelPeople, AgreesWithEveryPixelOfRandomScenes) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed, Stream::randomize);
    SyntheticScene scene;
    scene.seed = seed;
    scene.width = 1 + static_cast<int>(random.below(200));
    scene.height = 1 + static_cast<int>(random.below(150));
    scene.people = static_cast<int>(random.below(60));
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_exact(synthetic_frame(scene));
  }
}

// No structure at all: single pixels, holes, runs that touch every border.
TEST(LabelPeople, AgreesWithEveryPixelOfNoise) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed, Stream::randomize);
    const std::uint32_t ids = 1 + random.below(5);
    render::Frame frame =
        empty_frame(1 + static_cast<int>(random.below(40)), 1 + static_cast<int>(random.below(40)));
    for (std::uint32_t& id : frame.id) {
      const std::uint32_t draw = random.below(ids + 1);
      id = draw == ids ? render::kIdBuilding : render::id_of_agent(draw);
    }
    for (std::uint32_t agent = 0; agent < ids; ++agent) {
      frame.people.emplace_back().agent = agent;
      frame.people.back().amodal_area_px = frame.id.size();
    }
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_exact(frame);
  }
}

TEST(LabelPeople, MasksRunDownTheColumnsAndStartWithZeros) {
  render::Frame frame = empty_frame(3, 4);
  frame.people.emplace_back().agent = 6;
  // . 7 .
  // . 7 .
  // 7 . .
  // 7 . .
  for (const int at : {1, 4, 6, 9}) frame.id[at] = render::id_of_agent(6);
  const FrameLabels labels = label_people(frame);
  ASSERT_EQ(labels.people.size(), 1U);
  EXPECT_THAT(labels.people[0].mask, ElementsAre(2, 4, 6)) << "one run over the columns' border";

  frame.id.assign(frame.id.size(), render::id_of_agent(6));
  EXPECT_THAT(label_people(frame).people[0].mask, ElementsAre(0, 12));
}

TEST(LabelPeople, HiddenPeopleAndOtherThingsHaveNoLabel) {
  render::Frame frame = empty_frame(20, 20);
  frame.people.emplace_back().agent = 3;
  frame.id[5] = render::kIdBuilding + 3;
  EXPECT_TRUE(label_people(frame).people.empty());
}

TEST(LabelPeople, ListsPeopleThatAreHiddenInTheImage) {
  render::Frame frame = empty_frame(40, 30);
  const auto add = [&](std::uint32_t agent, double left, double top) {
    render::PersonInView person;
    person.agent = agent;
    person.amodal_box = {Eigen::Vector2d(left, top), Eigen::Vector2d(left + 5, top + 9)};
    frame.people.push_back(person);
  };
  add(1, 10, 10);    // hidden
  add(2, 20, 10);    // visible
  add(3, -4.5, 10);  // hidden, half a pixel in the image
  add(4, -5, 10);    // touches the image from outside
  add(5, 60, 50);    // far outside
  frame.id[12 * 40 + 22] = render::id_of_agent(2);
  const FrameLabels labels = label_people(frame);
  ASSERT_EQ(labels.people.size(), 1U);
  ASSERT_EQ(labels.hidden.size(), 2U);
  EXPECT_EQ(labels.hidden[0].agent, 1U);
  EXPECT_EQ(labels.hidden[1].agent, 3U);
  EXPECT_EQ(labels.hidden[1].amodal_box.min().x(), -4.5);
}

TEST(LabelPeople, VisibilityIsAtMostOne) {
  render::Frame frame = empty_frame(10, 10);
  frame.people.emplace_back().amodal_area_px = 1;
  frame.id[50] = frame.id[51] = render::id_of_agent(0);
  const PersonLabel label = label_people(frame).people.at(0);
  EXPECT_EQ(label.visibility, 1);
  EXPECT_EQ(label.person.amodal_area_px, 2U);
}

TEST(LabelPeople, KeepsTheFramesTime) {
  render::Frame frame = empty_frame(2, 2);
  frame.index = 17;
  frame.time_s = 8.5;
  const FrameLabels labels = label_people(frame);
  EXPECT_EQ(labels.frame_index, 17);
  EXPECT_EQ(labels.time_s, 8.5);
}

TEST(LabelPeopleDeathTest, SomebodyUnlistedIsABug) {
  render::Frame frame = empty_frame(10, 10);
  frame.id[50] = render::id_of_agent(4);
  EXPECT_DEATH(label_people(frame), "listed");
}

// The first by hand, the second as other tools write that mask.
TEST(RunLengths, OfMasksAreThoseOfTheirPixels) {
  constexpr int kWidth = 7;
  constexpr int kHeight = 5;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed, Stream::crowd_generator, 0);
    const int left = static_cast<int>(random.below(kWidth));
    const int top = static_cast<int>(random.below(kHeight));
    const int right = left + 1 + static_cast<int>(random.below(kWidth - left));
    const int bottom = top + 1 + static_cast<int>(random.below(kHeight - top));
    render::PixelMask mask({Eigen::Vector2i(left, top), Eigen::Vector2i(right, bottom)});
    const double share = random.uniform(0, 1.5);
    for (std::uint8_t& pixel : mask.set) pixel = random.uniform(0, 1) < share ? 1 : 0;
    const RunLengths runs = run_lengths(mask, kWidth, kHeight);
    EXPECT_EQ(std::accumulate(runs.begin(), runs.end(), 0U), 35U);
    EXPECT_EQ(std::count(runs.begin() + 1, runs.end(), 0U), 0) << "no empty run but the first";
    std::size_t at = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      for (std::uint32_t j = 0; j < runs[i]; ++j, ++at) {
        EXPECT_EQ(mask.at(static_cast<int>(at) / kHeight, static_cast<int>(at) % kHeight),
                  i % 2 == 1)
            << "seed " << seed << " pixel " << at;
      }
    }
  }
  EXPECT_EQ(run_lengths({}, kWidth, kHeight), RunLengths({35}));
}

TEST(CocoCounts, MatchesKnownStrings) {
  EXPECT_EQ(coco_counts({0, 12}), "0<");
  EXPECT_EQ(coco_counts({6, 1, 40, 4, 5, 4, 5, 4, 21}), "61X13mN000`0");
}

TEST(CocoCounts, SurvivesLargeAndSmallRuns) {
  Random random(3, Stream::randomize);
  for (int trial = 0; trial < 200; ++trial) {
    RunLengths runs;
    for (std::uint32_t i = 0; i < 1 + random.below(30); ++i) {
      runs.push_back(random.bits() >> random.below(32));
    }
    EXPECT_THAT(runs_of_counts(coco_counts(runs)), testing::ElementsAreArray(runs));
  }
}

}  // namespace
}  // namespace throng::annotate
