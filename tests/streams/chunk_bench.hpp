// ChunkBench: a generator that is sent chunks of a sine along one axis of its space.
#pragma once

#include "tests/reference/motion/motion_bench.hpp"

namespace tactus {

/// The point at which the axis has moved by x, rad or m; and how far a point has moved, and how
/// fast.
inline JointSpace::Point moved_by(JointSpace::Point home, double x) {
  home.q[0] += x;
  return home;
}
inline TaskSpace::Point moved_by(TaskSpace::Point home, double x) {
  home.x.p[1] += x;
  home.x.r = home.x.r * exp_so3({0.0, 0.4 * x, 0.0});
  return home;
}
inline double way(const JointSpace::Point& now, const JointSpace::Point& home) {
  return now.q[0] - home.q[0];
}
inline double way(const TaskSpace::Point& now, const TaskSpace::Point& home) {
  return now.x.p[1] - home.x.p[1];
}
inline double speed(const JointSpace::Point& now) {
  return now.dq[0];
}
inline double speed(const TaskSpace::Point& now) {
  return now.v[1];
}
inline double pull(const JointSpace::Point& now) {
  return now.ddq[0];
}
inline double pull(const TaskSpace::Point& now) {
  return now.a[1];
}

template <class Space>
struct ChunkBench : MotionBench<Space> {
  static constexpr double kTwoPi = 6.283185307179586;
  Chunk<Space>& chunk = storage();
  Report last;
  std::uint32_t starved_id = 0;
  int starved = 0, reports = 0;

  explicit ChunkBench(double period = 1e-3) : MotionBench<Space>(period) {
    chunk = {};
    chunk.smoothing_s = 0.0;
  }
  /// The signal of the benchmark.
  static double signal(double t) {
    return 0.5 * std::sin(kTwoPi * 0.25 * t) + 0.15 * std::sin(kTwoPi * 0.7 * t) +
           0.04 * std::sin(kTwoPi * 1.5 * t);
  }
  static double signal_speed(double t) {
    return kTwoPi * (0.125 * std::cos(kTwoPi * 0.25 * t) + 0.105 * std::cos(kTwoPi * 0.7 * t) +
                     0.06 * std::cos(kTwoPi * 1.5 * t));
  }
  double now_s() const { return this->generator.time_s(); }
  /// Sends the targets x(t) at `count` stamps from `first_s` on as the next chunk; 0: refused.
  template <class Signal>
  std::uint32_t send_targets(double first_s, double spacing_s, int count, Signal x) {
    chunk.count = 0;
    ++chunk.sequence;
    for (int i = 0; i < count; ++i) {
      const double t = first_s + i * spacing_s;
      chunk.add(t, moved_by(this->home, x(t)));
    }
    return send_again();
  }
  std::uint32_t send_again() {
    std::uint32_t id = 0;
    verdict = this->client.send(chunk, id);
    return verdict.ok() ? id : 0;
  }
  void cycle() {
    static_cast<void>(this->step());
    Report report;
    while (this->client.poll(report)) {
      ++reports;
      if (report.outcome == Outcome::kStarved) {
        ++starved;
        starved_id = report.id;
      } else {
        last = report;
      }
    }
  }
  void run(double time_s) {
    for (int k = this->cycles(time_s); k > 0; --k) cycle();
  }
  double way_now() const { return way(this->out(), this->home); }

  Verdict verdict;

 private:
  static Chunk<Space>& storage() {
    static Chunk<Space> chunk;
    return chunk;
  }
};

}  // namespace tactus
