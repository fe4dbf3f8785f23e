// ReferenceClock: judges the time of the segment that comes back with every frame. Feedback whose
// time does not go on is that of an old frame, whoever sends it again, and is not to be followed.
#pragma once

#include <cstdint>

namespace tactus::ethercat {

/// Returns the time from one reading of a clock to a later one, ns. The time of a segment may be
/// any number. [any]
constexpr std::int64_t passed_between(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(to_ns) -
                                   static_cast<std::uint64_t>(from_ns));
}

class ReferenceClock {
 public:
  enum class Verdict : std::uint8_t {
    kRuns,
    kStands,
    kJumps,  ///< backwards, or ahead by more than the time in which it was read
  };

  /// Begins; the next time is taken as it is. Clocks of 32 bits wrap after 4.3 s. A time may be
  /// ahead by `slack_ns` of what the computer's clock says. [init]
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
  /// The last time that was good, ns; a clock of 32 bits goes on beyond them. [any]
  std::int64_t time_ns() const { return time_ns_; }

 private:
  bool has_64_bits_ = true, known_ = false;
  Verdict verdict_ = Verdict::kRuns;
  std::int64_t slack_ns_ = 0, time_ns_ = 0;
  std::int64_t since_ns_ = 0;  // of the computer, before that time was read
};

}  // namespace tactus::ethercat
