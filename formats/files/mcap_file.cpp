#include "formats/files/mcap_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/files/hash.h"
#include "base/resource_exhaustion.h"
#include "base/version.h"

namespace throng::formats {

namespace {

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);

enum class Opcode : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 11,
  summary_offset = 14,
  data_end = 15,
};

template <typename Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(Number));
}

void append_text(std::string& bytes, std::string_view text) {
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.append(text);
}

/// A record's head and content.
std::string record(Opcode opcode, std::string_view content) {
  std::string bytes;
  append(bytes, static_cast<std::uint8_t>(opcode));
  append(bytes, static_cast<std::uint64_t>(content.size()));
  bytes.append(content);
  return bytes;
}

/// First and last time of messages.
struct Span {
  std::uint64_t from_ns = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t to_ns = 0;

  void include(std::uint64_t time_ns) {
    from_ns = std::min(from_ns, time_ns);
    to_ns = std::max(to_ns, time_ns);
  }
  void append_to(std::string& bytes) const {
    append(bytes, from_ns <= to_ns ? from_ns : std::uint64_t{0});
    append(bytes, to_ns);
  }
};

struct Channel {
  std::string record;
  std::uint32_t messages = 0;
  std::string index;  ///< time and offset of each message of the open chunk
};

/// The file itself: a position, and space that is reserved behind it.
class Space {
 public:
  explicit Space(std::filesystem::path path)
      : path_(std::move(path)),
        file_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
    if (file_ < 0) fail();
  }
  ~Space() {
    if (file_ >= 0) ::close(file_);
  }
  Space(const Space&) = delete;
  Space& operator=(const Space&) = delete;

  std::uint64_t position() const { return position_; }

  /// Makes sure that this many bytes can be written. The file's size stays, so that it ends with a
  /// whole chunk if the process is killed.
  bool reserve(std::uint64_t bytes) const {
    rlimit limit{};
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && position_ + bytes > limit.rlim_cur) {
      errno = EFBIG;
      return false;
    }
    const auto from = static_cast<off_t>(position_);
    const auto size = static_cast<off_t>(bytes);
    if (::fallocate(file_, FALLOC_FL_KEEP_SIZE, from, size) == 0) return true;
    if (errno != EOPNOTSUPP) return false;
    const int error = ::posix_fallocate(file_, from, size);
    if (error == 0) return true;
    errno = error;
    return false;
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written =
          ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(position_));
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail();
      position_ += static_cast<std::uint64_t>(written);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void close() {
    if (::ftruncate(file_, static_cast<off_t>(position_)) != 0) fail();
    if (::close(std::exchange(file_, -1)) != 0) fail();
  }

  [[noreturn]] void fail() const { throw_write_error(path_, errno); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int file_;
  std::uint64_t position_ = 0;
};

}  // namespace

