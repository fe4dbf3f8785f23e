// Progress: one line on stderr that is rewritten ten times a second, if stderr is a terminal.
#pragma once

#include <string_view>

namespace tactus {

/// Returns the time of a free-running clock, s.
double wall_s();

class Progress {
 public:
  Progress(std::string_view pipeline, double duration_s);
  void update(double time_s);
  void end() const;

 private:
  std::string_view pipeline_;
  double duration_s_;
  bool shown_;
  double next_ = 0.0;
};

}  // namespace tactus
