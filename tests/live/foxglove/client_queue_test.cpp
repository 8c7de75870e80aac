// Messages that a slow client loses.
#include "live/foxglove/client_queue.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace throng::foxglove {
namespace {

Outgoing message(Rank rank, const std::string& head, std::size_t bytes = 0) {
  return {rank, true, head, std::make_shared<const std::string>(bytes, 'x')};
}

/// The heads of all that waits, in order.
std::vector<std::string> take_all(ClientQueue& queue) {
  std::vector<std::string> heads;
  while (const auto next = queue.pop()) heads.push_back(next->head);
  return heads;
}

using Heads = std::vector<std::string>;

TEST(ClientQueue, KeepsTheOrder) {
  ClientQueue queue;
  queue.push(message(Rank::data, "a"));
  queue.push(message(Rank::image, "b"));
  queue.push(message(Rank::control, "c"));
  queue.push(message(Rank::data, "d"));
  EXPECT_FALSE(queue.empty());
  EXPECT_EQ(take_all(queue), (Heads{"a", "b", "c", "d"}));
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.dropped(), 0U);
}

TEST(ClientQueue, OnlyTheNewestImagesWait) {
  ClientQueue queue({.max_images = 2});
  for (const char* head : {"1", "2", "3", "4"}) queue.push(message(Rank::image, head, 1000));
  queue.push(message(Rank::data, "data"));
  EXPECT_EQ(take_all(queue), (Heads{"3", "4", "data"}));
  EXPECT_EQ(queue.dropped(), 2U);
}

TEST(ClientQueue, ImagesGoBeforeOldData) {
  ClientQueue queue({.max_bytes = 10'000});
  queue.push(message(Rank::image, "old image", 3000));
  queue.push(message(Rank::image, "new image", 3000));
  queue.push(message(Rank::data, "old data", 4000));
  EXPECT_EQ(queue.dropped(), 1U);
  queue.push(message(Rank::data, "new data", 4000));
  EXPECT_EQ(take_all(queue), (Heads{"new image", "new data"}));
  EXPECT_EQ(queue.dropped(), 2U);
}

TEST(ClientQueue, ControlIsNeverDroppedButCanBeTooMuch) {
  ClientQueue queue({.max_bytes = 0, .max_control_bytes = 2000});
  queue.push(message(Rank::control, "a", 1000));
  EXPECT_FALSE(queue.is_overrun());
  queue.push(message(Rank::control, "b", 1000));
  EXPECT_TRUE(queue.is_overrun());
  queue.push(message(Rank::data, "lost"));
  EXPECT_EQ(take_all(queue), (Heads{"a", "b"}));
  EXPECT_FALSE(queue.is_overrun());
}

}  // namespace
}  // namespace throng::foxglove