struct McapFile::State {
  State(std::filesystem::path path, McapOptions given)
      : space(std::move(path)), options(std::move(given)), compressor(ZSTD_createCCtx()) {
    check(compressor != nullptr, "zstd has memory for a context");
  }
  ~State() { ZSTD_freeCCtx(compressor); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::string make_summary(std::uint64_t start) const;
  std::uint64_t max_end_bytes() const;
  std::string compress() const;
  void begin();
  void write_chunk();
  std::uint64_t complete_until_ns() const { return std::min(span.to_ns, chunk_span.from_ns); }
  void end();

  Space space;
  McapOptions options;
  ZSTD_CCtx* compressor;
  std::vector<std::string> schemas;  ///< contents, their id being their index + 1
  std::vector<Channel> channels;
  std::string chunk;  ///< records of the open chunk
  Span chunk_span;
  std::string chunk_indexes;  ///< records
  std::uint32_t chunks = 0;
  bool is_ended = false;
  std::uint64_t messages = 0;                ///< of written chunks
  std::vector<std::uint64_t> messages_of;    ///< by channel, of written chunks
  Span span;                                 ///< of written chunks
  std::vector<std::uint64_t> open_messages;  ///< by channel, of the open chunk
};

std::string McapFile::State::make_summary(std::uint64_t start) const {
  struct Group {
    Opcode opcode;
    std::string bytes;
  };
  std::array<Group, 4> groups{{{Opcode::schema, {}},
                               {Opcode::channel, {}},
                               {Opcode::statistics, {}},
                               {Opcode::chunk_index, chunk_indexes}}};
  for (const std::string& schema : schemas) groups[0].bytes += record(Opcode::schema, schema);
  for (const Channel& channel : channels) groups[1].bytes += channel.record;
  std::string statistics;
  append(statistics, messages);
  append(statistics, static_cast<std::uint16_t>(schemas.size()));
  append(statistics, static_cast<std::uint32_t>(channels.size()));
  append(statistics, std::uint32_t{0});  // attachments
  append(statistics, std::uint32_t{0});  // metadata
  append(statistics, chunks);
  span.append_to(statistics);
  constexpr std::size_t kCountBytes = 10;
  append(statistics, static_cast<std::uint32_t>(kCountBytes * messages_of.size()));
  for (std::size_t i = 0; i < messages_of.size(); ++i) {
    append(statistics, static_cast<std::uint16_t>(i));
    append(statistics, messages_of[i]);
  }
  groups[2].bytes = record(Opcode::statistics, statistics);

  std::string summary;
  std::string offsets;
  for (const Group& group : groups) {
    if (group.bytes.empty()) continue;
    std::string offset;
    append(offset, static_cast<std::uint8_t>(group.opcode));
    append(offset, start + summary.size());
    append(offset, static_cast<std::uint64_t>(group.bytes.size()));
    offsets += record(Opcode::summary_offset, offset);
    summary += group.bytes;
  }
  const std::uint64_t offset_start = start + summary.size();
  summary += offsets;
  std::string footer;
  append(footer, start);
  append(footer, offset_start);
  append(footer, std::uint32_t{0});
  std::string end = record(Opcode::footer, footer);
  end.resize(end.size() - sizeof(std::uint32_t));
  summary += end;  // the checksum covers the footer up to itself
  append(summary, crc32(summary));
  summary += kMcapMagic;
  return summary;
}

// At least what end() writes.
std::uint64_t McapFile::State::max_end_bytes() const {
  constexpr std::uint64_t kFixed = 1024;
  constexpr std::uint64_t kPerRecord = 32;
  std::uint64_t bytes = kFixed + chunk_indexes.size();
  for (const std::string& schema : schemas) bytes += schema.size() + kPerRecord;
  for (const Channel& channel : channels) bytes += channel.record.size() + kPerRecord;
  return bytes;
}

std::string McapFile::State::compress() const {
  std::string packed(ZSTD_compressBound(chunk.size()), '\0');
  constexpr int kLevel = 1;
  const std::size_t size = ZSTD_compressCCtx(compressor, packed.data(), packed.size(), chunk.data(),
                                             chunk.size(), kLevel);
  check(ZSTD_isError(size) == 0, "zstd compresses into the room that it asked for");
  packed.resize(size);
  return packed;
}

void McapFile::State::begin() {
  std::string header;
  append_text(header, options.profile);
  append_text(header, "throng " + std::string(kVersion));
  space.write(kMcapMagic);
  space.write(record(Opcode::header, header));
}

// The chunk, an index of each channel's messages in it, and the chunk's entry of the summary.
void McapFile::State::write_chunk() {
  if (chunk.empty()) return;
  const std::string packed = options.is_compressed ? compress() : chunk;
  const std::string_view compression = options.is_compressed ? "zstd" : "";
  std::string content;
  chunk_span.append_to(content);
  append(content, static_cast<std::uint64_t>(chunk.size()));
  append(content, crc32(chunk));
  append_text(content, compression);
  append(content, static_cast<std::uint64_t>(packed.size()));
  content += packed;
  const std::string head = record(Opcode::chunk, content);

  std::string indexes;
  std::string offsets;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].index.empty()) continue;
    append(offsets, static_cast<std::uint16_t>(i));
    append(offsets, space.position() + head.size() + indexes.size());
    std::string index;
    append(index, static_cast<std::uint16_t>(i));
    append_text(index, channels[i].index);
    indexes += record(Opcode::message_index, index);
  }
  std::string entry;
  chunk_span.append_to(entry);
  append(entry, space.position());
  append(entry, static_cast<std::uint64_t>(head.size()));
  append_text(entry, offsets);
  append(entry, static_cast<std::uint64_t>(indexes.size()));
  append_text(entry, compression);
  append(entry, static_cast<std::uint64_t>(packed.size()));
  append(entry, static_cast<std::uint64_t>(chunk.size()));
  const std::string index_record = record(Opcode::chunk_index, entry);

  if (!space.reserve(head.size() + indexes.size() + index_record.size() + max_end_bytes())) {
    const int error = errno;
    end();
    throw EnvironmentError(fmt::format(
        "cannot write {}: {}; the recording is complete until {:.3f} s", space.path().string(),
        std::strerror(error), 1e-9 * static_cast<double>(complete_until_ns())));
  }
  space.write(head);
  space.write(indexes);
  chunk_indexes += index_record;
  ++chunks;
  span.include(chunk_span.from_ns);
  span.include(chunk_span.to_ns);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    messages_of[i] += open_messages[i];
    messages += open_messages[i];
    open_messages[i] = 0;
    channels[i].index.clear();
  }
  chunk.clear();
  chunk_span = {};
}

