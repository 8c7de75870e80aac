// Lines that come through a pipe.
#include "live/loop/input_lines.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <future>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/error.h"

namespace throng::live {
namespace {

class InputLines : public testing::Test {
 protected:
  InputLines() { EXPECT_EQ(::pipe(ends_.data()), 0); }
  ~InputLines() override {
    ::close(ends_[0]);
    close_writer();
  }

  void write(std::string_view text) const {
    EXPECT_EQ(::write(ends_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void close_writer() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }
  int reader() const { return ends_[0]; }

 private:
  std::array<int, 2> ends_{};
};

TEST_F(InputLines, AreWholeHoweverTheyArrive) {
  write("a\nb");
  std::vector<std::string> lines;
  read_lines(reader(), {}, [&](const std::string& line) {
    lines.push_back(line);
    if (lines.size() > 1) return;
    write("c\n\n" + std::string(10'000, 'x') + "\nnot a line");
    close_writer();
  });
  EXPECT_EQ(lines, (std::vector<std::string>{"a", "bc", "", std::string(10'000, 'x')}));
}

TEST_F(InputLines, AStopEndsTheWait) {
  std::promise<std::string> read;
  std::jthread thread([&](const std::stop_token& stop) {
    read_lines(reader(), stop, [&](const std::string& line) { read.set_value(line); });
  });
  write("hello\n");
  EXPECT_EQ(read.get_future().get(), "hello");
  thread.request_stop();
  thread.join();  // although the other end is open
}

TEST_F(InputLines, AFolderHasNone) {
  const int folder = ::open("/", O_RDONLY | O_CLOEXEC);
  EXPECT_THROW(read_lines(folder, {}, [](const std::string&) {}), EnvironmentError);
  ::close(folder);
}

}  // namespace
}  // namespace throng::live
