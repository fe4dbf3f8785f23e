// Dashboard: the text commands of port 29999, one line and one reply each. Holds the state that all
// clients share.
#pragma once

#include "sim_plant/ur/programs/runner.hpp"

namespace tactus::ur {

inline constexpr std::string_view kDashboardGreeting =
    "Connected: Universal Robots Dashboard Server\n";

/// A reply; a long text is cut, but never its end of line.
class Reply {
 public:
  Reply& operator<<(std::string_view text);
  void end_line() { text_[size_++] = '\n'; }  ///< once, at the end
  std::string_view text() const { return {text_.data(), size_}; }

 private:
  std::array<char, 512> text_;
  std::size_t size_ = 0;
};

class Dashboard {
 public:
  Dashboard(Runner& runner, Machine& machine) : runner_(runner), machine_(machine) {}

  /// Runs one line, given without its end. True: the client asked to be disconnected.
  bool run(std::string_view line, Reply& reply);

 private:
  bool run_program_command(std::string_view line, Reply& reply);
  bool run_robot_command(std::string_view line, Reply& reply);
  bool run_other_command(std::string_view line, Reply& reply);
  bool run_e_series_command(std::string_view line, Reply& reply);
  void load(std::string_view path, Reply& reply);
  void play(Reply& reply);
  std::string_view loaded() const { return {loaded_.data(), loaded_size_}; }
  std::string_view loaded_name() const;

  Runner& runner_;
  Machine& machine_;
  std::string_view operational_mode_ = "NONE";  // until a client sets one
  std::array<char, 128> loaded_{};
  std::size_t loaded_size_ = 0;
  std::array<char, 32> role_{};
  std::size_t role_size_ = 0;
};

}  // namespace tactus::ur
