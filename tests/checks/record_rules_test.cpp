// Rules about one image's records: a sound image made by hand has no faults, and each damage is
// named by its rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "checks/ground_truth_checks.h"
#include "checks/run_checks.h"
#include "formats/dataset/instances.h"
#include "tests/checks/found_by.h"
#include "tests/formats/hand_made.h"

namespace throng::checks {
namespace {

using formats::hand_made::any_with;
using nlohmann::json;

/// A person 20 m ahead on the ground: 0.4 m x 0.4 m x 2 m about (0, 20, 1). Their middle is seen at
/// (49.5, 39.5 + 50 * 9 / 20) = (49.5, 62); + 0.5 in box coordinates. The box of the body is a
/// pixel wide and 5 high.
formats::Image with_walker() {
  formats::Image image = formats::hand_made::image();
  formats::Person walker = formats::hand_made::person(3, {49, 60, 2, 5}, {49, 60, 2, 5}, 1);
  walker.position = {0, 20, 0};
  walker.box_middle = {0, 20, 1};
  walker.box_size = {0.4, 0.4, 2};
  image.people = {walker};
  return image;
}

std::vector<std::string> people_faults(const formats::Image& image) {
  return found_by([&](Findings& findings) { check_people(image, findings); });
}
std::vector<std::string> body_faults(const formats::Image& image) {
  return found_by([&](Findings& findings) { check_bodies(image, findings); });
}

void expect_people(const std::string& words, const std::function<void(formats::Person&)>& damage) {
  formats::Image image = with_walker();
  damage(image.people[0]);
  const auto found = people_faults(image);
  EXPECT_TRUE(any_with(found, words)) << words << " in " << ::testing::PrintToString(found);
}
void expect_body(const std::string& words, const std::function<void(formats::Person&)>& damage) {
  formats::Image image = with_walker();
  damage(image.people[0]);
  const auto found = body_faults(image);
  EXPECT_TRUE(any_with(found, words)) << words << " in " << ::testing::PrintToString(found);
}

TEST(RecordRules, SoundRecordsHaveNoFaults) {
  EXPECT_THAT(people_faults(with_walker()), ::testing::IsEmpty());
  EXPECT_THAT(body_faults(with_walker()), ::testing::IsEmpty());
}

TEST(RecordRules, BoxesAreThoseOfMasks) {
  expect_people("box-is-mask-bounds annotation 103", [](formats::Person& p) { p.box.x -= 1; });
  expect_people("box-is-mask-bounds", [](formats::Person& p) { p.box.height += 1; });
  expect_people("area-is-mask annotation 103 area 11", [](formats::Person& p) { p.area = 11; });
  expect_people("box-not-empty", [](formats::Person& p) { p.box.width = 0; });
  expect_people("box-not-empty", [](formats::Person& p) { p.amodal.height = -1; });
  expect_people("box-in-image", [](formats::Person& p) { p.box.y = 78; });
  expect_people("box-in-image", [](formats::Person& p) { p.box.x = -1; });
  expect_people("box-in-image", [](formats::Person& p) { p.box.x = 99; });
}

TEST(RecordRules, MasksFillTheirImage) {
  expect_people("mask-size", [](formats::Person& p) {
    p.record["segmentation"]["size"] = {100, 80};
  });
  expect_people("mask-runs annotation 103 runs that fill the image", [](formats::Person& p) {
    p.mask = formats::encode_counts({10, 4});
  });
  expect_people("mask-runs annotation 103 characters", [](formats::Person& p) { p.mask = " "; });
}

TEST(RecordRules, WholeBodiesHoldVisiblePixels) {
  expect_people("visible-in-amodal annotation 103 bbox leaves", [](formats::Person& p) {
    p.amodal = {49, 60, 2, 3};
  });
  expect_people("visible-in-amodal annotation 103 area 10 above area_amodal 9",
                [](formats::Person& p) { p.record["area_amodal"] = 9; });
  expect_people("visibility-is-ratio annotation 103 visibility 1, but area / area_amodal is 0.5",
                [](formats::Person& p) { p.record["area_amodal"] = 20; });
}

TEST(RecordRules, WholeMasksHoldTheVisibleOnes) {
  const auto whole = [](const std::string& counts, double area) {
    formats::Image image = with_walker();
    formats::Person& p = image.people[0];
    p.amodal = {48, 60, 4, 6};
    p.record["area_amodal"] = area;
    p.visibility = 10 / area;
    p.record["amodal_segmentation"] = {{"size", {80, 100}}, {"counts", counts}};
    return people_faults(image);
  };
  EXPECT_THAT(whole(formats::hand_made::filled(48, 60, 4, 6), 24), ::testing::IsEmpty());
  EXPECT_TRUE(any_with(whole(formats::hand_made::filled(49, 61, 3, 5), 15),
                       "the visible mask leaves amodal_segmentation"));
  EXPECT_TRUE(any_with(whole(formats::hand_made::filled(48, 60, 4, 6), 25), "area_amodal 25"));
  EXPECT_TRUE(any_with(whole(formats::hand_made::filled(40, 60, 15, 6), 90),
                       "amodal_segmentation leaves bbox_amodal"));
  EXPECT_TRUE(any_with(whole("~", 24), "mask-runs"));
}

TEST(RecordRules, IndividualsAreNoCrowdAndHaveTheirCategory) {
  expect_people("iscrowd", [](formats::Person& p) { p.record["iscrowd"] = 1; });
  expect_people("category", [](formats::Person& p) { p.record["category_id"] = 2; });
  expect_people("category", [](formats::Person& p) { p.track_id = 2'000'000 + 99'990; });
}

std::vector<formats::Keypoint> joints() {
  return std::vector<formats::Keypoint>(17, formats::Keypoint{50, 62, 2});
}

TEST(RecordRules, KeypointsAreCountedAndNearTheMask) {
  const auto faults = [](const std::function<void(formats::Person&)>& damage) {
    formats::Image image = with_walker();
    image.people[0].keypoints = joints();
    image.people[0].record["num_keypoints"] = 17;
    damage(image.people[0]);
    return people_faults(image);
  };
  EXPECT_THAT(faults([](formats::Person&) {}), ::testing::IsEmpty());
  EXPECT_TRUE(any_with(faults([](formats::Person& p) { p.record["num_keypoints"] = 16; }),
                       "num_keypoints 16, but 17 are labeled"));
  EXPECT_TRUE(any_with(faults([](formats::Person& p) { p.keypoints[4].visibility = 0; }),
                       "a keypoint that is not labeled has a place"));
  EXPECT_TRUE(any_with(faults([](formats::Person& p) {
                         p.keypoints[4] = {70, 62, 1};
                       }),
                       "a keypoint outside of bbox_amodal"));
  EXPECT_TRUE(any_with(faults([](formats::Person& p) {
                         p.amodal = {40, 50, 20, 20};
                         p.keypoints[4] = {41, 51, 2};
                       }),
                       "a visible keypoint away from the mask"));
}

TEST(RecordRules, CountsAreThoseOfTheRecords) {
  formats::Image image = with_walker();
  image.hidden = {{2'000'009, {1, 1, 2, 2}, false}};
  image.record["counts"] = {{"visible", 1}, {"all", 2}, {"truncated", 0}, {"drones", 0}};
  EXPECT_THAT(people_faults(image), ::testing::IsEmpty());
  for (const char* key : {"visible", "all", "truncated", "drones"}) {
    formats::Image other = image;
    other.record["counts"][key] = 7;
    EXPECT_TRUE(any_with(people_faults(other), "counts image 7")) << key;
  }
}

TEST(BodyRules, PlacesAreBelowBodies) {
  expect_body("position", [](formats::Person& p) { p.position.x() = 1.7; });
  formats::Image image = with_walker();
  image.people[0].position.x() = 1.5;  // somebody who lies
  EXPECT_FALSE(any_with(body_faults(image), "position"));
}

TEST(BodyRules, StatesAreKnown) {
  expect_body("state annotation 103 a state that nobody can be in: flying",
              [](formats::Person& p) { p.state = "flying"; });
  for (const char* state : {"waiting", "running", "following", "panicking", "lying", "falling",
                            "getting_up", "sitting", "squatting", ""}) {
    formats::Image image = with_walker();
    image.people[0].state = state;
    EXPECT_FALSE(any_with(body_faults(image), "state")) << state;
  }
}

TEST(BodyRules, TruncationIsTheShareOutside) {
  expect_body("truncation", [](formats::Person& p) { p.truncation = 0.2; });
  formats::Image image = formats::hand_made::image();
  formats::Person cut = formats::hand_made::person(3, {0, 60, 5, 5}, {-5, 60, 10, 5}, 1);
  cut.box_middle = cut.position = {-20, 20, 1};
  cut.box_size = {4, 0.4, 2};
  cut.truncation = 0.5;
  image.people = {cut};
  EXPECT_FALSE(any_with(body_faults(image), "truncation"));
  image.people[0].truncation = 0.45;
  EXPECT_TRUE(any_with(body_faults(image), "truncation 0.45, but bbox_amodal says 0.5000"));
}

TEST(BodyRules, BoxesInTheWorldAreSeenWhereTheBoxIs) {
  expect_body("the middle of box_3d does not project",
              [](formats::Person& p) { p.box_middle.x() = 2; });
  expect_body("bbox_amodal leaves what box_3d projects to", [](formats::Person& p) {
    p.box_size = {0.01, 0.01, 0.1};
  });
  expect_body("box-3d", [](formats::Person& p) { p.box_middle.y() = -20; });
  formats::Image distorted = with_walker();
  distorted.people[0].box_middle.x() = 1.5;
  distorted.record["camera"] = {{"model", "fisheye"},
                                {"centre", {0, 0, 10}},
                                {"distortion", {{"k1", 0}, {"k2", 0}, {"k3", 0}, {"k4", 0}}}};
  EXPECT_FALSE(any_with(body_faults(distorted), "box-3d")) << "not judged with a lens";
}

TEST(BodyRules, KeypointsAreSeenWhereTheyAreInTheWorld) {
  formats::Image image = with_walker();
  formats::Person& p = image.people[0];
  // (0, 20, 1) is seen at (49.5, 62), box coordinates (50, 62.5).
  p.keypoints = {{50, 62.5, 2}, {0, 0, 0}};
  p.record["keypoints_3d"] = {{0, 20, 1}, {0, 20, 1.1}};
  EXPECT_FALSE(any_with(body_faults(image), "keypoint"));
  p.record["keypoints_3d"][0] = {0.05, 20, 1};  // 0.125 px
  EXPECT_TRUE(any_with(body_faults(image), "keypoint 1 is not where keypoints_3d is seen"));
}

/// Four walkers beside each other, whose rows a shutter reads while the image moves by 2 pixels to
/// the right; the first one's middle is at the left border.
formats::Image with_rolled_walkers() {
  formats::Image image = formats::hand_made::image();
  image.record["sensor"] = {{"strips", 8}};
  for (int i = 0; i < 4; ++i) {
    const double x_m = -19.8 + 6 * i;
    const double x_px = 50 + 2.5 * x_m + 2;  // at y = 20 m, a meter is 2.5 px wide
    formats::Person walker = formats::hand_made::person(i + 1, {std::max(0.0, x_px - 1), 60, 2, 5},
                                                        {x_px - 1, 60, 2, 5}, 1);
    walker.position = {x_m, 20, 0};
    walker.box_middle = {x_m, 20, 1};
    walker.box_size = {0.4, 0.4, 2};
    for (int joint = 0; joint < 17; ++joint) {
      const double z_m = 0.2 + 0.1 * joint;
      walker.record["keypoints_3d"].push_back({x_m, 20, z_m});
      walker.keypoints.push_back({x_px, 40 + 2.5 * (10 - z_m), 2});
    }
    image.people.push_back(walker);
  }
  return image;
}

TEST(BodyRules, BoxesOfARollingShutterHoldWholeBodies) {
  formats::Image image = with_rolled_walkers();
  EXPECT_FALSE(any_with(body_faults(image), "box-3d"));
  EXPECT_FALSE(any_with(body_faults(image), "keypoints"));
  // A box that ends with a strip of rows.
  image.people[0].amodal.height = 1;
  image.people[0].amodal.y = 69;
  EXPECT_TRUE(any_with(body_faults(image), "the middle of box_3d does not project"));
  EXPECT_TRUE(any_with(body_faults(image), "outside of bbox_amodal"));
  // Without keypoints nobody knows how far the rows move.
  for (formats::Person& person : image.people) person.keypoints.clear();
  EXPECT_FALSE(any_with(body_faults(image), "box-3d"));
}

TEST(CameraRules, CenterIsWhereTheRotationPutsIt) {
  const auto faults = [](const std::function<void(formats::Image&)>& damage) {
    formats::Image image = formats::hand_made::image();
    damage(image);
    return found_by([&](Findings& findings) { check_camera(image, findings); });
  };
  EXPECT_THAT(faults([](formats::Image&) {}), ::testing::IsEmpty());
  EXPECT_TRUE(any_with(faults([](formats::Image& i) { i.record["camera"]["centre"][2] = 10.1; }),
                       "center is not where R and t put it"));
  EXPECT_TRUE(any_with(faults([](formats::Image& i) { i.R(0, 0) = 1.01; }), "R is no rotation"));
  EXPECT_TRUE(any_with(faults([](formats::Image& i) { i.R.row(0) *= -1; }), "R is no rotation"))
      << "mirrored";
}

TEST(InstanceIds, AreAgentNumbersOrThoseOfDrones) {
  EXPECT_EQ(instance_id(formats::hand_made::person(3, {}, {}, 1)), 3U);
  const std::uint32_t drone = instance_id(formats::hand_made::person(99'985, {}, {}, 1));
  EXPECT_GE(drone, formats::kFirstDrone);
  EXPECT_LT(drone, formats::kGround);
}

/// The walker at x, in the frame of this number, half a second apart.
formats::Image frame_at(std::int64_t frame, double x) {
  formats::Image image = with_walker();
  image.id = 10 + frame;
  image.frame = frame;
  image.time_s = 0.5 * static_cast<double>(frame);
  image.people[0].box_middle.x() = x;
  return image;
}

std::vector<std::string> presence_findings(const std::vector<formats::Image>& images) {
  return found_by([&](Findings& findings) {
    PresenceCheck check;
    for (const formats::Image& image : images) check.add(image, findings);
  });
}

TEST(PresenceRules, NobodyIsMissingBetweenTwoFrames) {
  std::vector<formats::Image> images = {frame_at(0, -0.4), frame_at(1, 0), frame_at(2, 0.4)};
  EXPECT_THAT(presence_findings(images), ::testing::IsEmpty());
  images[1].people.clear();
  EXPECT_TRUE(any_with(presence_findings(images), "nobody-left-out image 11 track 2000003"));
  images[1].hidden = {{2'000'003, {48, 58, 4, 8}, false}};
  EXPECT_THAT(presence_findings(images), ::testing::IsEmpty()) << "among the hidden";
  images[1].hidden[0].amodal = {5, 5, 4, 8};
  EXPECT_TRUE(any_with(presence_findings(images), "hidden-box image 11"));
}

TEST(PresenceRules, PeopleWhoTurnBackMayHaveLeftTheImage) {
  // At 20 m, 10 pixels from the left edge, which are 4 m.
  std::vector<formats::Image> images = {frame_at(0, -16.4), frame_at(1, -16), frame_at(2, -15.6)};
  images[1].people.clear();
  images[0].people[0].velocity = {8, 0};
  images[2].people[0].velocity = {8, 0};
  EXPECT_TRUE(any_with(presence_findings(images), "nobody-left-out")) << "they walked on";
  images[2].people[0].velocity = {-8, 0};
  EXPECT_THAT(presence_findings(images), ::testing::IsEmpty()) << "4 m away, if fast enough";
  images[0].people[0].velocity = {0.1, 0};
  images[2].people[0].velocity = {-0.1, 0};
  EXPECT_TRUE(any_with(presence_findings(images), "nobody-left-out")) << "not that fast";
}

TEST(PresenceRules, OnlyConsecutiveFramesOfOneCameraTell) {
  std::vector<formats::Image> images = {frame_at(0, -0.4), frame_at(1, 0), frame_at(2, 0.4)};
  images[1].people.clear();
  std::vector<formats::Image> gap = images;
  gap[2].frame = 3;
  EXPECT_THAT(presence_findings(gap), ::testing::IsEmpty());
  std::vector<formats::Image> other_run = images;
  other_run[0].run = "run001";
  EXPECT_THAT(presence_findings(other_run), ::testing::IsEmpty());
  std::vector<formats::Image> slow = images;
  slow[2].time_s = 5;
  EXPECT_THAT(presence_findings(slow), ::testing::IsEmpty()) << "more than 1.1 s";
  std::vector<formats::Image> beyond = {frame_at(0, -19), frame_at(1, 0), frame_at(2, -21)};
  beyond[1].people.clear();
  EXPECT_THAT(presence_findings(beyond), ::testing::IsEmpty()) << "at the edge of the image";
}

TEST(PresenceRules, HiddenPeopleAreInViewAndNotVisible) {
  formats::Image image = with_walker();
  image.hidden = {{2'000'003, {10, 10, 5, 5}, false}};
  EXPECT_TRUE(any_with(presence_findings({image}), "hidden track 2000003 has an annotation"));
  image.hidden = {{2'000'004, {-6, 10, 5, 5}, false}};
  EXPECT_TRUE(any_with(presence_findings({image}), "hidden-box"));
  image.hidden = {{2'000'004, {-4, 10, 5, 5}, false}};
  EXPECT_THAT(presence_findings({image}), ::testing::IsEmpty());
}

TEST(GroundDepthRule, IsThePlaneZ0) {
  formats::Image image = formats::hand_made::image();
  std::vector<std::uint32_t> ids(100 * 80, formats::kGround);
  std::vector<std::uint16_t> depth(100 * 80, 0);
  // Row y looks down by (y - 39.5) / 50 per meter ahead: depth 10 * 50 / (y - 39.5).
  for (int y = 41; y < 80; ++y) {
    for (int x = 0; x < 100; ++x) {
      depth[static_cast<std::size_t>(100 * y + x)] =
          static_cast<std::uint16_t>(std::lround(100 * 500 / (y - 39.5)));
    }
  }
  const auto faults = [&](double factor) {
    std::vector<std::uint16_t> scaled = depth;
    for (auto& d : scaled) d = static_cast<std::uint16_t>(std::lround(factor * d));
    return found_by([&](Findings& findings) {
      check_ground_depth(image, "depth/x.png", ids, scaled, findings);
    });
  };
  EXPECT_THAT(faults(1), ::testing::IsEmpty());
  EXPECT_TRUE(any_with(faults(1.02), "depth-of-ground image 7"));
  EXPECT_TRUE(any_with(faults(0.98), "depth-of-ground"));
}

TEST(DensityRule, IsTheHeadsKernels) {
  formats::Image image = with_walker();
  image.people[0].head = Eigen::Vector2d(50.25, 60.5);
  // A Gaussian of sigma 4 about the head, pixels' middles at i + 0.5, of sum 1.
  formats::FloatMap map{100, 80, std::vector<float>(8000)};
  double sum = 0;
  const auto weight = [](int x, int y) {
    const double dx = x + 0.5 - 50.25;
    const double dy = y + 0.5 - 60.5;
    return std::exp(-(dx * dx + dy * dy) / 32);
  };
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 100; ++x) sum += weight(x, y);
  }
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 100; ++x) {
      map.value[static_cast<std::size_t>(100 * y + x)] = static_cast<float>(weight(x, y) / sum);
    }
  }
  const auto faults = [&](const formats::FloatMap& shown) {
    return found_by([&](Findings& findings) {
      check_density_is_heads(image, "density/x.npy", shown, 4, findings);
    });
  };
  EXPECT_THAT(faults(map), ::testing::IsEmpty());
  formats::FloatMap doubled = map;
  for (float& value : doubled.value) value *= 2;
  EXPECT_TRUE(any_with(faults(doubled), "density-is-heads image 7"));
  formats::FloatMap stray = map;
  stray.value[0] = 0.001F;
  EXPECT_TRUE(any_with(faults(stray), "at pixel (0, 0)"));
}

Pixels fill_pixels(std::uint32_t id) {
  Pixels pixels;
  pixels.width = 100;
  pixels.height = 80;
  pixels.ids.assign(8000, id);
  return pixels;
}

TEST(PartRules, PeopleHaveAPartAndNothingElseHas) {
  const auto faults = [](std::uint32_t id, std::uint16_t part) {
    Pixels pixels = fill_pixels(id);
    pixels.parts.assign(8000, part);
    return found_by([&](Findings& findings) {
      check_parts(formats::hand_made::info("/x"), formats::hand_made::image(), pixels, findings);
    });
  };
  EXPECT_THAT(faults(3, 1), ::testing::IsEmpty());
  EXPECT_THAT(faults(3, 9), ::testing::IsEmpty());
  EXPECT_THAT(faults(formats::kGround, 0), ::testing::IsEmpty());
  EXPECT_TRUE(any_with(faults(3, 0), "parts image 7 8000 pixels"));
  EXPECT_TRUE(any_with(faults(3, 10), "parts"));
  EXPECT_TRUE(any_with(faults(formats::kGround, 2), "parts"));
}

TEST(NormalRules, HaveLengthOneExceptInTheSky) {
  const auto faults = [](std::uint32_t id, int x, int y, int z) {
    Pixels pixels = fill_pixels(id);
    for (int i = 0; i < 8000; ++i) {
      for (const int n : {x, y, z}) pixels.normals.push_back(static_cast<std::uint16_t>(n));
    }
    return found_by([&](Findings& findings) {
      check_normal_lengths(formats::hand_made::info("/x"), formats::hand_made::image(), pixels,
                           findings);
    });
  };
  EXPECT_THAT(faults(formats::kGround, 128, 128, 255), ::testing::IsEmpty());
  EXPECT_THAT(faults(formats::kGround, 128 + 76, 128, 128 + 102), ::testing::IsEmpty())
      << "0.6, 0, 0.8";
  EXPECT_THAT(faults(0, 0, 0, 0), ::testing::IsEmpty());
  EXPECT_TRUE(any_with(faults(formats::kGround, 128, 128, 240), "normals image 7 8000 pixels"));
  EXPECT_TRUE(any_with(faults(formats::kGround, 0, 0, 0), "normals"));
  EXPECT_TRUE(any_with(faults(0, 128, 128, 255), "normals"));
}

TEST(FindingsList, KeepsTheFirstHundredAndCountsAll) {
  Validation validation;
  Findings findings(validation);
  for (int i = 0; i < 250; ++i) findings.add("rule", "file", std::to_string(i), "what");
  EXPECT_EQ(validation.found, 250);
  ASSERT_EQ(validation.findings.size(), 100);
  EXPECT_EQ(validation.findings.back().record, "99");
}

}  // namespace
}  // namespace throng::checks
