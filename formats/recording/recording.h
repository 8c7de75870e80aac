// The recording of one run: an MCAP file to which messages of topics are added.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "formats/files/mcap_file.h"
#include "formats/recording/message_sink.h"

namespace throng::formats::ros {

/// Throws EnvironmentError as McapFile does.
class Recording {
 public:
  explicit Recording(const std::filesystem::path& file, const McapOptions& options = {});

  /// Adds a message, and its topic where it is new.
  void add(const TopicMessage& message);
  /// Completes the file. The last permitted call, but for complete_until_s().
  void close();

  /// The topic of the last message; "" before the first.
  const std::string& last_topic() const { return last_topic_; }
  /// The file holds all messages that were added before this time.
  double complete_until_s() const;

 private:
  McapFile file_;
  std::map<std::string, std::uint16_t> channels_;
  std::string last_topic_;
};

}  // namespace throng::formats::ros
