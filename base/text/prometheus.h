// Metrics in the text format of Prometheus, version 0.0.4.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace throng {

/// Labels of a metric between braces, escaped: `kind="trace",outcome="failed"`.
std::string prometheus_labels(
    std::initializer_list<std::pair<std::string_view, std::string_view>> labels);

/// The lines before a metric's values. `type` is "counter", "gauge" or "histogram".
std::string prometheus_head(std::string_view name, std::string_view type, std::string_view help);

/// One value; `labels` as from prometheus_labels(), or "".
std::string prometheus_line(std::string_view name, std::string_view labels, double value);

/// A counter or a histogram with a series for each combination of labels. Safe to use from many
/// threads.
class PrometheusMeter {
 public:
  /// A histogram with these upper bounds of its buckets, in rising order; without, a counter.
  PrometheusMeter(std::string name, std::string help, std::vector<double> bounds = {});

  /// Observes a value of the histogram, or adds it to the counter.
  void add(const std::string& labels, double value = 1);
  /// All series; "" if there are none.
  std::string text() const;

 private:
  struct Series {
    double sum = 0;
    std::int64_t count = 0;
    std::vector<std::int64_t> at_most = {};  ///< numbers of values at most as large as the bounds
  };

  std::string histogram_text(const std::string& labels, const Series& series) const;

  std::string name_;
  std::string help_;
  std::vector<double> bounds_;
  mutable std::mutex mutex_;
  std::map<std::string, Series> series_;  ///< by labels; guarded by mutex_
};

}  // namespace throng
