// The clock of the segment in the cycle: the reference time that every frame returns is
// checked, steers the moments at which frames are sent, and is compared with SYNC0.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tactus::ethercat {

/// Returns the time from one reading of a clock to a later one, ns. The time of a segment may be
/// any number. [any]
constexpr std::int64_t passed_between(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(to_ns) -
                                   static_cast<std::uint64_t>(from_ns));
}

/// Judges the reference time that every frame returns. Feedback whose time does not advance belongs
/// to an old frame, whoever repeats it, and must not be followed.
class ReferenceClock {
 public:
  enum class Verdict : std::uint8_t {
    kRuns,
    kStands,
    kJumps,  ///< backwards, or ahead by more than the time in which it was read
  };

  /// Begins; the next time is taken as it is. Clocks of 32 bits wrap after 4.3 s. A time may be
  /// ahead of the computer's clock by `slack_ns`. [init]
  void start(bool has_64_bits, std::int64_t slack_ns) {
    has_64_bits_ = has_64_bits;
    slack_ns_ = slack_ns;
    known_ = false;
    verdict_ = Verdict::kRuns;
  }
  /// Judges the time of a frame that was sent after `sent_ns` and came before `now_ns`, ns.
  /// [cyclic]
  Verdict take(std::int64_t shown_ns, std::int64_t sent_ns, std::int64_t now_ns) {
    if (!known_) {
      known_ = true;
      time_ns_ = shown_ns;
      since_ns_ = sent_ns;
      return verdict_ = Verdict::kRuns;
    }
    const std::int64_t since_ns = passed_between(time_ns_, shown_ns);
    const std::int64_t passed_ns =
        has_64_bits_ ? since_ns : std::int64_t{static_cast<std::int32_t>(since_ns & 0xFFFFFFFF)};
    if (passed_ns == 0) return verdict_ = Verdict::kStands;
    if (passed_ns < 0 || passed_ns - (now_ns - since_ns_) > slack_ns_)
      return verdict_ = Verdict::kJumps;
    time_ns_ = static_cast<std::int64_t>(static_cast<std::uint64_t>(time_ns_) +
                                         static_cast<std::uint64_t>(passed_ns));
    since_ns_ = sent_ns;
    return verdict_ = Verdict::kRuns;
  }
  /// The last one. [any]
  Verdict verdict() const { return verdict_; }
  /// The last time that was good, ns; a clock of 32 bits continues beyond them. [any]
  std::int64_t time_ns() const { return time_ns_; }

 private:
  bool has_64_bits_ = true, known_ = false;
  Verdict verdict_ = Verdict::kRuns;
  std::int64_t slack_ns_ = 0, time_ns_ = 0;
  std::int64_t since_ns_ = 0;  // of the computer, before that time was read
};

/// Keeps the moments at which frames are sent in step with the reference clock: a phase-locked loop
/// over the reference time of the frames.
///
///   e_k = (t_k - t_0) mod T, from -T/2 to T/2      t_k: reference time of frame k; T: the period;
///                                                  t_0: reference time of the first, or given
///   correction_k = -(kp e_k + ki sum e)            added to the period until the next frame
class ClockSteer {
 public:
  static constexpr double kProportional = 0.05, kIntegral = 0.0005;
  /// Largest correction of a period, as a share of it: more than any two quartz clocks differ by.
  static constexpr double kMostShare = 0.02;

