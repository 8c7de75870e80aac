#include "sim/recording/pilot_log.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/text/words.h"
#include "sim/recording/gimbal_setpoints.h"

namespace throng::sim {

namespace {

constexpr std::size_t kColumns = 6;
constexpr std::size_t kGimbalColumns = 2;

std::string gimbal_header() { return fmt::format("{}{}", kPilotLogHeader, kGimbalLogHeader); }

class LogReader {
 public:
  explicit LogReader(const std::string& source) : source_(source) {}

  [[noreturn]] void fail(std::string found, std::string expected) const {
    throw InputError(
        {source_, fmt::format("line {}", line_), std::move(found), std::move(expected)});
  }

  void read_line(std::string_view text) {
    ++line_;
    text = trimmed(text, " \r");
    if (line_ == 1) {
      has_gimbal_ = text == gimbal_header();
      if (text != kPilotLogHeader && !has_gimbal_) {
        fail(fmt::format("\"{:.90}\"", text),
             fmt::format("the header \"{}\" or \"{}\"", kPilotLogHeader, gimbal_header()));
      }
      return;
    }
    if (!text.empty()) samples_.push_back(read_sample(text));
  }

  std::vector<PilotSample> take() {
    if (samples_.empty()) fail("no set-point", "at least one line below the header");
    return std::move(samples_);
  }

 private:
  PilotSample read_sample(std::string_view text) const {
    const std::vector<std::string_view> cells = split(text);
    std::array<double, kColumns> values{};
    for (std::size_t i = 0; i < kColumns; ++i) values[i] = number(cells[i]);
    if (!samples_.empty() && !(values[0] > samples_.back().time_s)) {
      fail(fmt::format("{:g} s after {:g} s", values[0], samples_.back().time_s),
           "a later time than that of the line before");
    }
    if (values[5] != 0 && values[5] != 1) fail(fmt::format("beacon {:g}", values[5]), "0 or 1");
    PilotSample sample{
        values[0], {values[1], values[2], values[3]}, values[4] * kDegree, values[5] == 1};
    if (has_gimbal_ && !(cells[kColumns].empty() && cells[kColumns + 1].empty())) {
      sample.gimbal = {
          angle(cells[kColumns], camera::kMinGimbalPitchDeg, camera::kMaxGimbalPitchDeg),
          angle(cells[kColumns + 1], -camera::kMaxGimbalYawDeg, camera::kMaxGimbalYawDeg)};
    }
    return sample;
  }

  std::vector<std::string_view> split(std::string_view text) const {
    std::vector<std::string_view> cells;
    for (std::size_t comma = 0; comma != std::string_view::npos;) {
      comma = text.find(',');
      cells.push_back(trimmed(text.substr(0, comma), " \r"));
      text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
    }
    const std::size_t expected = kColumns + (has_gimbal_ ? kGimbalColumns : 0);
    if (cells.size() != expected) {
      fail(fmt::format("{} values", cells.size()), fmt::format("{} values", expected));
    }
    return cells;
  }

  double angle(std::string_view text, double min, double max) const {
    const double value = number(text);
    if (value < min || value > max) {
      fail(fmt::format("{:g} degrees", value), fmt::format("{:g} to {:g} degrees", min, max));
    }
    return value;
  }

  double number(std::string_view text) const {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
      fail(fmt::format("\"{:.40}\"", text), "a number");
    }
    return value;
  }

  const std::string& source_;
  int line_ = 0;
  bool has_gimbal_ = false;  ///< the log has columns for it
  std::vector<PilotSample> samples_;
};

}  // namespace

std::string pilot_log_csv(const std::vector<PilotSample>& samples) {
  const bool has_gimbal = has_gimbal_setpoints(samples);
  std::string csv = (has_gimbal ? gimbal_header() : std::string(kPilotLogHeader)) + "\n";
  for (const PilotSample& sample : samples) {
    fmt::format_to(std::back_inserter(csv), "{:.10g},{:.6f},{:.6f},{:.6f},{:.6f},{}", sample.time_s,
                   sample.position.x(), sample.position.y(), sample.position.z(),
                   sample.yaw_rad / kDegree, sample.beacon ? 1 : 0);
    if (sample.gimbal) {
      fmt::format_to(std::back_inserter(csv), ",{:.6f},{:.6f}", sample.gimbal->pitch_deg,
                     sample.gimbal->yaw_deg);
    } else if (has_gimbal) {
      csv += ",,";
    }
    csv += '\n';
  }
  return csv;
}

std::vector<PilotSample> parse_pilot_log(std::string_view csv, const std::string& source) {
  LogReader reader(source);
  while (!csv.empty()) {
    const std::size_t end = csv.find('\n');
    reader.read_line(csv.substr(0, end));
    csv.remove_prefix(end == std::string_view::npos ? csv.size() : end + 1);
  }
  return reader.take();
}

}  // namespace throng::sim
