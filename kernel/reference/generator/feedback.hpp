// Feedback: the desired point, the measured point and the error of one cycle, which a reference
// generator sends its client every few cycles.
#pragma once

#include <cstdint>

#include "kernel/core/mailbox.hpp"
#include "kernel/core/streams.hpp"
#include "kernel/reference/motion/path_progress.hpp"
#include "kernel/reference/space/interpolation.hpp"

namespace tactus {

template <class Space>
struct Feedback : OnlyWithStreams<PathProgress> {
  double time_s = 0.0;     ///< generator time: cycles since its start, times the period
  std::uint32_t id = 0;    ///< trajectory being executed; 0: none
  std::uint32_t lost = 0;  ///< messages lost since the previous one because the mailbox was full
  typename Space::Point desired;
  typename Space::Point actual;  ///< NaN where nothing is measured
  typename Space::Error error;   ///< desired - actual; NaN where nothing is measured
};

template <class Space>
using FeedbackQueue = MessageQueue<Feedback<Space>>;

/// Posts a message when one is due. If the mailbox is full, the message is lost and counted; the
/// cycle never waits for a client.
template <class Space>
class FeedbackPublisher : OnlyWithStreams<PathProgress> {
 public:
  using Point = typename Space::Point;
  using Progress = OnlyWithStreams<PathProgress>;

  /// Posts a message every `divisor` cycles from now on, none if 0. `measured` are the fields that
  /// are measured besides the position. Messages lost before are still reported. [init]
  void start(int divisor, Fields measured);
  /// Sets the progress for the next messages. [cyclic]
  void set(const Progress& progress) { static_cast<Progress&>(*this) = progress; }
  /// Takes one cycle, numbered from 1 at start: its time, its reference, and the point measured in
  /// it. [cyclic]
  void step(std::int64_t cycle, double time_s, std::uint32_t id, const Point& desired,
            const Point& measured, FeedbackQueue<Space>& queue);

 private:
  int divisor_ = 0;
  Fields measured_ = 0;
  std::uint32_t lost_ = 0;
};

}  // namespace tactus
