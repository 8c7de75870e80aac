// The images of a dataset by pages.
#include "server/jobs/image_list.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <ctime>

#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

std::vector<jobs::FileEntry> files_named(std::vector<std::string> paths) {
  std::sort(paths.begin(), paths.end());
  std::vector<jobs::FileEntry> files;
  for (std::string& path : paths) files.push_back({std::move(path), 7, ""});
  return files;
}

/// Some files beside the images, also below images/.
std::vector<jobs::FileEntry> make_file_list(int runs, const std::vector<std::string>& cameras,
                                            int frames) {
  std::vector<std::string> paths = {"README.md",
                                    "annotations/instances.json",
                                    "images.txt",
                                    "images/notes.txt",
                                    "images/run000/d1/mask.png",
                                    "imagesx/run000/d1/000000.jpg",
                                    "previews/run000/d1/000000.jpg"};
  for (int run = 0; run < runs; ++run) {
    for (const std::string& camera : cameras) {
      for (int frame = 0; frame < frames; ++frame) {
        paths.push_back(fmt::format("images/run{:03}/{}/{:06}.jpg", run, camera, frame));
      }
    }
  }
  return files_named(std::move(paths));
}

TEST(ImageList, PagesHoldEachImageOnce) {
  const auto files = make_file_list(2, {"d1", "view"}, 5);
  std::vector<std::string> seen;
  for (std::int64_t offset = 0; offset < 21; offset += 3) {
    const ImageList page = list_images(files, {"", "", offset, 3});
    EXPECT_EQ(page.total, 20);
    for (const ImageFile& image : page.images) {
      seen.push_back(image.file->path);
      EXPECT_EQ(fmt::format("images/{}/{}/{:06}.jpg", image.run, image.camera, image.frame),
                image.file->path);
    }
  }
  ASSERT_EQ(seen.size(), 20U);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(ImageList, FiltersAndSummary) {
  const auto files = make_file_list(3, {"d1", "d2"}, 4);
  const ImageList list = list_images(files, {"run001", "d2", 1, 2});
  EXPECT_EQ(list.total, 4);
  ASSERT_EQ(list.images.size(), 2U);
  EXPECT_EQ(list.images[0].file->path, "images/run001/d2/000001.jpg");
  ASSERT_EQ(list.runs.size(), 3U);
  const CameraFrames& frames = list.runs.at("run002").at("d1");
  EXPECT_EQ(frames.images, 4);
  EXPECT_EQ(frames.first, 0);
  EXPECT_EQ(frames.last, 3);
  EXPECT_EQ(list_images(files, {"run009", "", 0, 10}).total, 0);
  EXPECT_TRUE(list_images({}, {}).runs.empty());
}

TEST(ImageList, FramesNeedNotBeginAtZero) {
  const auto files = files_named({"images/run000/d1/000003.jpg", "images/run000/d1/000009.jpg"});
  const CameraFrames frames = list_images(files, {}).runs.at("run000").at("d1");
  EXPECT_EQ(frames.images, 2);
  EXPECT_EQ(frames.first, 3);
  EXPECT_EQ(frames.last, 9);
}

TEST(ImageList, AHundredThousandImagesTakeAMoment) {
  const auto files = make_file_list(100, {"d1", "d2"}, 500);
  // CPU time, with sanitizers too: a search per image would take minutes.
  const std::clock_t start = std::clock();
  EXPECT_EQ(list_images(files, {"", "", 50'000, 48}).total, 100'000);
  EXPECT_LT(std::clock() - start, 20 * CLOCKS_PER_SEC);
}

class ImagesApi : public ApiTest {};

TEST_F(ImagesApi, ListsTheFilesOfTheDataset) {
  const std::string self = "/v1/jobs/" + submit_and_wait();
  const json all = get_json(self + "/images");
  EXPECT_EQ(all["images"].size(), all["total"].get<std::size_t>());
  for (const json& image : all["images"]) {
    EXPECT_EQ(get(self + "/files/" + image["path"].get<std::string>())->status, 200);
  }
  expect_problem(get(self + "/images?limit=0"), 400);
  expect_problem(get(self + "/images?offset=-1"), 400);
  expect_problem(get("/v1/jobs/j0000000000000000/images"), 404);
}

TEST_F(ImagesApi, WaitsForTheDataset) {
  Gate gate(executor);
  expect_problem(get("/v1/jobs/" + submit() + "/images"), 409);
  gate.open();
}

}  // namespace
}  // namespace throng::server
