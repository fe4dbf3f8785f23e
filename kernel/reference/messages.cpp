#include "kernel/reference/messages.hpp"

namespace tactus {

const char* name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kScheduled:
      return "scheduled";
    case Outcome::kStarted:
      return "started";
    case Outcome::kSucceeded:
      return "succeeded";
    case Outcome::kPreempted:
      return "preempted";
    case Outcome::kAborted:
      return "aborted";
    case Outcome::kCanceled:
      return "canceled";
    case Outcome::kExecuted:
      return "executed";
    case Outcome::kSuperseded:
      return "superseded";
    case Outcome::kRefused:
      return "refused";
    case Outcome::kStarved:
      return "starved";
    case Outcome::kReleased:
      return "released";
  }
  return "unknown";
}

}  // namespace tactus
