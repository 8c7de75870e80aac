// Doors that close for everybody, and who sees it when.
#pragma once

#include <memory>

#include "crowd/state/behavior.h"

namespace throng::crowd {

AttributeTable closing_door_attributes();

/// Creates the process of a <ClosingDoor>: a line, and obstacles of a class of its own, which
/// nobody avoids before. From its time on nobody crosses the line in either direction and everybody
/// avoids the class, while only those plan around it who have seen it: the line is within their
/// sight distance and nothing solid is between. They choose another goal of the set if theirs lies
/// in the obstacle; if all do, they wait before the nearest. People who have just passed the line
/// walk on out of the obstacle. With the time 0 everybody avoids the class by its profile and knows
/// of it from the start. Throws InputError.
std::unique_ptr<Process> make_closing_door(const Element& element, const BehaviorContext& context);

}  // namespace throng::crowd
