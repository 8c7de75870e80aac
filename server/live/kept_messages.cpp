#include "server/live/kept_messages.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

#include "base/json/json_text.h"
#include "server/catalog/api_json.h"

namespace throng::server {

using live::Message;
using live::MessageType;
using nlohmann::json;

const char* to_string(LiveState state) {
  constexpr std::array kNames = {"starting", "flying", "ended", "failed"};
  return kNames[static_cast<std::size_t>(state)];
}

Message failure_message(const std::string& kind, const std::string& text) {
  return {MessageType::failure,
          dump_text({{"kind", kind}, {"message", text}, {"problems", json::array()}})};
}

void KeptMessages::add(const Message& message) {
  constexpr std::size_t kMaxKeptEvents = 200;
  if (has_ended()) return;
  Numbered numbered{count_ + 1, live::framed(message)};
  switch (message.type) {
    case MessageType::hello:
      hello_ = std::move(numbered);
      progress_.state = LiveState::flying;
      break;
    case MessageType::state: {
      constexpr std::size_t kTimeAt = 8;
      if (message.bytes.size() >= kTimeAt + sizeof(double)) {
        std::memcpy(&progress_.time_s, message.bytes.data() + kTimeAt, sizeof(double));
      }
      world_ = std::move(numbered);
      break;
    }
    case MessageType::image:
      image_ = std::move(numbered);
      break;
    case MessageType::event:
      if (events_.size() == kMaxKeptEvents) events_.erase(events_.begin());
      events_.push_back(std::move(numbered));
      break;
    case MessageType::result:
    case MessageType::failure:
      progress_.outcome = parse_own_json(message.bytes, "the outcome of a live flight");
      progress_.state = message.type == MessageType::result ? LiveState::ended : LiveState::failed;
      end_ = std::move(numbered);
      break;
    case MessageType::alive:
      return;
  }
  ++count_;
}

std::string KeptMessages::after(std::uint64_t number) const {
  std::string bytes;
  const auto add = [&](const Numbered& message) {
    if (message.number > number) bytes += message.bytes;
  };
  add(hello_);
  add(world_);
  for (const Numbered& event : events_) add(event);
  add(image_);
  add(end_);
  return bytes;
}

}  // namespace throng::server
