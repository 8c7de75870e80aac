#include "base/text/prometheus.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

TEST(Prometheus, LabelsAreEscaped) {
  EXPECT_EQ(prometheus_labels({{"a", "x"}, {"b", "one\\two \"three\"\nfour"}}),
            "a=\"x\",b=\"one\\\\two \\\"three\\\"\\nfour\"");
  EXPECT_EQ(prometheus_labels({}), "");
}

TEST(Prometheus, CountersAddAndHistogramsCountWhatIsAtMostABound) {
  PrometheusMeter counter("c_total", "Things.");
  EXPECT_EQ(counter.text(), "");
  counter.add("k=\"1\"");
  counter.add("k=\"1\"", 2);
  EXPECT_EQ(counter.text(), "# HELP c_total Things.\n# TYPE c_total counter\nc_total{k=\"1\"} 3\n");

  PrometheusMeter histogram("h", "Times.", {0.5, 2});
  for (const double value : {0.25, 0.5, 1.0, 4.0}) histogram.add("", value);
  EXPECT_EQ(histogram.text(),
            "# HELP h Times.\n# TYPE h histogram\nh_bucket{le=\"0.5\"} 2\nh_bucket{le=\"2\"} 3\n"
            "h_bucket{le=\"+Inf\"} 4\nh_sum 5.75\nh_count 4\n");
}

}  // namespace
}  // namespace throng
