#include "jobs/queue/slurm/message_file_reader.h"

#include "base/error.h"
#include "base/files/read_only_file.h"

namespace throng::jobs {

bool MessageFileReader::read() {
  steps_.clear();
  // No worker says more within a look; a strange file is read in many looks.
  constexpr std::size_t kMaxBytes = 1 << 20;
  std::string block(kMaxBytes, '\0');
  try {
    block.resize(ReadOnlyFile(path_).read_at(offset_, block));
  } catch (const EnvironmentError&) {  // there is none yet
    return false;
  }
  if (block.empty()) return false;
  offset_ += static_cast<std::int64_t>(block.size());
  pending_ += block;
  std::size_t start = 0;
  for (auto end = pending_.find('\n'); end != std::string::npos; end = pending_.find('\n', start)) {
    const std::string line = pending_.substr(start, end - start);
    start = end + 1;
    if (auto ended = read_attempt_end(line)) {
      end_ = std::move(ended);
      continue;
    }
    WorkerMessage message = read_worker_message(line);
    if (message.error) error_ = std::move(message.error);
    if (message.progress) steps_.push_back(*message.progress);
  }
  pending_.erase(0, start);
  if (pending_.size() > kMaxBytes) pending_.clear();
  return true;
}

}  // namespace throng::jobs
