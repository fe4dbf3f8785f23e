// Watchdogs: what rtde_set_watchdog asks for. An input that is not written at `min_frequency` is
// late; every write is a kick. Then
//
//   ignore   nothing
//   pause    the program pauses and the clients are told C207; it may be played on
//   stop     a protective stop, C207, which ends the program
//
// They end with the program. A frequency that is not positive asks for nothing.
#pragma once

#include "sim_plant/ur/io.hpp"

namespace tactus::ur {

enum class LateAction : std::uint8_t { kIgnore, kPause, kStop };

class Watchdogs {
 public:
  /// From `cycle` on; a watchdog of the same input is replaced. [any]
  void set(const InputField& field, double min_frequency, LateAction action, std::int64_t cycle);
  void clear() { count_ = 0; }

  /// The gravest of what has become late; kIgnore: nothing. A pause is asked for once, until the
  /// input is written again. [cyclic]
  LateAction check(const Io& io, std::int64_t cycle, double cycle_s);

 private:
  struct Watch {
    std::size_t variable = 0;
    double longest_s = 0.0;
    LateAction action = LateAction::kIgnore;
    std::int64_t from = 0;
    bool told = false;
  };
  std::array<Watch, 8> watches_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::ur
