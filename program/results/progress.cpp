#include "program/results/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace tactus {

double wall_s() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

Progress::Progress(std::string_view pipeline, double duration_s)
    : pipeline_(pipeline), duration_s_(duration_s), shown_(isatty(STDERR_FILENO) != 0) {}

void Progress::update(double time_s) {
  if (!shown_ || wall_s() < next_) return;
  next_ = wall_s() + 0.1;
  std::fprintf(stderr, "\r%.*s: %3.0f %%", static_cast<int>(pipeline_.size()), pipeline_.data(),
               std::min(100.0, 100.0 * time_s / duration_s_));
}

void Progress::end() const {
  if (shown_) std::fprintf(stderr, "\r%*s\r", 60, "");
}

}  // namespace tactus
