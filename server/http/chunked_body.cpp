#include "server/http/chunked_body.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace throng::server {

namespace {

constexpr std::size_t kMaxSizeDigits = 15;        // as of a Content-Length
constexpr std::size_t kBlockBytes = 256 << 10;    // freed one by one while the body is read
constexpr std::size_t kMaxExtensions = 16 << 10;  // and as many bytes as the body has

}  // namespace

std::size_t ChunkedBody::take(std::string_view received) {
  std::size_t taken = 0;
  while (taken < received.size() && error_.status == 0 && !is_whole()) {
    if (state_ != State::data) {
      take_line_char(received[taken++]);
      continue;
    }
    const std::string_view data = received.substr(taken, left_);
    take_data(data);
    taken += data.size();
    left_ -= data.size();
    if (left_ == 0) state_ = State::data_end;
  }
  return taken;
}

void ChunkedBody::take_data(std::string_view data) {
  bytes_ += data.size();
  while (!data.empty()) {
    if (blocks_.empty() || blocks_.back().size() == kBlockBytes) blocks_.emplace_back();
    const std::string_view part = data.substr(0, kBlockBytes - blocks_.back().size());
    blocks_.back() += part;
    data.remove_prefix(part.size());
  }
}

void ChunkedBody::take_line_char(char c) {
  const bool ends = line_.ends_with('\r');
  const auto byte = static_cast<unsigned char>(c);
  const bool is_control = (byte < ' ' && c != '\t' && c != '\r') || byte == 0x7f;
  if (ends ? c != '\n' : is_control) {
    return fail(400, "lines of a chunked body end with CR LF and hold no control characters");
  }
  if (!ends && c != '\r' && state_ == State::data_end) {
    return fail(400, "a chunk is longer than its size");
  }
  if (ends) {
    line_.pop_back();
    end_line();
    return line_.clear();
  }
  line_ += c;
  if (line_.size() > kMaxLineBytes) {
    fail(state_ == State::trailer ? 431 : 400,
         fmt::format("a line of a chunked body has at most {} bytes", kMaxLineBytes));
  }
}

void ChunkedBody::end_line() {
  if (state_ == State::size) return read_size();
  if (state_ == State::data_end) {
    state_ = State::size;
    return;
  }
  if (line_.empty()) {
    state_ = State::whole;
    return;
  }
  trailers_ += line_.size();
  if (trailers_ > kMaxHeadBytes) return fail(431, "the trailers are too long");
  if (HeadError wrong = check_header_field(line_); wrong.status != 0) error_ = std::move(wrong);
}

void ChunkedBody::read_size() {
  std::uint64_t size = 0;
  const char* end = line_.data() + line_.size();
  const auto [at, status] = std::from_chars(line_.data(), end, size, 16);
  const auto digits = static_cast<std::size_t>(at - line_.data());
  std::string_view extension(at, static_cast<std::size_t>(end - at));
  extensions_ += extension.size();
  // Blanks are allowed only before an extension.
  extension.remove_prefix(std::min(extension.find_first_not_of(" \t"), extension.size()));
  const bool is_extension = extension.starts_with(';') || at == end;
  if (status != std::errc() || digits > kMaxSizeDigits || line_.starts_with('-') || !is_extension) {
    return fail(400,
                fmt::format("a chunk begins with its size, 1 to {} hex digits", kMaxSizeDigits));
  }
  if (extensions_ > kMaxExtensions + bytes_)
    return fail(400, "the chunks' extensions are too long");
  if (size > max_bytes_ - bytes_) {
    return fail(413, fmt::format("a body may have {} bytes here", max_bytes_));
  }
  left_ = size;
  state_ = size == 0 ? State::trailer : State::data;
}

std::size_t ChunkedBody::read(char* to, std::size_t size) {
  if (blocks_.empty()) return 0;
  const std::string_view part = std::string_view(blocks_.front()).substr(next_, size);
  std::memcpy(to, part.data(), part.size());
  next_ += part.size();
  const std::size_t given = part.size();
  if (next_ == blocks_.front().size()) {
    blocks_.pop_front();
    next_ = 0;
  }
  return given;
}

}  // namespace throng::server
