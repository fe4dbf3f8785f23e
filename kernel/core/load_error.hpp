// LoadError: why a pipeline file was refused, and where. The program adds the file's name in front.
#pragma once

#include "kernel/core/status.hpp"
#include "kernel/core/text.hpp"

namespace tactus {

inline constexpr std::size_t kMaxNameLength = 31;    ///< section, key and port names
inline constexpr std::size_t kMaxValueLength = 191;  ///< the right-hand side of a line

using Name = Text<kMaxNameLength>;
using Value = Text<kMaxValueLength>;
using PlacedMessage = Text<479>;  ///< a message with its place in front

struct LoadError {
  Status status = Status::kOk;
  int line = 0;  ///< from 1; 0 = the file as a whole
  Name section, key;
  Message reason;

  /// Fills in the error and returns `code`, for `return error.refuse(...)`. [init]
  Status refuse(Status code, int at_line, std::string_view in_section, std::string_view at_key,
                std::string_view why) {
    status = code;
    line = at_line;
    section = Name(in_section);
    key = Name(at_key);
    reason = Message(why);
    return code;
  }

  /// Returns "line: [section] key: reason" without the parts that are empty. [init]
  PlacedMessage message() const {
    PlacedMessage text;
    if (line > 0) text << line << ": ";
    if (!section.empty()) text << "[" << section << "] ";
    if (!key.empty()) text << key << ": ";
    text << reason;
    return text;
  }
};

}  // namespace tactus
