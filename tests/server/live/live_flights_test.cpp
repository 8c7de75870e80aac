// Live flights with a process that pretends: it notes the commands and answers with messages.
#include "server/live/live_flights.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/files/files.h"
#include "spec/job/spec.h"
#include "tests/base/virtual_clock.h"
#include "tests/server/service_fixture.h"

namespace throng::server {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

constexpr const char* kJobText =
    R"({"scenario": "yard", "name": "flown", "drones": [{"id": "d1", "start": [0, 0, 9]}]})";

/// A script that says hello and then does `work`.
LiveLimits limits_with(const jobs::TemporaryFolder& folder, const std::string& work) {
  const std::filesystem::path script = folder.path() / "pretend.sh";
  write_file_atomically(script, "#!/bin/sh\nprintf 'H\\002\\000\\000\\000{}'\n" + work);
  return {.command = {"/bin/sh", script.string()}};
}

constexpr const char* kUntilStop = R"(
while read -r line; do
  echo "$line" >> "$1/commands"
  cp "$1/commands" "$1/../commands"
  case "$line" in *stop*) printf 'R\007\000\000\000{"a":1}'; exit 0;; esac
done
)";

jobs::ResolvedJob resolved() { return jobs::ResolvedJob(jobs::parse_job(kJobText, ""), {10}); }

TEST(LiveFlights, ThoseOfRevokedKeysEnd) {
  const jobs::TemporaryFolder folder;
  LiveFlights flights(folder.path(), limits_with(folder, kUntilStop));
  const auto of_alice = flights.begin(resolved(), "alice");
  const auto of_bob = flights.begin(resolved(), "bob");
  EXPECT_EQ(flights.remove_all_of({"alice", "carol"}), 1);
  EXPECT_EQ(flights.find(of_alice->spec().id), nullptr);
  EXPECT_NE(flights.find(of_bob->spec().id), nullptr);
}

TEST(LiveFlights, ARecordingHasTheBytesThatAreLeftToItsKey) {
  const jobs::TemporaryFolder folder;
  LiveFlights flights(folder.path(), limits_with(folder, R"(echo "$4 $5" > "$1/flight.mcap")" +
                                                             std::string(kUntilStop)));
  const auto flight = flights.begin(resolved(), "alice", true, 1234);
  EXPECT_TRUE(flight->stop());
  EXPECT_EQ(read_file(flight->recording()), "--max-bytes 1234\n");
  EXPECT_GT(flights.disk_bytes_of("alice"), 0);
}

TEST(LiveFlights, CommandsGoInAndMessagesComeOut) {
  const jobs::TemporaryFolder folder;
  LiveFlights flights(folder.path(), limits_with(folder, kUntilStop));
  const auto flight = flights.begin(resolved(), "alice");
  EXPECT_EQ(flight->spec().name, "flown");
  ASSERT_EQ(flight->spec().drones.size(), 1U);
  EXPECT_EQ(flight->spec().drones[0].id, "d1");
  ASSERT_TRUE(wait_until([&] { return flight->progress().state == LiveState::flying; }));
  LiveFlight::Viewer viewer(flight);
  EXPECT_EQ(flight->audience().viewers, 1);
  EXPECT_EQ(viewer.next(), live::framed({live::MessageType::hello, "{}"}));
  live::Commands commands;
  commands.sequence = 3;
  commands.drones.emplace_back();
  commands.drones.back().id = "d1";
  commands.drones.back().beacon = true;
  EXPECT_TRUE(flight->command(commands));
  EXPECT_TRUE(flight->stop());
  EXPECT_EQ(flight->progress().state, LiveState::ended);
  EXPECT_EQ(flight->progress().outcome, json({{"a", 1}}));
  EXPECT_EQ(viewer.next(), live::framed({live::MessageType::result, R"({"a":1})"}));
  EXPECT_EQ(viewer.next(), "");
  EXPECT_FALSE(flight->command(commands));
  const std::string sent = read_file(folder.path() / "live" / "commands");
  EXPECT_NE(sent.find(R"({"viewers":1})"), std::string::npos) << sent;
  EXPECT_NE(sent.find(R"("beacon":true)"), std::string::npos) << sent;
  EXPECT_NE(sent.find(R"("sequence":3)"), std::string::npos) << sent;
}

