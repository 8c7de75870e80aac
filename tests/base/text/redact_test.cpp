#include "base/text/redact.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

TEST(Redact, FilesAreNamedFromTheirFolder) {
  EXPECT_EQ(without_folders("/srv/data/jobs/x/job.json: /runs: 0 (/srv/scn/a.xml)",
                            {"/srv/data", "/srv/scn"}),
            "jobs/x/job.json: /runs: 0 (a.xml)");
  EXPECT_EQ(without_folders("/srv/database/x", {"/srv/data"}), "/srv/database/x");
}

TEST(Redact, ARelativeFolderIsFoundByBothItsNames) {
  const std::string absolute = (std::filesystem::current_path() / "data/x").string();
  EXPECT_EQ(without_folders("data/x and " + absolute, {"data"}), "x and x");
  EXPECT_EQ(without_folders("a/b", {""}), "a/b");
}

}  // namespace
}  // namespace throng
