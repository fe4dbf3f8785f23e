// Watchdogs: the watchdogs of rtde_set_watchdog. An input that is not written at `min_frequency` is
// late. The action is then
//
//   ignore   none
//   pause    the program pauses and the clients receive C207; it may be resumed
//   stop     a protective stop, C207, which ends the program
//
// Watchdogs end with the program. A frequency that is not positive switches a watchdog off.
#pragma once

#include "sim_plant/ur/wire/io.hpp"

namespace tactus::ur {

enum class LateAction : std::uint8_t { kIgnore, kPause, kStop };

class Watchdogs {
 public:
  /// Sets a watchdog from `cycle` on, and replaces one of the same input. [any]
  void set(const InputField& field, double min_frequency, LateAction action, std::int64_t cycle);
  void clear() { count_ = 0; }

  /// Returns the gravest action of all late inputs, or kIgnore. A pause is returned once, until the
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
