// The fork server: a child for each request, whatever happens to others.
#include "jobs/queue/confine/fork_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/files/resources.h"
#include "jobs/queue/confine/confined_task.h"
#include "tests/base/wait_until.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class ForkServerTest : public testing::Test {
 protected:
  json ask(const json& request) const {
    const TemporaryFolder work;
    return task(request, work.path());
  }

  /// Processes whose children have begun to wait in a folder.
  static std::vector<pid_t> servers_of(const TemporaryFolder& work) {
    std::ifstream file(work.path() / "begun");
    std::vector<pid_t> servers;
    for (std::string line; std::getline(file, line) && !file.eof();) {
      servers.push_back(std::stoi(line));
    }
    return servers;
  }

  std::shared_ptr<ForkServer> server = std::make_shared<ForkServer>(
      std::vector<std::string>{program_path().parent_path() / "fork_server_program"});
  ConfinedTask task = confined_task_by(server);
};

TEST_F(ForkServerTest, EveryRequestHasAChildOfItsOwn) {
  std::set<int> children;
  for (int n = 0; n < 5; ++n) {
    const json answer = ask({{"do", "answer"}, {"n", n}});
    EXPECT_EQ(answer["n"], n);
    children.insert(answer["pid"].get<int>());
  }
  EXPECT_EQ(children.size(), 5U);
}

TEST_F(ForkServerTest, AChildThatDiesCostsItsRequestAlone) {
  for (int i = 0; i < 2; ++i) {
    try {
      ask({{"do", "die"}});
      FAIL() << "no error";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("ended by signal 9"));
    }
    EXPECT_EQ(ask({{"do", "answer"}, {"n", i}})["n"], i);
  }
  EXPECT_THROW(ask({{"do", "fail"}}), EnvironmentError);
  try {
    ask({{"do", "refuse"}});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().at(0).where, "/b");
  }
}

TEST_F(ForkServerTest, AServerThatIsGoneIsStartedAgain) {
  const auto first = ask({{"do", "answer"}, {"n", 1}})["server"].get<pid_t>();
  const TemporaryFolder work;
  const std::jthread killer([&] {
    for (std::size_t i = 1; i <= 2; ++i) {
      EXPECT_TRUE(wait_until([&] { return servers_of(work).size() == i; }));
      ::kill(servers_of(work).back(), SIGKILL);
    }
  });
  // A second server takes the request over; a third one does not.
  EXPECT_THROW(task({{"do", "wait"}}, work.path()), EnvironmentError);
  const std::vector<pid_t> servers = servers_of(work);
  ASSERT_EQ(servers.size(), 2U);
  EXPECT_EQ(servers[0], first);
  EXPECT_NE(servers[1], first);
  EXPECT_EQ(ask({{"do", "answer"}, {"n", 2}})["n"], 2);
}

TEST_F(ForkServerTest, ManyThreadsAskAtOnce) {
  std::vector<std::jthread> threads;
  threads.reserve(8);
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int n = 0; n < 20; ++n) {
        EXPECT_EQ(ask({{"do", "answer"}, {"n", 100 * t + n}})["n"], 100 * t + n);
      }
    });
  }
}

TEST_F(ForkServerTest, StoppingEndsRunningChildren) {
  const TemporaryFolder work;
  std::future<void> slow = std::async(std::launch::async, [&] {
    task({{"do", "wait"}}, work.path());
  });
  EXPECT_TRUE(wait_until([&] { return servers_of(work).size() == 1; }));
  server->stop();
  EXPECT_THROW(slow.get(), EnvironmentError);
  EXPECT_THROW(ask({{"do", "answer"}}), EnvironmentError);
}

TEST(ForkServerAlone, WithoutAProgramThereIsAnError) {
  const TemporaryFolder work;
  EXPECT_THROW(ForkServer({"/no/such/program"}).run(work.path()), EnvironmentError);
  EXPECT_THROW(ForkServer({"true"}).run(work.path()), EnvironmentError);
}

}  // namespace
}  // namespace throng::jobs
