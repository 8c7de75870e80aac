#include "live/foxglove/client_messages.h"

#include <fmt/core.h>

#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/text/suggest.h"

namespace throng::foxglove {

using nlohmann::json;

namespace {

constexpr const char* kSource = "message";
constexpr JsonLimits kLimits = {.max_depth = 16, .max_bytes = 1 << 20, .max_values = 20'000};

[[noreturn]] void refuse(const std::string& pointer, const json* found,
                         const std::string& expected) {
  constexpr std::size_t kShown = 60;
  throw InputError(
      {kSource, pointer,
       found == nullptr
           ? "nothing"
           : found->dump(-1, ' ', false, json::error_handler_t::replace).substr(0, kShown),
       expected});
}

/// An object of a message, and where it is in it.
struct Node {
  const json& value;
  std::string pointer;

  const json* find(const char* key) const {
    const auto found = value.find(key);
    return found == value.end() ? nullptr : &*found;
  }
  std::string below(const std::string& key) const { return pointer + "/" + key; }
};

std::uint32_t number(const json* value, const std::string& pointer) {
  constexpr double kMax = std::numeric_limits<std::uint32_t>::max();
  if (value == nullptr || !value->is_number()) {
    refuse(pointer, value, "an integer from 0 to 4294967295");
  }
  const auto real = value->get<double>();
  // Programs of JavaScript write whole numbers in either way.
  if (!(real >= 0 && real <= kMax) || real != static_cast<double>(static_cast<std::uint32_t>(real)))
    refuse(pointer, value, "an integer from 0 to 4294967295");
  return static_cast<std::uint32_t>(real);
}

std::string text(const json* value, const std::string& pointer) {
  if (value == nullptr || !value->is_string()) refuse(pointer, value, "a text");
  return value->get<std::string>();
}

std::optional<std::string> optional_text(const Node& place, const char* key) {
  const json* value = place.find(key);
  if (value == nullptr || value->is_null()) return {};
  return text(value, place.below(key));
}

const json& list(const Node& place, const char* key) {
  const json* value = place.find(key);
  if (value == nullptr || !value->is_array()) refuse(place.below(key), value, "a list");
  return *value;
}

/// Reads each element of the list `key` by read(value, pointer).
template <typename Read>
auto read_all(const Node& place, const char* key, Read read) {
  std::vector<decltype(read(place.value, place.pointer))> result;
  const json& values = list(place, key);
  for (std::size_t i = 0; i < values.size(); ++i) {
    result.push_back(read(values[i], place.below(key) + "/" + std::to_string(i)));
  }
  return result;
}

Node object(const json& value, const std::string& pointer) {
  if (!value.is_object()) refuse(pointer, &value, "an object");
  return {value, pointer};
}

std::vector<std::uint32_t> numbers(const Node& message, const char* key) {
  return read_all(message, key, [](const json& value, const std::string& pointer) {
    return number(&value, pointer);
  });
}

std::vector<std::string> names(const Node& message) {
  return read_all(message, "parameterNames", [](const json& value, const std::string& pointer) {
    return text(&value, pointer);
  });
}

ClientMessage read_subscribe(const Node& message) {
  return Subscribe{
      read_all(message, "subscriptions", [](const json& value, const std::string& pointer) {
        const Node place = object(value, pointer);
        return Subscription{number(place.find("id"), place.below("id")),
                            number(place.find("channelId"), place.below("channelId"))};
      })};
}

ClientMessage read_advertise(const Node& message) {
  return Advertise{read_all(message, "channels", [](const json& value, const std::string& pointer) {
    const Node place = object(value, pointer);
    return ClientChannel{number(place.find("id"), place.below("id")),
                         text(place.find("topic"), place.below("topic")),
                         text(place.find("encoding"), place.below("encoding")),
                         optional_text(place, "schemaName").value_or("")};
  })};
}

ClientMessage read_set_parameters(const Node& message) {
  return SetParameters{read_all(message, "parameters",
                                [](const json& value, const std::string& pointer) {
                                  const Node place = object(value, pointer);
                                  const json* given = place.find("value");
                                  return Parameter{text(place.find("name"), place.below("name")),
                                                   given == nullptr ? json() : *given};
                                }),
                       optional_text(message, "id")};
}

struct Operation {
  const char* name;
  ClientMessage (*read)(const Node&);
};

constexpr std::array kOperations{
    Operation{"subscribe", read_subscribe},
    Operation{"unsubscribe",
              [](const Node& message) -> ClientMessage {
                return Unsubscribe{numbers(message, "subscriptionIds")};
              }},
    Operation{"advertise", read_advertise},
    Operation{"unadvertise",
              [](const Node& message) -> ClientMessage {
                return Unadvertise{numbers(message, "channelIds")};
              }},
    Operation{"getParameters",
              [](const Node& message) -> ClientMessage {
                return GetParameters{names(message), optional_text(message, "id")};
              }},
    Operation{"setParameters", read_set_parameters},
    Operation{
        "subscribeParameterUpdates",
        [](const Node& message) -> ClientMessage { return SubscribeParameters{names(message)}; }},
    Operation{"unsubscribeParameterUpdates", [](const Node& message) -> ClientMessage {
                return UnsubscribeParameters{names(message)};
              }}};

/// Takes values off the front of a frame.
class FrameReader {
 public:
  explicit FrameReader(std::string_view bytes) : rest_(bytes) {}

  std::uint32_t take_number() {
    std::uint32_t value = 0;
    const std::string_view bytes = take(sizeof(value));
    std::memcpy(&value, bytes.data(), sizeof(value));
    return value;
  }
  std::string_view take(std::size_t count) {
    if (rest_.size() < count) {
      throw InputError(
          {kSource, "",
           fmt::format("a binary message that is {} bytes too short", count - rest_.size()),
           "one with all of its fields"});
    }
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

constexpr char kClientDataCode = 1;
constexpr char kClientCallCode = 2;

}  // namespace

ClientMessage read_text_message(std::string_view bytes) {
  const json value = parse_json(bytes, kSource, kLimits);
  const Node message = object(value, "");
  const std::string name = text(message.find("op"), "/op");
  std::vector<std::string_view> known;
  for (const Operation& operation : kOperations) {
    if (name == operation.name) return operation.read(message);
    known.emplace_back(operation.name);
  }
  throw InputError(unknown_name(kSource, "/op", "operation", name, known));
}

ClientMessage read_binary_message(std::string_view bytes) {
  FrameReader reader(bytes);
  const char code = reader.take(1).front();
  if (code == kClientDataCode) {
    const std::uint32_t channel = reader.take_number();
    return ClientData{channel, reader.rest()};
  }
  if (code == kClientCallCode) {
    ServiceCall call;
    call.service = reader.take_number();
    call.call = reader.take_number();
    call.encoding = reader.take(reader.take_number());
    call.bytes = reader.rest();
    return call;
  }
  throw InputError(
      {kSource, "",
       fmt::format("the binary operation {}", static_cast<int>(static_cast<unsigned char>(code))),
       "1 (data of a channel) or 2 (call of a service)"});
}

}  // namespace throng::foxglove
