// ScriptBlocks: whether the lines of a program stand in blocks as they may: every block has its
// end, branches belong to an `if`, jumps to a loop.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::ur {

class ScriptBlocks {
 public:
  static constexpr std::size_t kDeepest = 32;  ///< blocks and calls that run at a time
  static constexpr std::string_view kTooDeep = "limit of 32 nested blocks and calls";

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

}  // namespace tactus::ur
