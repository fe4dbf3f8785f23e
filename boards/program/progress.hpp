// Progress: one line that rewrites itself, a few times a second, when somebody looks.
#pragma once

#include <string_view>

namespace tactus {

/// A free-running time, s.
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
