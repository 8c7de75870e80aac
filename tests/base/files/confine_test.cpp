#include "base/files/confine.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

namespace throng {
namespace {

namespace fs = std::filesystem;

class Confining : public ::testing::Test {
 protected:
  Confining() {
    std::string name = (fs::temp_directory_path() / "throng-confine-XXXXXX").string();
    outer = ::mkdtemp(name.data());
    fs::create_directories(outer / "in/sub");
    fs::create_directories(outer / "inside");
    std::ofstream(outer / "secret") << "x";
  }
  ~Confining() override { fs::remove_all(outer); }

  fs::path outer;
};

TEST_F(Confining, LinksAndDotsAreFollowed) {
  const fs::path in = outer / "in";
  fs::create_symlink("../secret", in / "link");
  fs::create_directory_symlink("sub", in / "within");
  EXPECT_TRUE(lies_within(in / "a", in));
  EXPECT_TRUE(lies_within(in / "sub/../a", in));
  EXPECT_TRUE(lies_within(in / "within/a", in));
  EXPECT_FALSE(lies_within(in / "../secret", in));
  EXPECT_FALSE(lies_within(in / "link", in));
  EXPECT_FALSE(lies_within(outer / "inside/a", in)) << "a longer name is another folder";
  EXPECT_FALSE(lies_within(in / "/etc/passwd", in));
  fs::create_directory_symlink("loop", in / "loop");
  EXPECT_FALSE(lies_within(in / "loop/a", in));
}

TEST_F(Confining, HoldsForItsThreadAndItsTime) {
  EXPECT_TRUE(Confinement::allows(outer / "secret"));
  {
    const Confinement confinement(outer / "in");
    EXPECT_FALSE(Confinement::allows(outer / "secret"));
    EXPECT_TRUE(Confinement::allows(outer / "in/a"));
    bool other = false;
    std::thread([&] { other = Confinement::allows(outer / "secret"); }).join();
    EXPECT_TRUE(other);
  }
  EXPECT_TRUE(Confinement::allows(outer / "secret"));
}

}  // namespace
}  // namespace throng
