// Answers: whether a client has sent a set-point for every packet that it was sent, so that the
// next cycle may begin without waiting for the wall clock.
//
// A client that is ahead, because it did not wait for a packet that was late, stays so by as many:
// what it has sent counts for the packets to come. One that lets a packet pass is not asked for it
// again.
#pragma once

#include <algorithm>

namespace tactus::ur {

class Answers {
 public:
  /// The client is sent a packet. [cyclic]
  void packet() {
    if (owed_ > 0) in_a_row_ = 0;
    owed_ = std::min(owed_, 0) + 1;
  }
  /// It has sent a set-point. [any]
  void answer() {
    owed_ = std::max(owed_ - 1, -kMostAhead);
    in_a_row_ = std::min(in_a_row_ + 1, kSteady);
  }
  bool missing() const { return owed_ > 0; }
  /// It has answered so many in a row that it will go on: worth waiting for.
  bool steady() const { return in_a_row_ == kSteady; }

 private:
  static constexpr int kMostAhead = 8, kSteady = 25;
  int owed_ = 0;      // packets without an answer; negative: answers ahead
  int in_a_row_ = 0;  // answers since the last packet that had none
};

}  // namespace tactus::ur
