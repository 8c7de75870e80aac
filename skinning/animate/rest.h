// Plans the motion of people who do not walk.
#pragma once

#include <vector>

#include "base/compute/random.h"
#include "skinning/animate/motion.h"
#include "skinning/animate/trajectory.h"

namespace throng::skinning {

struct Piece;

/// Properties of a person who rests.
struct Rester {
  double age_years = 35;
  bool has_free_hands = true;  ///< both
  double phase_offset = 0;     ///< in [0, 1): how far people who stand at first are in what they do
};

/// Appends pieces of motion for stretches of standing and lying.
class RestLayer {
 public:
  /// The references must outlive this object.
  RestLayer(const Trajectory& trajectory, const ClipSet& clips, const Rester& person, Random random,
            std::vector<Piece>& pieces);

  /// Plans standing: swaying, shifting the weight, looking around, at a phone or at the sky, acts
  /// (acts.h), and turning with the body.
  void stand(const Stretch& stretch, bool first, bool last);
  /// Plans falling (unless lying from the first step on), lying, and getting up (unless `last`).
  void lie(const Stretch& stretch, bool first, bool last);

 private:
  double steps(double seconds) const { return seconds / trajectory_.dt_s(); }
  std::size_t moment_at(double step) const;
  void add(const Clip& clip, double begin, double end, double frame, double to_frame);
  void shift_weight(const Clip& from, const Clip& to, double begin, double end);
  void stand_at_ease(double begin, double end);
  void look_about_ready(const Clip& clip, double begin, double end);
  /// Looks about in the frames from `middle - reach` to `middle + reach`.
  void look_about(const Clip& clip, double middle, double reach, double begin, double end);
  /// An act that suits the person there; null for none.
  const Act* choose_act(Setting setting);
  void do_act(const Act& act, const Clip& clip, double begin, double end);
  void idle(double begin, double end);
  double idle_once(double begin, double end);
  void hold(const Clip& clip, double begin, double end, double raising_s);
  void turn(std::size_t begin, std::size_t end);
  double gaze_begins(double from, double to) const;
  double gaze_ends(double from, double to) const;

  const Trajectory& trajectory_;
  const ClipSet& clips_;
  Rester person_;
  Random random_;
  bool phones_;
  double calm_;  ///< relative time between two movements
  std::vector<Piece>& pieces_;
};

}  // namespace throng::skinning
