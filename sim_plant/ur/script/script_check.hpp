// Finds what is wrong with a program before it runs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {

/// ScriptBlocks: whether the lines of a program stand in blocks as they may: every block has its
/// end, branches belong to an `if`, jumps to a loop.
class ScriptBlocks {
 public:
  static constexpr std::size_t kDeepest = 32;  ///< blocks that run at a time
  static constexpr std::string_view kTooDeep = "limit of 32 nested blocks";

  /// Takes the next line, without blanks and comment, and its number. Returns why it may not stand
  /// there; empty: it may. [any]
  std::string_view take(std::string_view line, int number);

  /// Returns the line of the innermost block without an end; 0: there is none. [any]
  int open_line() const { return depth_ > 0 ? blocks_[depth_ - 1].line : 0; }

 private:
  enum class Kind : std::uint8_t { kIf, kElse, kLoop, kFunction };
  struct Block {
    Kind kind = Kind::kIf;
    int line = 0;
  };

  std::string_view open(Kind kind, int number);
  std::string_view close();
  bool in_loop() const;

  std::array<Block, kDeepest + 1> blocks_{};  // the program itself is one
  std::size_t depth_ = 0;
  bool closed_ = false;  // the block in the first line has ended
  bool whole_ = false;   // the text is one block
};

/// The first fault of a program: line and column from 1, the name or word, and the reason if the
/// word alone does not tell it.
struct ScriptFault {
  enum class Kind : std::uint8_t {
    kNameNotFound,  ///< as on the robot
    kNotEmulated,   ///< the robot knows it
    kSyntax,
    kLimit,  ///< the interpreter has no room for it
  };
  Kind kind = Kind::kSyntax;
  int line = 0, column = 0;
  std::string_view name, reason;
};

/// ScriptCheck: reads a plain program before it runs, and finds the first place that the
/// interpreter of lines does not understand: threads, functions of the program's own, functions
/// that are not emulated, names without a value, blocks without end, and what is no line of
/// URScript. Such a program is refused as a whole, because an arm that does half of a program is
/// worse than one that stands.
class ScriptCheck {
 public:
  /// Takes the whole text: "def name(): ... end", "sec name(): ... end", or a single line.
  explicit ScriptCheck(std::string_view program);

  /// True if there is a fault.
  bool find(ScriptFault& fault);

 private:
  void collect_variables();
  bool good_line(std::string_view line);
  bool good_place(std::string_view line, int number);
  bool good_statement(std::string_view line);
  bool good_call(std::string_view line);
  bool whole(std::string_view text, std::string_view after);
  bool blame(std::string_view name, std::string_view reason = {});
  bool defines(std::string_view name) const;
  ScriptFault::Kind kind() const;

  std::string_view program_, body_;  // the text, and its lines after "def name():"
  ScriptVariables variables_;        // every name that some line assigns
  int overflow_ = 0;                 // first line with a variable too many
  ScriptBlocks blocks_;
  std::string_view strange_, reason_;  // the name or word to blame, and why
};

}  // namespace tactus::ur
