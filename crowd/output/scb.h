// Menge's trajectory files, .scb: a text "2.1" that ends with a 0, a header, and then one frame per
// time step of so many 32-bit floats per agent, all little-endian:
//   1.0  header: number of agents (int32)
//   2.x  header: number of agents (int32), time step (float), class of each agent (uint32)
//   1.0, 2.0  x, y, orientation (rad)
//   2.1  x, y, orientation, state
//   2.2  x, y, orientation, state, preferred velocity x, y, velocity x, y
//   2.3  x, y, direction x, y
//   2.4  x, ground's height, y, orientation
// Agents that do not take part have "not a number" for all of them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/files.h"
#include "crowd/output/recorder.h"

namespace throng::crowd {

inline constexpr std::array<std::string_view, 6> kScbVersions = {"1.0", "2.0", "2.1",
                                                                 "2.2", "2.3", "2.4"};

/// A file that is written frame by frame.
class ScbFile {
 public:
  /// `version` is one of kScbVersions; `classes` has the agents' classes. Throws EnvironmentError
  /// when the file cannot be written.
  ScbFile(const std::filesystem::path& path, std::string_view version, double dt_s,
          std::span<const std::int32_t> classes);

  /// Adds a frame: the version's floats, agent after agent.
  void add(std::span<const float> values);
  void commit() { file_.commit(); }

  const std::filesystem::path& path() const { return file_.path(); }
  void flush() { file_.flush(); }

 private:
  StagedFile file_;
  std::string bytes_;
};

class ScbWriter : public Recorder {
 public:
  /// `version` is one of kScbVersions. Throws EnvironmentError when the file cannot be written.
  ScbWriter(const std::filesystem::path& path, std::string_view version, const Simulation& crowd);

  void record(const Simulation& crowd) override;
  void finish(const Simulation& crowd) override;

  /// File of the frames so far, complete after flush().
  const std::filesystem::path& path() const { return file_.path(); }
  void flush() { file_.flush(); }

 private:
  std::size_t version_;  // index into kScbVersions
  ScbFile file_;
  std::vector<float> frame_;
};

class ScbReader {
 public:
  /// Throws EnvironmentError when the file cannot be read, InputError when it is no .scb file. A
  /// last frame that is cut off is left out, as Menge's own files end with one.
  explicit ScbReader(const std::filesystem::path& path);

  const std::string& version() const { return version_; }
  std::size_t agent_count() const { return agent_count_; }
  std::size_t floats_per_agent() const { return floats_per_agent_; }
  std::size_t frame_count() const { return frame_count_; }
  double dt_s() const { return dt_s_; }  ///< 0 when the version does not say
  const std::vector<std::uint32_t>& classes() const { return classes_; }  ///< empty in 1.0

  /// The floats of a frame, agent after agent. Throws EnvironmentError.
  std::vector<float> frame(std::size_t index);

 private:
  std::ifstream file_;
  std::string name_;
  std::string version_;
  std::size_t agent_count_ = 0;
  std::size_t floats_per_agent_ = 0;
  std::size_t frame_count_ = 0;
  std::uint64_t header_bytes_ = 0;
  double dt_s_ = 0;
  std::vector<std::uint32_t> classes_;
};

}  // namespace throng::crowd