  /// Begins; the next frame gives the phase. [init]
  void start(std::int64_t period_ns) {
    period_ns_ = period_ns;
    known_ = false;
    sum_ns_ = 0.0;
    correction_ns_ = error_ns_ = 0;
  }
  /// Begins with a phase: frames are to be sent whole periods from `phase_ns`, t_0. [init]
  void start(std::int64_t period_ns, std::int64_t phase_ns) {
    start(period_ns);
    begin_ns_ = phase_ns;
    known_ = true;
  }
  /// Phase error of a frame by its reference time, ns. [cyclic]
  std::int64_t error_of(std::int64_t reference_ns) const {
    std::int64_t error = passed_between(begin_ns_, reference_ns) % period_ns_;
    if (error > period_ns_ / 2) error -= period_ns_;
    if (error < -period_ns_ / 2) error += period_ns_;
    return error;
  }
  /// Takes the reference time of a frame. [cyclic]
  void take(std::int64_t reference_ns) {
    if (!known_) begin_ns_ = reference_ns;
    known_ = true;
    const std::int64_t error = error_ns_ = error_of(reference_ns);
    const double most_ns = kMostShare * static_cast<double>(period_ns_);
    sum_ns_ = within(sum_ns_ + kIntegral * static_cast<double>(error), most_ns);
    const double whole_ns = kProportional * static_cast<double>(error) + sum_ns_;
    correction_ns_ = static_cast<std::int64_t>(-within(whole_ns, most_ns));
  }
  /// Correction of the period until the next frame, ns. [cyclic]
  std::int64_t correction() const { return correction_ns_; }
  /// The last phase error, ns. [any]
  std::int64_t error() const { return error_ns_; }

 private:
  static double within(double value, double most) {
    return value > most ? most : value < -most ? -most : value;
  }

  std::int64_t period_ns_ = 1, begin_ns_ = 0, correction_ns_ = 0, error_ns_ = 0;
  double sum_ns_ = 0.0;
  bool known_ = false;
};

/// Measures how long before SYNC0 the frames pass the first slave, by its clock, and counts the
/// SYNC0 pulses without a new frame: at such a pulse a drive follows old outputs.
class Sync0Watch {
 public:
  /// SYNC0 comes `shift_ns` after moments that are whole periods from `phase_ns`, first, of the
  /// slave that was started last, at `first_ns`. [init]
  void start(std::int64_t period_ns, std::int64_t phase_ns, std::int64_t shift_ns,
             std::int64_t first_ns) {
    *this = {};
    period_ns_ = period_ns;
    phase_ns_ = phase_ns;
    shift_ns_ = shift_ns;
    first_ns_ = first_ns;
  }
  /// A frame was sent, whether it returns or not. [cyclic]
  void count_frame() { ++frames_; }
  /// Takes the reference time at which the last frame passed. [cyclic]
  void take(std::int64_t reference_ns) {
    if (passed_between(first_ns_, reference_ns) < 0) return;
    const std::int64_t since = passed_between(phase_ns_, reference_ns) - shift_ns_;
    const std::int64_t rest = since % period_ns_;
    const std::int64_t passed_ns = rest < 0 ? rest + period_ns_ : rest;  // since the last pulse
    const std::int64_t pulse = (since - passed_ns) / period_ns_;
    least_ns_ = std::min(least_ns_, period_ns_ - passed_ns);
    most_ns_ = std::max(most_ns_, period_ns_ - passed_ns);
    if (known_) without_frame_ += std::max(pulse - pulse_ - frames_, std::int64_t{0});
    known_ = true;
    pulse_ = pulse;
    frames_ = 0;
  }
  /// True if the times below are known. [any]
  bool known() const { return known_; }
  /// Least and largest time from a frame to the next SYNC0, ns. [any]
  std::int64_t least_ns() const { return least_ns_; }
  std::int64_t most_ns() const { return most_ns_; }
  /// Pulses before which no new frame had passed since the one before. [any]
  std::int64_t without_frame() const { return without_frame_; }

 private:
  std::int64_t period_ns_ = 1, phase_ns_ = 0, shift_ns_ = 0, first_ns_ = 0;
  std::int64_t least_ns_ = INT64_MAX, most_ns_ = 0;
  std::int64_t pulse_ = 0, frames_ = 0;  // the last pulse before a frame, and frames since that one
  std::int64_t without_frame_ = 0;
  bool known_ = false;
};

}  // namespace tactus::ethercat
