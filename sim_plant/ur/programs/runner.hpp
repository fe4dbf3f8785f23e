// From bytes of a client to the running program.
#pragma once

#include <algorithm>
#include <cstring>
#include <variant>

#include "sim_plant/ur/parts/machine.hpp"
#include "sim_plant/ur/programs/external_control.hpp"
#include "sim_plant/ur/programs/register_program.hpp"

namespace tactus::ur {

/// FetchProgram: the first part of external_control.urp. It fetches the text of the script from a
/// server on the control computer; the script then replaces it.
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

inline constexpr std::size_t kLongestScript = 256 * 1024;

/// Runner: holds the running program, recognises its kind by its text, starts, pauses and ends it.
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
  std::string_view name() const { return name_; }

 private:
  static constexpr std::size_t kLongestName = 31, kLongestSecondary = 8192;

  void start(std::string_view text, Machine& machine);
  void start_secondary(std::string_view text, Machine& machine);
  void poll_secondary(Machine& machine);
  void start_fetched(std::string_view text, Machine& machine);
  void watch_inputs(Machine& machine);

  std::variant<std::monostate, LineProgram, ExternalControl, RegisterProgram, FetchProgram>
      program_;
  bool paused_ = false;
  bool braking_ = false;  // from the motion of the last program
  std::array<char, kLongestScript> text_;
  Text<kLongestName> name_;

  LineProgram secondary_;
  bool secondary_running_ = false;
  std::array<char, kLongestSecondary> secondary_text_;
  Text<kLongestName> secondary_name_;
};

/// ScriptIntake: cuts the text that a client sends to a state port into programs and single lines.
/// A block begins with "def" or "sec" in the first column and ends with "end" there.
class ScriptIntake {
 public:
  void clear() {
    size_ = scanned_ = 0;
    depth_ = 0;
    dropping_ = false;
  }
  /// Passes every whole block and line to `sink`, in order. If a block is too long for a program,
  /// `sink` gets its beginning, which is too long as well; the rest is dropped.
  template <class Sink>
  void take(const std::uint8_t* data, std::size_t size, Sink&& sink) {
    while (size > 0) {
      const std::size_t part = std::min(size, text_.size() - size_);
      if (part == 0) {
        if (!dropping_) sink(std::string_view(text_.data(), size_));
        drop();
        continue;
      }
      std::memcpy(text_.data() + size_, data, part);
      size_ += part;
      data += part;
      size -= part;
      std::size_t used = 0;
      for (std::string_view piece; next(used, piece);) sink(piece);
      std::memmove(text_.data(), text_.data() + used, size_ - used);
      size_ -= used;
      scanned_ -= used;
    }
  }

 private:
  /// Returns the next whole piece after `used` bytes. False: there is none yet.
  bool next(std::size_t& used, std::string_view& piece);

  /// Drops the text except for the line that has begun, or a blank in its place.
  void drop();

  std::array<char, kLongestScript + 1> text_;
  std::size_t size_ = 0;
  std::size_t scanned_ = 0;  // bytes of whole lines that were scanned
  int depth_ = 0;            // of blocks in the first column
  bool dropping_ = false;    // until the end of a block that is too long
};

/// Runs a line that is a command to the controller, not a program. False: it is not a command.
bool run_direct_command(std::string_view line, Runner& runner, Machine& machine);

}  // namespace tactus::ur
