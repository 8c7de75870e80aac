// Work in confined children: what comes back, and what they may not do.
#include "jobs/queue/confine/confined_task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "base/error.h"
#include "jobs/queue/confine/file_fence.h"
#include "tests/jobs/queue/perform_in_child.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// The answer to a request of a child that runs this script; $0 is the work folder.
json run_script(const std::string& script) {
  const TemporaryFolder work;
  return confined_task_in_child({"sh", "-c", script})({{"task", "x"}}, work.path());
}

template <typename Error>
std::string script_error(const std::string& script) {
  try {
    run_script(script);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ConfinedTask, TheAnswerOfTheChildComesBack) {
  EXPECT_EQ(run_script(R"(cp "$0/request.json" "$0/answer.json")"), (json{{"task", "x"}}));
}

TEST(ConfinedTask, OneSenderLeavesRoomForOthers) {
  const TemporaryFolder folder;
  const std::string gate = (folder.path() / "gate").string();
  const ConfinedTask task =
      confined_task_in_child({"sh", "-c",
                              R"(case "$0" in *held*) while [ ! -e )" + gate +
                                  R"( ]; do sleep 0.01; done;; esac; echo 1 > "$0/answer.json")"});
  const auto run = [&](const std::string& sender, const std::string& name) {
    const TaskSender this_sender(sender);
    const std::filesystem::path work = folder.path() / name;
    std::filesystem::create_directories(work);
    return task({{"task", "x"}}, work);
  };
  std::vector<std::jthread> held;
  for (int i = 0; i < 70; ++i) {  // more than there are children
    held.emplace_back([&run, i] { run("a", "held" + std::to_string(i)); });
  }
  EXPECT_EQ(run("b", "quick"), 1) << "while all that the other may have are held";
  write_file_atomically(gate, "");
}

TEST(ConfinedTask, FailuresAreToldApart) {
  EXPECT_THAT(
      script_error<InputError>(
          R"(echo '[{"source":"a","where":"/b","found":"c","expected":"d"}]' > "$0/answer.json"; exit 2)"),
      HasSubstr("a: /b: found c"));
  EXPECT_THAT(script_error<InputError>("kill -KILL $$"), HasSubstr("ended by signal 9"));
  EXPECT_NE(script_error<EnvironmentError>("exit 3"), "");
  EXPECT_NE(script_error<EnvironmentError>("exit 0"), "");  // without an answer
}

TEST(ConfinedTask, AnAnswerThatWouldFillTheMemoryIsNotRead) {
  const char* script =
      R"(printf '"' > "$0/answer.json"; head -c 20000000 /dev/zero | tr '\0' x >> )"
      R"("$0/answer.json"; printf '"' >> "$0/answer.json")";
  EXPECT_THAT(script_error<InputError>(script), HasSubstr("at most 16777216"));
}

TEST(ConfinedTask, TheChildAnswersOrReportsMistakes) {
  EXPECT_EQ(performed_in_child(
                [](const json& request) {
                  return json{{"m", request["n"]}};
                },
                0)["m"],
            2);
  const auto wrong = [](const json&) -> json { throw InputError(Problem{"", "/n", "2", "3"}); };
  EXPECT_EQ(performed_in_child(wrong, 2)[0]["where"], "/n");
  EXPECT_EQ(performed_in_child([](const json&) -> json { throw EnvironmentError("disk"); }, 3),
            json());
}

TEST(ConfinedTask, TheChildReachesNoNetwork) {
  const json answer = performed_in_child(
      [](const json&) {
        return json{{"socket", ::socket(AF_INET, SOCK_STREAM, 0)}};
      },
      0);
  EXPECT_EQ(answer["socket"], -1);
}

TEST(ConfinedTask, TheChildWritesNowhereElse) {
  const TemporaryFolder outside;
  const auto file = outside.path() / "file";
  write_file_atomically(file, "before");
  const TemporaryFolder probe;
  const pid_t child = ::fork();
  if (child == 0) ::_exit(fence_this_process({{probe.path()}, {}, {}}).empty() ? 0 : 1);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WEXITSTATUS(status) != 0) GTEST_SKIP() << "no Landlock";
  const json answer = performed_in_child(
      [&](const json&) {
        std::ofstream stream(file);
        stream << "after";
        stream.close();
        return json{{"wrote", stream.good()}};
      },
      0);
  EXPECT_EQ(answer["wrote"], false);
  EXPECT_EQ(read_file(file), "before");
}

}  // namespace
}  // namespace throng::jobs
