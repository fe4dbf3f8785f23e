// CommandGate: which commands of browsers go on to the server: not more than it takes of one
// client, and none that was on its way for so long that it may be a surprise.
#pragma once

#include <array>

#include "gateway/page/limits.hpp"
#include "gateway/page/page_command.hpp"

namespace tactus {

struct CommandVerdict {
  int status = 200;       ///< of HTTP; 200: go on
  const char* text = "";  ///< of a refusal
};

class CommandGate {
 public:
  /// Judges a command of a browser whose latest state was sent at `seen_ms`. Stop always goes
  /// on. [any, one thread]
  CommandVerdict judge(PageCommand command, std::int64_t seen_ms, std::int64_t now_ms);

 private:
  bool behind(std::int64_t seen_ms, std::int64_t now_ms) const;
  bool share_is_left(std::int64_t now_ms);

  std::int64_t stopped_ms_ = -1;
  std::array<std::int64_t, kCommandsPerSecond> taken_ms_{};  // ring of the last ones
  std::size_t count_ = 0;
};

}  // namespace tactus
