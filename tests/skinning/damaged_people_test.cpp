// Files of character library that are damaged or missing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/files/files.h"
#include "skinning/population.h"
#include "skinning/population_files.h"

namespace throng::skinning {
namespace {

namespace fs = std::filesystem;

class DamagedPeopleTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(population_folder() / "population.json")) {
      GTEST_SKIP() << "no baked people in " << population_folder()
                   << ": run scripts/setup.sh or set THRONG_PEOPLE";
    }
    folder = fs::path(testing::TempDir()) / "damaged_people";
    fs::remove_all(folder);
    fs::copy(population_folder(), folder);
  }
  void TearDown() override {
    if (!folder.empty()) fs::remove_all(folder);
  }
  std::string message() const {
    try {
      load_population(folder);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  fs::path folder;
};

TEST_F(DamagedPeopleTest, ErrorsNameTheFileAndTheRemedy) {
  const std::string index = read_file(folder / "population.json");
  const auto expect_message_about = [&](const std::string& file) {
    EXPECT_NE(message().find(file), std::string::npos) << message();
    EXPECT_NE(message().find("throng people build"), std::string::npos) << message();
  };
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string changed = index;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  for (const std::string& changed :
       {std::string(), std::string("[1, 2]"),
        replaced(fmt::format("\"format\": {}", kPopulationFormat), "\"format\": 999"),
        replaced("\"clips\"", "\"chips\""), replaced("\"name\"", "\"game\""),
        replaced("\"frames\": 13", "\"frames\": 0"), replaced("\"#", "\"?")}) {
    write_file_atomically(folder / "population.json", changed);
    expect_message_about("population.json");
  }
  write_file_atomically(folder / "population.json", index);

  fs::resize_file(folder / "palettes.bin", 1000);
  expect_message_about("palettes.bin");
  const fs::path glb = folder / "person_001.glb";
  fs::resize_file(glb, 5000);
  expect_message_about(glb.filename().string());
  fs::remove(glb);
  expect_message_about(glb.filename().string());
  fs::remove(folder / "population.json");
  expect_message_about("population.json");
}

}  // namespace
}  // namespace throng::skinning
