// ToleranceMonitor: does the robot follow, and has it arrived? Compares what was put out some
// cycles ago, by the robot's known latency, with what is measured now. A comparison with NaN
// violates.
#pragma once

#include <array>
#include <cstddef>

#include "kernel/reference/messages.hpp"

namespace tactus {

inline constexpr int kMaxLatencyCycles = 16;

template <class Space>
class ToleranceMonitor {
 public:
  using Point = typename Space::Point;

  /// Nothing was put out before `reference`. Where no velocity is measured the robot has stopped
  /// once its position has been as near to one place for kWindow_s as the limit lets it get in that
  /// time. [init]
  void start(const Point& reference, int latency_cycles, bool measures_velocity);
  /// A goal begins, with the tolerances that hold for it. [cyclic]
  void begin(const Tolerances<Space>& tolerances);
  /// The reference of this cycle. [cyclic]
  void put_out(const Point& reference);

  /// On the way: kPathTolerance with axis, value and limit, or kOk. [cyclic]
  Verdict follows(const Point& measured) const;

  enum class Arrival { kWaiting, kArrived, kLate };
  /// After the end: in the goal band and stopped for the dwell time; late once the goal time has
  /// passed. `why` names what was still outside. [cyclic]
  Arrival arrived(const Point& measured, double dt_s, Verdict& why);

 private:
  static constexpr double kWindow_s = 0.04;

  const Point& expected() const;
  Verdict stopped(const Point& measured, double dt_s);

  Tolerances<Space> tolerances_;
  std::array<Point, kMaxLatencyCycles + 1> line_;
  std::size_t newest_ = 0, latency_ = 0;
  double waiting_s_ = 0.0, inside_s_ = 0.0;

  bool measures_velocity_ = true;
  Point window_from_;                      // measured at the beginning of the window
  double window_s_ = 0.0;                  // since then; 0: there is none yet
  Verdict found_{Status::kGoalTolerance};  // by the last window
};

}  // namespace tactus
