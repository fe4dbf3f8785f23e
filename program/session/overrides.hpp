// Overrides: the keys that the command line gives (--set section.key=value) in the text of a
// pipeline file. They are written into the text before it is read, so that the loader, a board that
// reads it beside this program, its copy in the folder of a run and its hash have them.
#pragma once

#include <array>

#include "kernel/core/load_error.hpp"
#include "program/session/options.hpp"

namespace tactus {

inline constexpr std::size_t kMaxPipelineBytes = 65536;

/// The text of a pipeline file.
struct PipelineText {
  std::array<char, kMaxPipelineBytes + 1> bytes;  ///< one more, by which a longer file is found
  std::size_t size = 0;

  std::string_view view() const { return {bytes.data(), size}; }
};

class Overrides {
 public:
  /// Writes all keys into the text of a file, where they are or at the begin of their section, or
  /// in a section behind the last. False: prints the reason to stderr. A file whose form is wrong
  /// is left as it is, for the loader to refuse.
  bool write(const OverrideOptions& options, PipelineText& text);

  /// Converts the line of an error in the changed text: to that of the file, or, if an override
  /// has caused it, to 0. Returns the text of that option, else null.
  const char* place(LoadError& error) const;

 private:
  struct Written {
    const char* option;
    int first;  // its line in the changed text
    int added;  // lines that the file does not have; 0: it replaces a value
  };

  /// Notes a value that was written `line` lines down, or below that line.
  void note(const char* option, int line, int added);

  std::array<Written, OverrideOptions::kMost> written_;
  int count_ = 0;
};

}  // namespace tactus
