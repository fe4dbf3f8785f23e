// ToleranceMonitor: judges whether the robot follows its reference and has arrived at the goal. It
// compares the reference of some cycles ago, the known latency of the robot, with the point
// measured now. A comparison with NaN counts as a violation.
#pragma once

#include <array>
#include <cstddef>

#include "kernel/core/verdict.hpp"
#include "kernel/reference/motion/trajectory.hpp"

namespace tactus {

inline constexpr int kMaxLatencyCycles = 16;

template <class Space>
class ToleranceMonitor {
 public:
  using Point = typename Space::Point;

  /// Starts with `reference` as the reference of all cycles before. If no velocity is measured, the
  /// robot counts as stopped once its position has moved for kWindow_s by no more than the velocity
  /// limit allows in that time. [init]
  [[gnu::cold]] void start(const Point& reference, int latency_cycles, bool measures_velocity);
  /// Begins a goal with its tolerances, or the time without one. [cyclic]
  void begin(const Tolerances<Space>& tolerances);
  /// Takes the reference of this cycle. [cyclic]
  void record(const Point& reference);
  /// Judges a cycle without a goal, after record(). Where every law holds the robot
  /// (Space::kHeldByLaw), one whose reference has stayed within kRests of the path tolerance for
  /// longer than the goal time must be within that tolerance: kPathTolerance, or kOk. [cyclic]
  Verdict holds(const Point& measured, double dt_s);

  /// Judges the path tolerance: kPathTolerance with axis, value and limit, or kOk. [cyclic]
  Verdict follows(const Point& measured) const;

  enum class Arrival { kWaiting, kArrived, kLate };
  /// Judges one cycle after the end of the path: kArrived once the robot has been in the goal band
  /// and stopped for the dwell time, kLate once the goal time has passed. `why` is the violation of
  /// this cycle. [cyclic]
  Arrival arrived(const Point& measured, double dt_s, Verdict& why);

 private:
  static constexpr double kWindow_s = 0.04;
  static constexpr double kRests = 0.25;  // a step within the band is less than the tolerance

  const Point& expected() const;
  Verdict stopped(const Point& measured, double dt_s);

  Tolerances<Space> tolerances_;
  std::array<Point, kMaxLatencyCycles + 1> line_;
  std::size_t newest_ = 0, latency_ = 0;
  double waiting_s_ = 0.0, inside_s_ = 0.0;

  bool measures_velocity_ = true;
  /// With a goal, the measured point at the beginning of the window; without, the resting
  /// reference.
  Point window_from_;
  double window_s_ = 0.0;                 // time since then
  Verdict found_{Status::kGoalVelocity};  // result of the last window
};

}  // namespace tactus
