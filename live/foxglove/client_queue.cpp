#include "live/foxglove/client_queue.h"

#include <array>
#include <utility>

namespace throng::foxglove {

namespace {

/// Memory of a message besides its bytes, about.
constexpr std::size_t kOverheadBytes = 128;

}  // namespace

void ClientQueue::push(Outgoing message) {
  const std::size_t bytes = message.size() + kOverheadBytes;
  if (message.rank == Rank::control) {
    control_bytes_ += bytes;
    control_.push_back({next_++, std::move(message)});
    return;
  }
  bytes_ += bytes;
  List& list = message.rank == Rank::image ? images_ : data_;
  list.push_back({next_++, std::move(message)});
  while (images_.size() > limits_.max_images) drop(images_);
  while (bytes_ > limits_.max_bytes && images_.size() > 1) drop(images_);
  while (bytes_ > limits_.max_bytes && !data_.empty()) drop(data_);
}

void ClientQueue::drop(List& list) {
  bytes_ -= list.front().message.size() + kOverheadBytes;
  list.pop_front();
  ++dropped_;
}

std::optional<Outgoing> ClientQueue::pop() {
  List* oldest = nullptr;
  for (List* list : std::array{&control_, &data_, &images_}) {
    if (list->empty()) continue;
    if (oldest == nullptr || list->front().number < oldest->front().number) oldest = list;
  }
  if (oldest == nullptr) return {};
  Outgoing message = std::move(oldest->front().message);
  oldest->pop_front();
  (oldest == &control_ ? control_bytes_ : bytes_) -= message.size() + kOverheadBytes;
  return message;
}

}  // namespace throng::foxglove
