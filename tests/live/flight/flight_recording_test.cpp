// Recordings of live flights where something goes wrong: the flight hears of it in the end only.
#include "live/flight/flight_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/files/files.h"
#include "spec/live/messages.h"
#include "tests/formats/files/mcap_reader.h"
#include "tests/jobs/yard.h"

namespace throng::live {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

formats::ros::TopicMessage text_at(double time_s, std::size_t bytes = 10) {
  return {"/text", formats::ros::Kind::text, time_s, std::string(bytes, 'x')};
}

std::vector<formats::mcap::Message> read_messages(const jobs::TemporaryFolder& folder) {
  return formats::mcap::read_messages(read_file(folder.path() / kRecordingFile));
}

TEST(FlightRecording, HoldsAllMessages) {
  const jobs::TemporaryFolder folder;
  FlightRecording recording(folder.path() / kRecordingFile, 0);
  for (const double time_s : {0.0, 0.5, 2.0, 1.9}) recording.add(text_at(time_s));
  const json result = recording.finish();
  EXPECT_EQ(result.at("complete_until_s"), 2.0);
  EXPECT_EQ(result.at("problem"), nullptr);
  EXPECT_EQ(result.at("bytes"), std::filesystem::file_size(folder.path() / kRecordingFile));
  EXPECT_EQ(read_messages(folder).size(), 4U);
}

/// As a disk that is full does, within a limit of this process for files.
TEST(FlightRecording, FullDiskEndsItAndKeepsWhatIsThere) {
  const jobs::TemporaryFolder folder;
  FlightRecording recording(folder.path() / kRecordingFile, 0);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{30'000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  std::vector<double> times_s;
  for (int step = 0; step < 3000; ++step) {
    times_s.push_back(0.1 * step);
    recording.add(text_at(times_s.back()));
    times_s.push_back(0.1 * step - 0.35);  // an image that was made meanwhile
    recording.add(text_at(times_s.back()));
  }
  const json result = recording.finish();
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(result.at("problem").get<std::string>(), HasSubstr("cannot write flight.mcap"));
  EXPECT_THAT(result.at("problem").get<std::string>(), Not(HasSubstr(folder.path().string())));
  const double until_s = result.at("complete_until_s");
  const auto is_before = [until_s](double time_s) { return time_s < until_s; };
  const std::vector<formats::mcap::Message> kept = read_messages(folder);
  const auto kept_before = std::count_if(kept.begin(), kept.end(), [&](const auto& message) {
    return is_before(1e-9 * static_cast<double>(message.time_ns));
  });
  EXPECT_GT(until_s, 20);
  EXPECT_LT(until_s, 290);
  EXPECT_EQ(kept_before, std::count_if(times_s.begin(), times_s.end(), is_before));
}

TEST(FlightRecording, EndsBeforeTheDiskIsFull) {
  const jobs::TemporaryFolder folder;
  FlightRecording recording(folder.path() / kRecordingFile, std::uint64_t{1} << 60);
  recording.add(text_at(0));
  recording.add(text_at(1));
  const json result = recording.finish();
  EXPECT_THAT(result.at("problem").get<std::string>(), HasSubstr("less than 1099511627776 MiB"));
  EXPECT_EQ(result.at("complete_until_s"), 0);
  EXPECT_EQ(read_messages(folder).size(), 0U);
}

TEST(FlightRecording, EndsWhenItHasTheBytesThatAreLeftToIt) {
  const jobs::TemporaryFolder folder;
  FlightRecording recording(folder.path() / kRecordingFile, 0, 1);
  for (const double time_s : {0.0, 2.0, 4.0, 6.0}) recording.add(text_at(time_s));
  const json result = recording.finish();
  EXPECT_THAT(result["problem"].get<std::string>(), HasSubstr("share of the disk"));
  EXPECT_LT(result["complete_until_s"].get<double>(), 6);
}

TEST(FlightRecording, WithoutAFolderThereIsNoFile) {
  FlightRecording recording("/nowhere/flight.mcap", 0);
  recording.add(text_at(3));
  const json result = recording.finish();
  EXPECT_THAT(result.at("problem").get<std::string>(), HasSubstr("cannot write flight.mcap"));
  EXPECT_EQ(result.at("complete_until_s"), 0);
  EXPECT_EQ(result.at("bytes"), 0);
}

TEST(FlightRecording, NamesTheFirstProblem) {
  const jobs::TemporaryFolder folder;
  FlightRecording recording(folder.path() / kRecordingFile, 0);
  recording.add(text_at(0));
  recording.add(text_at(2));
  recording.stop("names of drones");
  recording.stop("something else");
  recording.add(text_at(1.5));
  const json result = recording.finish();
  EXPECT_EQ(result.at("problem"), "names of drones");
  EXPECT_EQ(result.at("complete_until_s"), 1.5);
  EXPECT_EQ(read_messages(folder).size(), 2U);
}

}  // namespace
}  // namespace throng::live
