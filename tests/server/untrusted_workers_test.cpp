// A worker that was taken over writes in its job's folder as it likes; the service follows nothing
// that leads out of it.
#include <gmock/gmock.h>

#include <filesystem>

#include "base/files/files.h"
#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kSecret = "the secret of the service";

class UntrustedWorkers : public ApiTest {
 protected:
  UntrustedWorkers() { write_file_atomically(secret, kSecret); }

  /// Puts a link to `target` in the place of a file or folder of the job.
  void replace_by_link(const fs::path& target, const fs::path& place) const {
    fs::remove_all(place);
    fs::create_directories(place.parent_path());
    fs::create_symlink(target, place);
  }

  void expect_no_secret(const std::string& path) {
    // An archive breaks off in the middle: the connection has no more of an answer.
    const RawConnection connection(api.port());
    connection.send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    const std::string answer = connection.read();
    EXPECT_THAT(answer, Not(HasSubstr(kSecret))) << path;
    EXPECT_THAT(answer, Not(HasSubstr("secret.txt"))) << path;
    EXPECT_THAT(answer, Not(HasSubstr(data.path().string()))) << path;
  }

  fs::path secret = data.path() / "secret.txt";
  std::string id = submit_and_wait();
  fs::path job = service.folders().job_folder(id);
  std::string self = "/v1/jobs/" + id;
};

TEST_F(UntrustedWorkers, LinksInTheirFoldersAreNotFollowed) {
  replace_by_link(secret, job / "logs/x.log");
  replace_by_link(data.path(), job / "logs/all");
  replace_by_link(secret, job / "dataset/metrics.json");
  replace_by_link(secret, job / "dataset/metrics/run000.json");
  replace_by_link(secret, job / "dataset/exits/run000.csv");
  replace_by_link(secret, job / "dataset/previews/a.jpg");
  replace_by_link(secret, job / "work/run000/trace.h5");
  replace_by_link(secret, job / "report.html");
  for (const char* path :
       {"/logs", "/logs/x.log", "/logs/all", "/metrics", "/runs/0/metrics", "/runs/0/metrics.csv",
        "/previews", "/previews/a.jpg", "/runs/0/trace", "/runs/0/trajectories", "/report",
        "/archive", "/archive?format=zip", "/files/metrics.json"}) {
    expect_no_secret(self + path);
  }
  EXPECT_EQ(read_file(secret), kSecret);
}

TEST_F(UntrustedWorkers, FoldersThatAreLinksAreNotListedOrRead) {
  const fs::path kept = data.path() / "copy";
  fs::rename(job / "dataset", kept);
  write_file_atomically(kept / "metrics.json", kSecret);
  write_file_atomically(kept / "previews/secret.txt", kSecret);
  replace_by_link(kept, job / "dataset");
  replace_by_link(data.path(), job / "logs");
  for (const char* path : {"/logs", "/logs/jobs.sqlite", "/previews", "/metrics", "/manifest",
                           "/files/metrics.json", "/archive", "/images"}) {
    expect_no_secret(self + path);
  }
}

TEST_F(UntrustedWorkers, AJobIsRestoredWithoutWritingElsewhere) {
  replace_by_link(secret, job / "job.json");
  const std::string name = "run000_trace.log";
  replace_by_link(secret, job / "logs" / name);
  fs::remove_all(job / "dataset");
  write_file_atomically(job / "dataset/metrics.json", "{}");
  static_cast<void>(client().Post(self + "/retry", "", "application/json"));
  EXPECT_EQ(read_file(secret), kSecret);
}

}  // namespace
}  // namespace throng::server
