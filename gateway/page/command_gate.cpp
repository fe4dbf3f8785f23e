#include "gateway/page/command_gate.hpp"

namespace tactus {

CommandVerdict CommandGate::judge(PageCommand command, std::int64_t seen_ms, std::int64_t now_ms) {
  if (command == PageCommand::kStop) {
    stopped_ms_ = now_ms;
    return {};
  }
  if (may_need_lease(command) && behind(seen_ms, now_ms))
    return {409, "the page is behind: its newest state is old, or of before a stop; look again"};
  if (!share_is_left(now_ms)) return {429, "more than 50 commands in a second; try again"};
  return {};
}

/// Requests of two connections are not served in the order in which they were sent: a Rearm that
/// was sent before a Stop must not undo it.
bool CommandGate::behind(std::int64_t seen_ms, std::int64_t now_ms) const {
  return seen_ms <= stopped_ms_ || seen_ms > now_ms || seen_ms < now_ms - kOldestSeen_ms;
}

bool CommandGate::share_is_left(std::int64_t now_ms) {
  std::int64_t& oldest_ms = taken_ms_[count_ % taken_ms_.size()];
  if (count_ >= taken_ms_.size() && now_ms - oldest_ms < 1000) return false;
  oldest_ms = now_ms;
  ++count_;
  return true;
}

}  // namespace tactus
