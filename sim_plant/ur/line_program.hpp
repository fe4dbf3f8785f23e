// LineProgram: a program of plain lines, run one after the other: calls with values that are
// written out, `while True:`, assignments of values. Conditions are not understood: what stands
// under one is left out, and a text message says so.
#pragma once

#include "sim_plant/ur/program_step.hpp"
#include "sim_plant/ur/script_calls.hpp"

namespace tactus::ur {

class LineProgram {
 public:
  /// The lines of a program without its first, "def name():"; the text outlives the program.
  /// `first_line` is what the first of them is counted as. `moves`: it may move the arm.
  void start(std::string_view text, int first_line, bool moves);

  /// The lines up to one that takes time. [cyclic]
  ProgramStep poll(Machine& machine);
  ProgramStep command(Machine& machine);

 private:
  enum class Line : std::uint8_t { kNext, kWait, kEnded };
  struct Loop {
    std::size_t at;
    int line;
  };

  Line run_line(std::string_view line, Machine& machine);
  Line run_statement(std::string_view line, Machine& machine);
  Line run_call_line(std::string_view line, Machine& machine);
  void skip_block();

  static constexpr std::size_t kDeepest = 8;
  static constexpr int kLinesAtOnce = 64;  // of a loop that never waits

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 0;
  bool moves_ = true;
  bool ended_ = false;
  double wait_until_s_ = -1.0;
  std::array<Loop, kDeepest> loops_{};
  std::size_t depth_ = 0;
  ScriptVariables variables_;
};

}  // namespace tactus::ur
