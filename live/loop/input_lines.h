// Lines that another process sends, without waiting for them longer than for a stop.
#pragma once

#include <functional>
#include <stop_token>
#include <string>

namespace throng::live {

/// Reads from a descriptor and hands on each line without its line break, until its end or a stop.
/// Throws EnvironmentError if it cannot be read.
void read_lines(int input, const std::stop_token& stop,
                const std::function<void(const std::string& line)>& take);

}  // namespace throng::live
