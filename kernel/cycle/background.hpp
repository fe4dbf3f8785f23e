// Background: the work of a board without an operating system between two cycles, in pieces that
// end before the next cycle begins. The kernel reads no clock; the board's loop passes the time in:
//
//   executive.cycle({now_ns});
//   while (background.run(clock_ns(), executive.next_ns())) {
//   }
//   wait for the timer
#pragma once

#include <cstdint>

namespace tactus {

struct Background {
  /// Does one piece; false if there is nothing to do.
  using Piece = bool (*)(void* context);

  std::int64_t budget_us = 0;  ///< the longest a piece takes
  Piece piece = nullptr;
  void* context = nullptr;

  /// Runs one piece if it ends before the next cycle. False if it might not, or if there is nothing
  /// to do. [any, between cycles]
  bool run(std::int64_t now_ns, std::int64_t next_ns) const {
    return next_ns - now_ns >= 1000 * budget_us && piece(context);
  }
};

}  // namespace tactus
