// Answers: counts whether a client has answered every packet with a set-point, so that the next
// cycle may begin without waiting for the wall clock.
//
// If a client is ahead, because it did not wait for a late packet, its set-points count for later
// packets. A packet that it leaves unanswered is not waited for later.
#pragma once

#include <algorithm>

namespace tactus::ur {

class Answers {
 public:
  /// Counts a packet sent to the client. [cyclic]
  void packet() {
    if (owed_ > 0) in_a_row_ = 0;
    owed_ = std::min(owed_, 0) + 1;
  }
  /// Counts a set-point of the client. [any]
  void answer() {
    owed_ = std::max(owed_ - 1, -kMostAhead);
    in_a_row_ = std::min(in_a_row_ + 1, kSteady);
  }
  bool missing() const { return owed_ > 0; }
  /// True if the client has answered kSteady packets in a row, so that waiting for it makes sense.
  bool steady() const { return in_a_row_ == kSteady; }

 private:
  static constexpr int kMostAhead = 8, kSteady = 25;
  int owed_ = 0;      // packets without an answer; negative: answers ahead
  int in_a_row_ = 0;  // answers since the last packet without one
};

}  // namespace tactus::ur
