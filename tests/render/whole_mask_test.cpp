// Masks of whole people, against the image of each of them alone.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "render/lens/exposure.h"
#include "render/lens/lens.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

/// People close behind each other and a block that hides some; some reach beyond the image.
class Queue {
 public:
  Queue()
      : stage_(open_ground({block(-1, 0, -3, 0, 1.2)}), {}, with_masks()),
        alone_(open_ground(), {}, with_masks()),
        lens_(stage_.renderer(), stage_.people()),
        lens_alone_(alone_.renderer(), alone_.people()) {
    for (std::uint32_t i = 0; i < 12; ++i) {
      people_.push_back(stage_.standing(i, 1.0 + 0.4 * (i % 4), 0.8 * (i / 4) - 1.1, 0.6 * i));
    }
    people_.push_back(stage_.standing(12, -5.2, 0.4, 1));   // cut off below
    people_.push_back(stage_.standing(13, -3.4, 1.95, 2));  // cut off beside
  }

  static RenderOptions with_masks() {
    RenderOptions options;
    options.whole_masks = true;
    return options;
  }

  /// Everybody's mask is what shows of them with nobody else there, in every pixel.
  void expect_exact(const std::function<Frame(bool, const std::vector<PersonInstance>&)>& drawn) {
    const Frame together = drawn(false, people_);
    std::size_t partly_hidden = 0;
    std::size_t cut_off = 0;
    for (const PersonInstance& person : people_) {
      const Frame alone = drawn(true, {person});
      const PersonInView& truth = find_person(together, person.agent);
      ASSERT_NE(truth.whole_mask, nullptr);
      const std::uint32_t id = id_of_agent(person.agent);
      std::uint64_t pixels = 0;
      std::size_t wrong = 0;
      for (int y = 0; y < together.height(); ++y) {
        for (int x = 0; x < together.width(); ++x) {
          const bool is_covered = truth.whole_mask->at(x, y);
          pixels += is_covered ? 1 : 0;
          wrong += is_covered != (alone.id[pixel_index(alone, x, y)] == id) ? 1 : 0;
        }
      }
      EXPECT_EQ(wrong, 0U) << "agent " << person.agent;
      EXPECT_GT(pixels, 20U);
      EXPECT_LE(pixels, truth.amodal_area_px);
      cut_off += pixels < truth.amodal_area_px ? 1 : 0;
      const std::uint64_t visible = instance_mask(together, id).pixels;
      partly_hidden += visible < pixels ? 1 : 0;
    }
    EXPECT_GT(partly_hidden, 5U);
    EXPECT_GT(cut_off, 0U);
  }

  Lens& lens(bool is_alone) { return is_alone ? lens_alone_ : lens_; }

 private:
  Stage stage_;
  Stage alone_;
  Lens lens_;
  Lens lens_alone_;
  std::vector<PersonInstance> people_;
};

camera::Camera queue_camera() { return camera_at({-8, 0, 3}, 5, -14); }

Scene make_scene(const std::vector<PersonInstance>& people) {
  Scene scene;
  scene.people = people;
  return scene;
}

TEST(WholeMasks, AreTheMasksOfEachPersonAlone) {
  Queue queue;
  queue.expect_exact([&](bool is_alone, const std::vector<PersonInstance>& people) {
    return queue.lens(is_alone).draw(make_scene(people), queue_camera());
  });
}

TEST(WholeMasks, AreThoseOfTheDistortedImage) {
  Queue queue;
  camera::Camera camera = queue_camera();
  camera.intrinsics.distortion.emplace(camera::Distortion::Model::brown_conrady,
                                       camera::Distortion::Coefficients{-0.25, 0.05});
  queue.expect_exact([&](bool is_alone, const std::vector<PersonInstance>& people) {
    return queue.lens(is_alone).draw(make_scene(people), camera);
  });
}

TEST(WholeMasks, ArePutTogetherFromStrips) {
  Queue queue;
  queue.expect_exact([&](bool is_alone, const std::vector<PersonInstance>& people) {
    // The camera turns while the rows are read.
    const MomentAt turning = [&](double time_s) {
      ShutterMoment moment;
      auto scene = std::make_shared<Scene>(make_scene(people));
      scene->time_s = time_s;
      moment.scene = scene;
      moment.camera = camera_at({-8, 0, 3}, 5 + 20 * time_s, -14);
      return moment;
    };
    const Exposed exposed = expose(queue.lens(is_alone), turning, 0, {0, 0.03});
    EXPECT_GT(exposed.strips, 1);
    return exposed.frame;
  });
}

TEST(WholeMasks, AreNotMadeUnlessAskedFor) {
  Stage stage(open_ground());
  const Frame frame = stage.draw(queue_camera(), {stage.standing(0, 1, 0)});
  EXPECT_EQ(frame.people.at(0).whole_mask, nullptr);
}

}  // namespace
}  // namespace throng::render
