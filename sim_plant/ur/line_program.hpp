// LineProgram: a program of plain lines, interpreted: calls, assignments, `while` and `if` with
// conditions, and functions of the program's own that take nothing and return nothing. A condition
// or value that is not understood is left out with its block, and a text message says so; threads,
// and functions with arguments, are not understood.
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
  /// A line of the text: where it begins, and its number.
  struct Place {
    std::size_t at = 0;
    int line = 0;
  };
  /// A block that is being run.
  struct Block {
    enum Kind : std::uint8_t { kBranch, kLoop, kCall };
    Kind kind = kBranch;
    Place next;  ///< behind its end: a loop's beginning, the line after a call
  };

  ProgramStep end(const Machine& machine) const;
  bool next(std::string_view& line);
  Line run_line(std::string_view line, Machine& machine);
  Line run_block(std::string_view word, std::string_view line, Machine& machine);
  Line run_end();
  Line run_jump(bool out);
  Line run_return();
  bool find_function(std::string_view name, Place& body) const;
  bool call_own(std::string_view line, Line& result);
  Line run_statement(std::string_view line, Machine& machine);
  Line run_call_line(std::string_view line, Machine& machine);
  bool assign(std::string_view line, Machine& machine, Line& result);
  bool holds(std::string_view line, Machine& machine);
  static bool opens_block(std::string_view line);
  bool enter(Block::Kind kind, const Place& next);
  void find_branch(Machine& machine);
  void skip_blocks(std::size_t count);
  void not_emulated(std::string_view line, Machine& machine);

  static constexpr std::size_t kDeepest = 12;
  static constexpr int kLinesAtOnce = 256;  // of a loop that never waits

  std::string_view text_;
  Place now_, here_;  // the next line, and the one that is run
  int first_line_ = 1;
  bool moves_ = true;
  bool ended_ = false;
  bool told_ = false;  // that something is not emulated
  double wait_until_s_ = -1.0;
  std::array<Block, kDeepest> blocks_{};
  std::size_t depth_ = 0;
  ScriptVariables variables_;
};

}  // namespace tactus::ur