void McapFile::State::end() {
  is_ended = true;
  std::string data_end;
  append(data_end, std::uint32_t{0});  // no checksum of all data
  space.write(record(Opcode::data_end, data_end));
  space.write(make_summary(space.position()));
  space.close();
}

McapFile::McapFile(std::filesystem::path path, McapOptions options)
    : state_(std::make_unique<State>(std::move(path), std::move(options))) {
  state_->begin();
}

McapFile::~McapFile() {
  try {
    if (!state_->is_ended) state_->end();
  } catch (const EnvironmentError&) {  // not even the reserved space
  }
}

std::uint16_t McapFile::add_channel(const std::string& topic, const McapSchema& schema) {
  std::string content;
  append_text(content, schema.name);
  append_text(content, schema.encoding);
  append_text(content, schema.text);
  std::vector<std::string>& schemas = state_->schemas;
  std::size_t known = 0;
  while (known < schemas.size() && schemas[known].substr(sizeof(std::uint16_t)) != content) ++known;
  const auto schema_id = static_cast<std::uint16_t>(known + 1);
  if (known == schemas.size()) {
    std::string with_id;
    append(with_id, schema_id);
    schemas.push_back(with_id + content);
  }
  const auto id = static_cast<std::uint16_t>(state_->channels.size());
  std::string channel;
  append(channel, id);
  append(channel, schema_id);
  append_text(channel, topic);
  append_text(channel, state_->options.message_encoding);
  append(channel, std::uint32_t{0});  // no metadata
  state_->channels.push_back({record(Opcode::channel, channel), 0, {}});
  state_->messages_of.push_back(0);
  state_->open_messages.push_back(0);
  state_->chunk += record(Opcode::schema, schemas[known]);
  state_->chunk += state_->channels.back().record;
  return id;
}

void McapFile::add(std::uint16_t channel, std::uint64_t time_ns, std::string_view message) {
  Channel& to = state_->channels.at(channel);
  append(to.index, time_ns);
  append(to.index, static_cast<std::uint64_t>(state_->chunk.size()));
  std::string content;
  append(content, channel);
  append(content, to.messages++);
  append(content, time_ns);  // logged
  append(content, time_ns);  // published
  content.append(message);
  state_->chunk += record(Opcode::message, content);
  state_->chunk_span.include(time_ns);
  ++state_->open_messages[channel];
  const McapOptions& options = state_->options;
  const std::uint64_t span_ns = state_->chunk_span.to_ns - state_->chunk_span.from_ns;
  if (state_->chunk.size() >= options.chunk_bytes ||
      (options.chunk_ns && span_ns >= *options.chunk_ns)) {
    state_->write_chunk();
  }
}

void McapFile::close() {
  state_->write_chunk();
  state_->end();
}

std::uint64_t McapFile::complete_until_ns() const { return state_->complete_until_ns(); }

}  // namespace throng::formats
