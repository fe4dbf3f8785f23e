// LineProgram: interprets a program of plain lines: calls, assignments, `while` and `if` with
// conditions. Runner refuses a program that has anything else (script_check.hpp). If a value does
// not exist or fit, the program ends with a runtime exception.
#pragma once

#include "sim_plant/ur/parts/machine.hpp"
#include "sim_plant/ur/script/script_calls.hpp"
#include "sim_plant/ur/script/script_check.hpp"
#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {

class LineProgram {
 public:
  /// Starts the lines of a program without its first, "def name():"; the text must outlive the
  /// program. `first_line` is the number of the first line. `moves`: it may move the arm.
  void start(std::string_view text, int first_line, bool moves);

  /// Runs the lines up to one that takes time. [cyclic]
  ProgramStep poll(Machine& machine);
  ProgramStep command(Machine& machine);

 private:
  enum class Line : std::uint8_t { kNext, kWait, kEnded };
  /// A line of the text: its beginning and its number.
  struct Place {
    std::size_t at = 0;
    int line = 0;
  };
  /// A block that is running.
  struct Block {
    bool loops = false;
    Place begin;
  };

  ProgramStep end(const Machine& machine) const;
  bool next(std::string_view& line);
  Line run_line(std::string_view line, Machine& machine);
  Line run_block(std::string_view word, std::string_view line, Machine& machine);
  Line run_end();
  Line run_jump(bool out);
  ScriptScope known(const Machine& machine) {
    return {&variables_, &machine, nullptr, &reason_, &work_};
  }
  Line run_statement(std::string_view line, Machine& machine);
  Line run_call_line(std::string_view line, Machine& machine);
  bool assign(std::string_view line, Machine& machine, Line& result);
  bool holds(std::string_view line, Machine& machine);
  static bool opens_block(std::string_view line);
  bool enter(const Block& block, Machine& machine);
  void find_branch(Machine& machine);
  void skip_blocks(std::size_t count);
  void fail(std::string_view line, Machine& machine, std::string_view what = {});

  /// Lines and values read in a cycle, for a loop that never waits. The rest of a line that needs
  /// more is taken off the next cycles.
  static constexpr int kWorkPerCycle = 1024;

  std::string_view text_;
  Place now_, here_;  // the next line, and the running one
  bool moves_ = true;
  bool ended_ = false;
  int work_ = 0;
  decltype(Machine::cycle) cycle_ = 0;
  std::string_view reason_;  // why the running line has no value, if more is known
  double wait_until_s_ = -1.0;
  std::array<Block, ScriptBlocks::kDeepest> blocks_{};
  std::size_t depth_ = 0;
  ScriptVariables variables_;
};

}  // namespace tactus::ur
