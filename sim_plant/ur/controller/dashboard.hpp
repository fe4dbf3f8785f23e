// Dashboard: the text commands of port 29999, one line and one reply each. Holds the state that all
// clients share.
#pragma once

#include "sim_plant/ur/programs/runner.hpp"

namespace tactus::ur {

inline constexpr std::string_view kDashboardGreeting =
    "Connected: Universal Robots Dashboard Server\n";

/// A reply with its end of line; a long text is cut before it.
using Reply = Text<512>;

class Dashboard {
 public:
  Dashboard(Runner& runner, Machine& machine) : runner_(runner), machine_(machine) {}

  /// Runs one line, given without its end. True: the client asked to be disconnected.
  bool run(std::string_view line, Reply& whole);

 private:
  using Answer = Text<Reply::capacity() - 1>;

  bool run_program_command(std::string_view line, Answer& reply);
  bool run_robot_command(std::string_view line, Answer& reply);
  bool run_other_command(std::string_view line, Answer& reply);
  bool run_e_series_command(std::string_view line, Answer& reply);
  void load(std::string_view path, Answer& reply);
  void play(Answer& reply);
  std::string_view loaded_name() const;

  Runner& runner_;
  Machine& machine_;
  std::string_view operational_mode_ = "NONE";  // until a client sets one
  Text<128> loaded_;
  Text<32> role_;
};

}  // namespace tactus::ur
