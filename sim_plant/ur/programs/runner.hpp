// Runner: holds the running program, recognises its kind by its text, starts, pauses and ends it.
#pragma once

#include <variant>

#include "sim_plant/ur/programs/external_control.hpp"
#include "sim_plant/ur/programs/fetch_program.hpp"
#include "sim_plant/ur/programs/register_program.hpp"

namespace tactus::ur {

inline constexpr std::size_t kLongestScript = 256 * 1024;

class Runner {
 public:
  /// Takes an uploaded program: "def name(): ... end", "sec name(): ... end", or a single line. It
  /// replaces the running program; a secondary program runs in parallel. [any]
  void upload(std::string_view text, Machine& machine);
  /// Fetches the program from the control computer. [any]
  void fetch(Machine& machine);
  void stop(Machine& machine);  ///< stops the program, if one runs
  void pause() { paused_ = running(); }
  void resume() { paused_ = false; }

  /// Runs the program's main threads for one cycle. [cyclic]
  void poll(Machine& machine);
  /// Gives the next motion command, if there is one. [cyclic]
  void command(Machine& machine);

  bool running() const { return !std::holds_alternative<std::monostate>(program_); }
  bool playing() const { return running() && !paused_; }
  bool paused() const { return running() && paused_; }
  RuntimeState state() const {
    return !running() ? RuntimeState::kStopped
           : paused_  ? RuntimeState::kPaused
                      : RuntimeState::kPlaying;
  }
  std::string_view name() const { return {name_.data(), name_size_}; }

 private:
  static constexpr std::size_t kLongestName = 31, kLongestSecondary = 8192;

  void start(std::string_view text, Machine& machine);
  void start_secondary(std::string_view text, Machine& machine);
  void poll_secondary(Machine& machine);
  void start_fetched(std::string_view text, Machine& machine);
  void set_name(std::string_view name);
  void watch_inputs(Machine& machine);

  std::variant<std::monostate, LineProgram, ExternalControl, RegisterProgram, FetchProgram>
      program_;
  bool paused_ = false;
  bool braking_ = false;  // from the motion of the last program
  std::array<char, kLongestScript> text_;
  std::array<char, kLongestName> name_{};
  std::size_t name_size_ = 0;

  LineProgram secondary_;
  bool secondary_running_ = false;
  std::array<char, kLongestSecondary> secondary_text_;
  std::array<char, kLongestName> secondary_name_{};
  std::size_t secondary_name_size_ = 0;
};

}  // namespace tactus::ur
