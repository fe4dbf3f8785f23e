// The program of ur_rtde, and its report of progress.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "sim_plant/ur/parts/machine.hpp"

namespace tactus::ur {

/// AsyncProgress: the register in which ur_rtde's program reports the progress of an operation that
/// the client does not wait for. A value >= 0 is progress, 0 at the beginning; a negative value is
/// the end.
///
///   until 2022   the value itself; its end -1 and -2 in turn
///   since        | operation, 7 bits | - | writes, 7 bits | running, 1 bit | progress, 15 bits |
class AsyncProgress {
 public:
  enum class Coding : std::uint8_t { kNone, kValue, kCounted };

  explicit AsyncProgress(Coding coding = Coding::kNone) : coding_(coding) {}

  bool told() const { return coding_ != Coding::kNone; }
  /// True if an aborted operation is reported as ended. [any]
  bool tells_broken_off() const { return coding_ == Coding::kCounted; }

  /// Returns the content of the register for a value. [cyclic]
  std::int32_t write(std::int32_t value) {
    const bool running = value >= 0;
    if (coding_ == Coding::kValue) return running ? value : (ended_ = ended_ == -1 ? -2 : -1);
    writes_ = (writes_ + 1) & kMostCounted;
    if (value == 0) operation_ = (operation_ + 1) & kMostCounted;
    return operation_ << 24 | writes_ << 16 |
           (running ? kRunning | std::min(value, kRunning - 1) : 0);
  }

 private:
  static constexpr std::int32_t kMostCounted = 127, kRunning = 1 << 15;
  Coding coding_;
  std::int32_t ended_ = -2;
  std::int32_t writes_ = 0, operation_ = 0;
};

/// RegisterProgram: the program of ur_rtde. It communicates only through RTDE's registers: the
/// client writes a command into the first integer, the program answers ready or done in its own.
///
/// Differences between versions are read from its text: where the registers begin, how progress is
/// reported, and whether a function is called that only some controllers have.
class RegisterProgram {
 public:
  static bool recognises(std::string_view text);
  /// Starts the program; the text must outlive it.
  void start(std::string_view text);

  ProgramStep poll(Machine& machine);
  ProgramStep command(Machine& machine);

  enum class Outcome : std::uint8_t {
    kDone,
    kMoves,  ///< done when the arm is at rest
    kEnded,  ///< done, and the program ends
  };

 private:
  enum class Cyclic : std::uint8_t { kNone, kServo, kServoC, kSpeedJ, kSpeedL };
  /// The answer that the client sees while the command is in its register.
  enum class Handshake : std::uint8_t {
    kDone,   ///< the command acts once
    kReady,  ///< it acts in every cycle
    kBoth,   ///< it acts in every cycle; done is visible for one cycle, for clients that wait
  };
  static Handshake handshake_of(RegisterCommand command);

  // register_program.cpp: the handshake.
  Outcome process(RegisterCommand command, Machine& machine);
  bool has(std::string_view part) const { return text_.find(part) != std::string_view::npos; }
  double input(int i, const Machine& machine) const;
  std::int32_t integer_input(int i, const Machine& machine) const;
  Vector6 six(int first, const Machine& machine) const;
  void write(int i, std::int32_t value, Machine& machine) const;
  void tell_progress(std::int32_t value, Machine& machine);
  Outcome no_posture(Machine& machine) const;
  Outcome not_emulated(RegisterCommand command, Machine& machine) const;

  // register_commands.cpp: the commands. No outcome: it is none of these.
  Outcome act(RegisterCommand command, Machine& machine);
  std::optional<Outcome> move(RegisterCommand command, Machine& machine);
  std::optional<Outcome> lead(RegisterCommand command, Machine& machine);
  std::optional<Outcome> set(RegisterCommand command, Machine& machine);
  std::optional<Outcome> answer(RegisterCommand command, Machine& machine);
  Outcome move_path(Machine& machine);
  Outcome begin_move(bool good, Code otherwise, Machine& machine);
  Outcome begin(Machine& machine);
  void break_off(Machine& machine);
  void follow_path(Machine& machine);
  void follow(Cyclic cyclic, const Vector6& goal, double a, double t);
  Outcome jog(const Vector6& speed, Machine& machine);
  Outcome stop(double a, Machine& machine);
  Outcome answer_flag(bool flag, Machine& machine) const;
  Outcome answer_six(const Vector6& values, Machine& machine) const;

  std::string_view text_;
  int int_offset_ = 0, double_offset_ = 0;
  bool started_ = false;
  RegisterCommand last_ = RegisterCommand::kNone;
  bool executing_ = false;  // a command was processed, and the client has not withdrawn it
  bool blocked_ = false;    // until the arm is at rest
  bool moving_ = false;     // an asynchronous motion
  AsyncProgress progress_;
  std::string_view path_;  // remaining lines of the path
  Cyclic cyclic_ = Cyclic::kNone;
  Vector6 goal_ = Vector6::Zero();
  double v_ = 0.0, a_ = 0.0, t_ = 0.0;
  ServoLaw law_;
  bool jogging_ = false;
  Frame jog_frame_;
};

}  // namespace tactus::ur
