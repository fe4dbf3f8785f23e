// Time-optimal motion of one axis from any state to a target, at rest or moving, within limits of
// velocity, acceleration and jerk. A motion is a sequence of phases of constant jerk, found in a
// fixed number of operations with no function but the square root: the same bits on every machine.
//
// Units are those of the axis, m or rad, and seconds. A plan is a self-contained value; a plan made
// later from a state on it is the rest of the same motion.
//
// If an input or a limit is not finite, a limit has the wrong sign, or a motion leaves the range of
// doubles, the duration and the states of the plan are NaN.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace tactus {

struct AxisLimits {
  double v_lo, v_hi;  ///< velocities, v_lo < 0 < v_hi
  double a_dn, a_up;  ///< magnitudes of the most negative and the most positive acceleration, > 0
  double j;           ///< magnitude of the jerk, > 0
};

struct AxisState {
  double p = 0.0, v = 0.0, a = 0.0;  ///< position, velocity, acceleration
};

/// Returns the state `t` later under constant jerk. [any]
AxisState moved(const AxisState& from, double t, double jerk);

/// A sequence of phases of constant jerk, followed by motion at constant velocity.
class AxisPlan {
 public:
  struct JerkPhase {
    double duration, jerk;
  };
  static constexpr int kMostPhases = 12;  ///< most phases of a plan

  /// A plan whose duration and states are NaN.
  AxisPlan() = default;
  /// Sets the start state and the end state (p, v, 0), and removes all phases. [any]
  void start(const AxisState& from, double p, double v) {
    from_ = from;
    p_ = p;
    v_ = v;
    duration_ = 0.0;
    phases_ = return_phases_ = 0;
  }
  /// Appends a phase. One not longer than zero is ignored; one too many makes the duration NaN.
  /// [any]
  void append(double duration, double jerk) {
    if (duration <= 0.0) return;
    duration_ = phases_ < kMostPhases ? duration_ + duration : kNaN;
    if (phases_ < kMostPhases) phase_[static_cast<std::size_t>(phases_++)] = {duration, jerk};
  }
  /// Sets the end state (p, v, 0). [any]
  void end_at(double p, double v) {
    p_ = p;
    v_ = v;
  }
  /// Declares the phases appended up to now the return inside the limits, which stretch() keeps.
  /// [any]
  void end_return() { return_phases_ = phases_; }
  /// Removes the phases after the return. [any]
  void cut_to_return();

  /// Returns the state at t >= 0; from the end on exactly {p + v (t - duration), v, 0}. [cyclic]
  AxisState at(double t) const;
  double duration() const { return duration_; }

  int phases() const { return phases_; }
  int return_phases() const { return return_phases_; }
  AxisState after_return() const;
  double return_duration() const;
  const JerkPhase& phase(int i) const { return phase_[static_cast<std::size_t>(i)]; }

 private:
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  AxisState from_{kNaN, kNaN, kNaN};
  double p_ = kNaN, v_ = kNaN;  // at the end
  double duration_ = kNaN;
  int phases_ = 0, return_phases_ = 0;
  std::array<JerkPhase, kMostPhases> phase_;
};

/// Plans the shortest motion to (p, v, 0), v clipped to the limits. A state outside the limits
/// first returns by the shortest way, and goes no further out than its acceleration makes
/// unavoidable. [cyclic]
AxisPlan plan_to(const AxisState& from, double p, double v, const AxisLimits& limits);

/// Plans the shortest motion to rest at p, p clipped to [p_lo, p_hi]. Positions stay inside if the
/// direct stop from the state does, without loss of time, and also if the hardest braking does. A
/// limit that cannot be kept is exceeded by no more than by the direct stop. [cyclic]
AxisPlan plan_inside(const AxisState& from, double p, const AxisLimits& limits, double p_lo,
                     double p_hi);

/// Extends a plan from `from` to (p, v, 0) to the given duration, within the same limits. Returns
/// false and leaves the plan unchanged if there is no such motion of this form: the plan then
/// arrives early. Returns true and leaves it unchanged if it already takes as long. [cyclic]
bool stretch(AxisPlan& plan, const AxisState& from, double p, double v, const AxisLimits& limits,
             double duration);

/// Plans the direct stop: the shortest motion to rest, at any position. [cyclic]
AxisPlan plan_stop(const AxisState& from, const AxisLimits& limits);

struct AxisRange {
  double lowest, highest;
};

/// Returns the range of positions in the direct stop; NaN if an input is not finite. [cyclic]
AxisRange stop_range(const AxisState& from, const AxisLimits& limits);

}  // namespace tactus
