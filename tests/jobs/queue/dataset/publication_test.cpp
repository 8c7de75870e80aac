#include "jobs/queue/dataset/publication.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class PublicationTest : public testing::Test {
 protected:
  PublicationTest() {
    Publication publication(output);
    publication.add("images/0.jpg", "an image");
    write_new_file(publication.folder() / "coco/annotations", "annotations");
    publication.publish({{"images", 1}});
  }

  void overwrite(const std::string& name, std::size_t at) {
    std::fstream file(output / name, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const char byte = static_cast<char>(file.get());
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(byte ^ 1));
  }

  std::string damage() const {
    try {
      check_published(output, read_record(output));
      return "";
    } catch (const DamagedOutput& error) {
      return error.what();
    }
  }

  TemporaryFolder folder;
  fs::path output = folder.path() / "shard0000";
};

TEST_F(PublicationTest, IsAsItWasPublished) { EXPECT_EQ(damage(), ""); }

TEST_F(PublicationTest, AFlippedBitIsFound) {
  overwrite("files/images/0.jpg", 3);
  EXPECT_THAT(damage(), HasSubstr("files/images/0.jpg is damaged"));
}

TEST_F(PublicationTest, AFlippedBitBesideTheFilesOfTheDatasetIsFound) {
  overwrite("coco/annotations", 0);
  EXPECT_THAT(damage(), HasSubstr("coco/annotations is damaged"));
}

TEST_F(PublicationTest, AMissingFileIsFound) {
  for (const char* name : {"coco/annotations", "files/images/0.jpg", "record.json"}) {
    fs::rename(output / name, folder.path() / "aside");
    EXPECT_THAT(damage(), HasSubstr(std::string(name) + " is gone"));
    fs::rename(folder.path() / "aside", output / name);
  }
}

TEST_F(PublicationTest, ADamagedRecordIsFound) {
  for (const char* text : {"", "{", "[]", "{}", R"({"files": 3})", R"({"files": [{}]})", "\xff"}) {
    std::ofstream(output / "record.json") << text;
    EXPECT_THAT(damage(), HasSubstr("record.json")) << text;
  }
}

TEST_F(PublicationTest, TheRecordOfAnEarlierVersionIsTaken) {
  nlohmann::json record = read_record(output);
  record.erase("others");
  std::ofstream(output / "record.json") << record;
  EXPECT_EQ(damage(), "");
}

}  // namespace
}  // namespace throng::jobs
