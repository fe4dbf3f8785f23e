// FetchProgram: the first part of external_control.urp. It fetches the text of the script from a
// server on the control computer; the script then replaces it.
#pragma once

#include "sim_plant/ur/parts/machine.hpp"
#include "sim_plant/ur/programs/program_step.hpp"

namespace tactus::ur {

class FetchProgram {
 public:
  ProgramStep poll(Machine& machine) {
    Link* link = machine.links.find(kSocket);
    if (link == nullptr) return ProgramStep::kEnded;
    if (link->state() == Link::State::kClosed) {
      link->want(kSocket, machine.settings.external_control_host,
                 machine.settings.external_control_port);
    } else if (link->state() == Link::State::kFailed) {
      return ProgramStep::kEnded;
    } else if (link->open() && !asked_) {
      link->send_text("request_program\n");
      asked_ = true;
    }
    if (link->received().size() != size_) quiet_s_ = 0.0;
    size_ = link->received().size();
    quiet_s_ += machine.cycle_s();
    // Only silence marks the end of the text.
    if (size_ > 0 && quiet_s_ > kQuiet_s) whole_ = true;
    return ProgramStep::kRunning;
  }
  ProgramStep command(Machine&) { return ProgramStep::kWaiting; }

  /// Returns the text once it is complete; empty before.
  std::string_view text(Machine& machine) const {
    return whole_ ? machine.links.find(kSocket)->received() : std::string_view();
  }

 private:
  static constexpr std::string_view kSocket = "script_sender";
  static constexpr double kQuiet_s = 0.3;

  bool asked_ = false, whole_ = false;
  std::size_t size_ = 0;
  double quiet_s_ = 0.0;
};

}  // namespace tactus::ur
