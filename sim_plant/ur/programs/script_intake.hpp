// ScriptIntake: cuts the text that a client sends to a state port into programs and single lines. A
// block begins with "def" or "sec" in the first column and ends with "end" there.
#pragma once

#include <algorithm>
#include <cstring>

#include "sim_plant/ur/programs/runner.hpp"

namespace tactus::ur {

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
