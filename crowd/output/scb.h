// Menge's trajectory files, .scb: the version as text ("2.1") that ends with a zero byte, a header,
// and one frame per time step with these 32-bit floats per agent, all little-endian:
//   1.0  header: number of agents (int32)
//   2.x  header: number of agents (int32), time step (float), class of each agent (uint32)
//   1.0, 2.0  x, y, orientation (rad)
//   2.1  x, y, orientation, state
//   2.2  x, y, orientation, state, preferred velocity x, y, velocity x, y
//   2.3  x, y, direction x, y
//   2.4  x, ground's height, y, orientation
// All values of absent agents are NaN.
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

/// Writes an .scb file frame by frame.
class ScbFile {
 public:
  /// `version` is one of kScbVersions; `classes` has the class of each agent. Throws
  /// EnvironmentError if the file cannot be written.
  ScbFile(const std::filesystem::path& path, std::string_view version, double dt_s,
          std::span<const std::int32_t> classes);

  /// Appends a frame: the floats of the version for one agent after the other.
  void add(std::span<const float> values);
  /// Moves the file to its final name.
  void commit() { file_.commit(); }

  const std::filesystem::path& path() const { return file_.path(); }
  void flush() { file_.flush(); }

 private:
  StagedFile file_;
  std::string bytes_;
};

/// Records a simulation as an .scb file.
class ScbWriter : public Recorder {
 public:
  /// `version` is one of kScbVersions. Throws EnvironmentError if the file cannot be written.
  ScbWriter(const std::filesystem::path& path, std::string_view version, const Simulation& crowd);

  void record(const Simulation& crowd) override;
  void finish(const Simulation& crowd) override;

  /// The temporary file with the frames so far; complete after flush().
  const std::filesystem::path& path() const { return file_.path(); }
  void flush() { file_.flush(); }

 private:
  std::size_t version_;  // index into kScbVersions
  ScbFile file_;
  std::vector<float> frame_;
};

/// Reads an .scb file.
class ScbReader {
 public:
  /// Throws EnvironmentError if the file cannot be read, InputError if it is not an .scb file.
  /// Ignores an incomplete last frame, with which Menge's own files end.
  explicit ScbReader(const std::filesystem::path& path);

  const std::string& version() const { return version_; }
  std::size_t agent_count() const { return agent_count_; }
  std::size_t floats_per_agent() const { return floats_per_agent_; }
  std::size_t frame_count() const { return frame_count_; }
  double dt_s() const { return dt_s_; }  ///< 0 if the version has no time step
  const std::vector<std::uint32_t>& classes() const { return classes_; }  ///< empty in version 1.0

  /// Returns the floats of a frame, one agent after the other. Throws EnvironmentError.
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
