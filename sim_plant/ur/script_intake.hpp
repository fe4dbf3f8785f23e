// ScriptIntake: text that a client sends to a state port, cut into programs and single lines. A
// block begins with "def" or "sec" in the first column and ends with "end" there.
#pragma once

#include <algorithm>
#include <cstring>

#include "sim_plant/ur/runner.hpp"

namespace tactus::ur {

class ScriptIntake {
 public:
  void clear() {
    size_ = scanned_ = 0;
    depth_ = 0;
    dropping_ = false;
  }
  /// Every whole block and line is handed to `sink`, in order. Of what is longer than a program may
  /// be, `sink` gets a beginning that is too long as well; the rest is dropped.
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
  /// The next whole piece behind `used` bytes; false: there is none yet.
  bool next(std::size_t& used, std::string_view& piece);

  /// Makes room, but keeps the line that has begun, or a blank in its place.
  void drop();

  std::array<char, kLongestScript + 1> text_;
  std::size_t size_ = 0;
  std::size_t scanned_ = 0;  // whole lines that were looked at
  int depth_ = 0;            // of blocks in the first column
  bool dropping_ = false;    // to the end of a block that was too long
};

/// A line that is a command to the controller and no program; false: it is none.
bool run_direct_command(std::string_view line, Runner& runner, Machine& machine);

}  // namespace tactus::ur
