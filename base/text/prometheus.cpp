#include "base/text/prometheus.h"

#include <fmt/core.h>

namespace throng {

std::string prometheus_labels(
    std::initializer_list<std::pair<std::string_view, std::string_view>> labels) {
  std::string text;
  for (const auto& [name, value] : labels) {
    text += fmt::format("{}{}=\"", text.empty() ? "" : ",", name);
    for (const char c : value) {
      if (c == '\n') {
        text += "\\n";
      } else {
        if (c == '\\' || c == '"') text += '\\';
        text += c;
      }
    }
    text += '"';
  }
  return text;
}

std::string prometheus_head(std::string_view name, std::string_view type, std::string_view help) {
  return fmt::format("# HELP {0} {1}\n# TYPE {0} {2}\n", name, help, type);
}

std::string prometheus_line(std::string_view name, std::string_view labels, double value) {
  return labels.empty() ? fmt::format("{} {}\n", name, value)
                        : fmt::format("{}{{{}}} {}\n", name, labels, value);
}

PrometheusMeter::PrometheusMeter(std::string name, std::string help, std::vector<double> bounds)
    : name_(std::move(name)), help_(std::move(help)), bounds_(std::move(bounds)) {}

void PrometheusMeter::add(const std::string& labels, double value) {
  const std::lock_guard lock(mutex_);
  Series& series = series_[labels];
  series.sum += value;
  ++series.count;
  series.at_most.resize(bounds_.size());
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    if (value <= bounds_[i]) ++series.at_most[i];
  }
}

std::string PrometheusMeter::histogram_text(const std::string& labels, const Series& series) const {
  const std::string comma = labels.empty() ? "" : ",";
  std::string text;
  const auto add_bucket = [&](const std::string& bound, std::int64_t count) {
    text += fmt::format("{}_bucket{{{}{}le=\"{}\"}} {}\n", name_, labels, comma, bound, count);
  };
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    add_bucket(fmt::format("{}", bounds_[i]), series.at_most[i]);
  }
  add_bucket("+Inf", series.count);
  return text + prometheus_line(name_ + "_sum", labels, series.sum) +
         prometheus_line(name_ + "_count", labels, static_cast<double>(series.count));
}

std::string PrometheusMeter::text() const {
  const std::lock_guard lock(mutex_);
  if (series_.empty()) return "";
  std::string text = prometheus_head(name_, bounds_.empty() ? "counter" : "histogram", help_);
  for (const auto& [labels, series] : series_) {
    text += bounds_.empty() ? prometheus_line(name_, labels, series.sum)
                            : histogram_text(labels, series);
  }
  return text;
}

}  // namespace throng
