// Feedback: what a reference generator tells its client every so many cycles: where the robot
// should be, where it is measured to be and the error, all of the same cycle.
#pragma once

#include <cstdint>

#include "kernel/mailbox.hpp"
#include "kernel/reference/interpolation.hpp"

namespace tactus {

template <class Space>
struct Feedback {
  double time_s = 0.0;     ///< of the generator: cycles since its start, times the period
  std::uint32_t id = 0;    ///< of the trajectory being executed; 0: none
  std::uint32_t lost = 0;  ///< messages since the one before for which there was no room
  typename Space::Point desired;
  typename Space::Point actual;  ///< NaN where nothing is measured
  typename Space::Error error;   ///< desired - actual, NaN likewise
};

template <class Space>
using FeedbackMailbox = Mailbox<Feedback<Space>, 16>;

/// Posts when a message is due. A message that finds the mailbox full is lost and
/// counted; the cycle never waits for a client.
template <class Space>
class FeedbackPublisher {
 public:
  using Point = typename Space::Point;

  /// From now on a message every `divisor` cycles, none if 0; beside the position the
  /// `measured` fields are measured. What was lost before is still told. [init]
  void start(int divisor, Fields measured);
  /// One cycle, numbered from one at start, with its time, its reference and what was measured in
  /// it. [cyclic]
  void step(std::int64_t cycle, double time_s, std::uint32_t id, const Point& desired,
            const Point& measured, FeedbackMailbox<Space>& mailbox);

 private:
  int divisor_ = 0;
  Fields measured_ = 0;
  std::uint32_t lost_ = 0;
};

}  // namespace tactus
