// StopExpectation: the pair of [expect] collision_stop. The run is to end because the collision
// check stops the arm before these two meet, and with the arm at rest.
#pragma once

#include <string_view>

#include "kernel/core/load_error.hpp"
#include "kernel/guard/collision.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

class StopExpectation {
 public:
  /// Takes a pair as [collision] allow has it; empty: nothing is stated. False: the check knows no
  /// such pair; prints "path: [expect] collision_stop: reason" to stderr. [init]
  bool start(std::string_view pair, const Pipeline& pipeline, const char* path);
  /// Takes how the run ended: the Status that stopped the arm, kOk if none did; the pair of a
  /// contact; and whether the arm rests. [any]
  void take(Status fault, const Collision::Telemetry& contact, bool at_rest);

  bool stated() const { return !first_.empty(); }
  bool met() const { return !stated() || met_; }
  /// The end that was seen, and the one that is stated, for people.
  const Message& seen() const { return seen_; }
  Message expected() const { return Message("a stop ") << before(first_, second_); }
  /// The two names, as they are stated.
  Message pair() const { return Message("") << first_ << " " << second_; }

 private:
  static Message before(std::string_view first, std::string_view second) {
    return Message("before ") << first << " and " << second << " meet";
  }

  Name first_, second_;
  Message seen_;
  bool met_ = false;
};

}  // namespace tactus
