#include "formats/recording/run_topics.h"

namespace throng::formats::ros {

void ClockTopic::advance(double time_s) {
  if (time_s <= last_s_) return;
  last_s_ = time_s;
  sink_({"/clock", Kind::clock, time_s, clock(time_s)});
}

void publish_boxes(const MessageSink& sink, const std::string& root, double time_s,
                   const std::vector<Box3>& boxes) {
  const Header world{kWorldFrame, time_s};
  sink({root + "/ground_truth/boxes", Kind::markers, time_s, markers(world, boxes)});
  sink({root + "/ground_truth/detections_3d", Kind::detections_3d, time_s,
        detections_3d(world, boxes)});
}

}  // namespace throng::formats::ros