TEST(LiveFlights, OneThatIsRecordedIsAskedTo) {
  const jobs::TemporaryFolder folder;
  LiveLimits limits =
      limits_with(folder, R"(echo "$2 $3" > "$1/flight.mcap")" + std::string(kUntilStop));
  limits.min_free_mib = 77;
  LiveFlights flights(folder.path(), limits);
  std::filesystem::path file;
  {
    const auto flight = flights.begin(resolved(), "alice", true);
    EXPECT_TRUE(flight->spec().is_recorded);
    EXPECT_TRUE(flight->stop());
    file = flight->recording();
    EXPECT_EQ(read_file(file), "--record 77\n");
    flights.remove(flight->spec().id);
    EXPECT_TRUE(std::filesystem::exists(file)) << "while somebody has the flight";
  }
  EXPECT_FALSE(std::filesystem::exists(file));
  const auto other = flights.begin(resolved(), "alice");
  EXPECT_FALSE(other->spec().is_recorded);
  EXPECT_TRUE(other->stop());
  EXPECT_EQ(read_file(other->recording()), " \n");
}

TEST(LiveFlights, AProcessThatDiesFailsItsFlight) {
  const jobs::TemporaryFolder folder;
  for (const auto& [work, message] :
       {std::pair{"exit 7", "code 7"}, {"kill -9 $$", "signal 9"}, {"echo rubbish", "cannot be"}}) {
    LiveFlights flights(folder.path(), limits_with(folder, work));
    const auto flight = flights.begin(resolved(), "alice");
    LiveFlight::Viewer viewer(flight);
    ASSERT_TRUE(wait_until([&] { return flight->progress().state == LiveState::failed; })) << work;
    const std::string text = flight->progress().outcome.at("message");
    EXPECT_NE(text.find(message), std::string::npos) << text;
    std::string seen;
    for (std::string bytes = viewer.next(); !bytes.empty(); bytes = viewer.next()) seen += bytes;
    EXPECT_NE(seen.find(message), std::string::npos) << "viewers hear of it";
    EXPECT_TRUE(flight->stop()) << "there is nothing to wait for";
  }
}

TEST(LiveFlights, OneThatNobodyLooksAtEnds) {
  const jobs::TemporaryFolder folder;
  LiveLimits limits = limits_with(folder, kUntilStop);
  VirtualClock clock;
  limits.now = clock.now();
  LiveFlights flights(folder.path(), limits);
  const auto seen = flights.begin(resolved(), "alice");
  const LiveFlight::Viewer viewer(seen);
  // When the second is gone, all were looked at since the time of the first was up.
  for (int i = 0; i < 2; ++i) {
    const std::string unseen = flights.begin(resolved(), "alice")->spec().id;
    clock.advance(limits.unseen - 1ms);
    const int asked = clock.asked();
    ASSERT_TRUE(wait_until([&] { return clock.asked() > asked + 3; }));  // once a look
    EXPECT_NE(flights.find(unseen), nullptr);
    clock.advance(1ms);
    EXPECT_TRUE(wait_until([&] { return flights.find(unseen) == nullptr; }));
    EXPECT_EQ(flights.find(seen->spec().id), seen);
  }
}

TEST(LiveFlights, ARemovedOneTellsItsViewersAndLeavesNothingBehind) {
  const jobs::TemporaryFolder folder;
  LiveFlights flights(folder.path(), limits_with(folder, kUntilStop));
  auto flight = flights.begin(resolved(), "alice");
  ASSERT_TRUE(wait_until([&] { return flight->progress().state == LiveState::flying; }));
  {
    LiveFlight::Viewer viewer(flight);
    EXPECT_TRUE(flights.remove(flight->spec().id));
    EXPECT_FALSE(flights.remove(flight->spec().id));
    EXPECT_NE(viewer.next().find("was removed"), std::string::npos);
    EXPECT_EQ(viewer.next(), "");
  }
  flight.reset();
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "live")) {
    EXPECT_EQ(entry.path().filename(), "commands");
  }
}

TEST(LiveFlights, AreLimited) {
  const jobs::TemporaryFolder folder;
  LiveLimits limits = limits_with(folder, kUntilStop);
  limits.max_all = 3;
  LiveFlights flights(folder.path(), limits);
  const auto first = flights.begin(resolved(), "alice");
  const auto second = flights.begin(resolved(), "alice");
  EXPECT_THROW(flights.begin(resolved(), "alice"), LiveFlightsFull);
  const auto third = flights.begin(resolved(), "bob");
  EXPECT_THROW(flights.begin(resolved(), "bob"), LiveFlightsFull);
  flights.remove(first->spec().id);
  EXPECT_NO_THROW(flights.begin(resolved(), "bob"));
  EXPECT_EQ(flights.all().size(), 3U);
}

}  // namespace
}  // namespace throng::server
