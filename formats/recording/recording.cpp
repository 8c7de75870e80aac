#include "formats/recording/recording.h"

namespace throng::formats::ros {

Recording::Recording(const std::filesystem::path& file, const McapOptions& options)
    : file_(file, options) {}

void Recording::add(const TopicMessage& message) {
  last_topic_ = message.topic;
  const auto [channel, is_new] = channels_.try_emplace(message.topic, 0);
  if (is_new) channel->second = file_.add_channel(message.topic, make_schema(message.kind));
  file_.add(channel->second, time_ns(message.time_s), message.bytes);
}

void Recording::close() { file_.close(); }

double Recording::complete_until_s() const {
  constexpr double kNsPerS = 1e9;
  return static_cast<double>(file_.complete_until_ns()) / kNsPerS;
}

}  // namespace throng::formats::ros
