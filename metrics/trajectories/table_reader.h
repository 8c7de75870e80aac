// Tables and lines of text with a person, a frame or time, and a place each.
#pragma once

#include <string>
#include <string_view>

#include "metrics/trajectories/recorded.h"
#include "spec/metrics/trajectory_format.h"

namespace throng::metrics {

/// Reads a table or text in UTF-8; `name` names it in messages.
/// - Comments (# or *) may state frame rate and unit and name the columns. Units that they or the
///   names state (unit_words.h, comment_units.h) are used, those of x and y separately, or refused.
/// - The first other line names the columns if it has no number; default names in `format` also
///   match synonyms ("ped_id", "Pos_X [cm]"), and a column of times replaces a missing one of
///   frames. A line of units may follow, as Pathfinder writes it. Without names, columns are
///   person, frame, x, y, or frame, person, x, y, which the numbers tell (order_of_columns()), or
///   those that `format` gives by numbers.
/// - The separator is the one of comma, semicolon and tab that the first line has most of, or else
///   the space; fields may be in double quotes. Decimals have a point or, throughout, a comma.
/// - Ids of persons are arbitrary words. Rows without a place are left out.
/// - Times are seconds, also as clock times or Unix times, which are counted from the first.
///   They are put on frames (put_on_frames() in timed_tracks.h) at the frame rate as stated in the
///   file, or else at the one that the times have; people are absent in gaps of more than 1 s,
///   except in Vadere's files, which have footsteps.
/// Throws InputError.
Recorded read_table(std::string_view text, const std::string& name, const TrajectoryFormat& format);

}  // namespace throng::metrics
