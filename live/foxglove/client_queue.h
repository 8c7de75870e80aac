// Messages that wait until a client takes them. A slow client gets fewer, never all too old ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

namespace throng::foxglove {

/// How far a message may be dropped for a client that is slow.
enum class Rank : std::uint8_t {
  control,  ///< never
  data,     ///< if many bytes wait
  image,    ///< if some images wait, and before data
};

/// A message to a client: the head, which is the client's, and the body, which clients share.
struct Outgoing {
  Rank rank = Rank::control;
  bool is_binary = false;
  std::string head;
  std::shared_ptr<const std::string> body = nullptr;  ///< null: empty

  std::size_t size() const { return head.size() + (body ? body->size() : 0); }
};

/// Limits of what waits.
struct QueueLimits {
  std::size_t max_bytes = std::size_t{16} << 20;         ///< of data and images
  std::size_t max_images = 3;                            ///< of all channels
  std::size_t max_control_bytes = std::size_t{4} << 20;  ///< is_overrun() above
};

/// Keeps the order of messages, and drops the oldest ones beyond the limits: images first.
class ClientQueue {
 public:
  explicit ClientQueue(const QueueLimits& limits = {}) : limits_(limits) {}

  void push(Outgoing message);
  /// The oldest message, if any.
  std::optional<Outgoing> pop();

  bool empty() const { return control_.empty() && data_.empty() && images_.empty(); }
  /// Whether the client takes nothing although it asks for much: there is no hope for it.
  bool is_overrun() const { return control_bytes_ > limits_.max_control_bytes; }
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Numbered {
    std::uint64_t number = 0;
    Outgoing message;
  };
  using List = std::deque<Numbered>;

  void drop(List& list);

  QueueLimits limits_;
  List control_;
  List data_;
  List images_;
  std::size_t bytes_ = 0;  ///< of data and images
  std::size_t control_bytes_ = 0;
  std::uint64_t next_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace throng::foxglove
