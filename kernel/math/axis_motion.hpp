// Motion of one axis from any state to a target, at rest or moving, within limits of velocity,
// acceleration and jerk, in the least time: phases of constant jerk, found in a fixed number of
// operations with no function but the square root, the same bits on every machine.
//
// Units are the axis' own, m or rad, and seconds. A plan is a value: it holds all it needs, and who
// plans again from a state on it gets the rest of the same motion.
//
// Limits and inputs that are not finite, limits that are not positive, and motions whose figures
// leave the range of doubles give a plan whose duration and states are NaN.
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

/// The state `t` later with constant jerk. [any]
AxisState moved(const AxisState& from, double t, double jerk);

/// Phases of constant jerk, one after the other, then on at constant velocity.
class AxisPlan {
 public:
  struct Phase {
    double duration, jerk;
  };
  static constexpr int kPhases = 12;  ///< most that a plan has

  /// Its duration and states are NaN.
  AxisPlan() = default;
  /// From `from` to (p, v, 0), without phases. [any]
  void start(const AxisState& from, double p, double v) {
    from_ = from, p_ = p, v_ = v;
    duration_ = 0.0, phases_ = lead_ = 0;
  }
  /// Adds a phase; one not longer than zero is left out, one too many makes the duration NaN. [any]
  void append(double duration, double jerk) {
    if (duration <= 0.0) return;
    duration_ = phases_ < kPhases ? duration_ + duration : kNaN;
    if (phases_ < kPhases) phase_[static_cast<std::size_t>(phases_++)] = {duration, jerk};
  }
  /// Where it ends. [any]
  void end_at(double p, double v) { p_ = p, v_ = v; }
  /// What is appended so far leads back inside limits; stretching keeps it as it is. [any]
  void end_lead() { lead_ = phases_; }
  /// Takes off all that is appended behind the lead. [any]
  void cut_to_lead();

  /// The state at t >= 0; from the end on exactly {p + v (t - duration), v, 0}. [cyclic]
  AxisState at(double t) const;
  double duration() const { return duration_; }

  int phases() const { return phases_; }
  int lead() const { return lead_; }
  AxisState after_lead() const;
  double lead_duration() const;
  const Phase& phase(int i) const { return phase_[static_cast<std::size_t>(i)]; }

 private:
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  AxisState from_{kNaN, kNaN, kNaN};
  double p_ = kNaN, v_ = kNaN;  // at the end
  double duration_ = kNaN;
  int phases_ = 0, lead_ = 0;
  std::array<Phase, kPhases> phase_;
};

/// The shortest motion to (p, v, 0), v clipped into the limits. A state outside the limits comes
/// back by the shortest way first, and never goes further out. [cyclic]
AxisPlan plan_to(const AxisState& from, double p, double v, const AxisLimits& limits);

/// The shortest motion to rest at p, clipped into [p_lo, p_hi]. Positions stay inside if the direct
/// stop from the state does, at no loss of time, and if braking with all there is does. What cannot
/// be kept is exceeded by no more than the direct stop would. [cyclic]
AxisPlan plan_inside(const AxisState& from, double p, const AxisLimits& limits, double p_lo,
                     double p_hi);

/// Makes of a plan to (p, v, 0) from `from` one of the duration given, within the same limits.
/// False and the plan unchanged where there is none of this form: it then arrives early. True and
/// unchanged if it takes as long already. [cyclic]
bool stretch(AxisPlan& plan, const AxisState& from, double p, double v, const AxisLimits& limits,
             double duration);

/// The direct stop: the shortest motion to rest, wherever that is. [cyclic]
AxisPlan plan_stop(const AxisState& from, const AxisLimits& limits);

struct AxisRange {
  double lowest, highest;
};

/// The positions that the direct stop passes; NaN for what is not finite. [cyclic]
AxisRange stop_range(const AxisState& from, const AxisLimits& limits);

}  // namespace tactus
