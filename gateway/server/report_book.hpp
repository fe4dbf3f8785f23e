// ReportBook: the sender of each reference in the channel, by number, until its final report.
#pragma once

#include <algorithm>
#include <array>

#include "gateway/server/limits.hpp"
#include "kernel/core/verdict.hpp"

namespace tactus {

/// A message of a client: the connection, by its session, and the client's number of the message.
struct Origin {
  int slot = -1;  ///< slot of the connection; -1: reports are discarded
  std::uint64_t session = 0;
  std::uint32_t number = 0;
};

/// Effect of a control, as reported to clients.
struct ControlEffect {
  const char* what = nullptr;  ///< null: not a control
  double percent = -1.0;       ///< of an override; negative: no override
  bool by_owner = false;       ///< sent by the owner of the motion
};

class ReportBook {
 public:
  struct Entry {
    std::uint32_t id = 0;  ///< 0: free
    Origin from;
    Verdict failed;  ///< reason, if the server cancels it
    double stretch = 0.0;
    bool streams = false;  ///< a chunk or a velocity, which may starve after its final report
    ControlEffect effect = {};
  };

  /// True if only the space for the trajectory in transfer is left.
  bool full() const { return count_ >= kMostUnreported - 1; }
  /// Requires space: see full().
  void add(const Entry& entry) {
    Entry* const free = find(0);
    if (free == nullptr) return;
    *free = entry;
    ++count_;
  }
  /// Returns the entry of a number, or null.
  Entry* find(std::uint32_t id) {
    for (Entry& entry : entries_)
      if (entry.id == id) return &entry;
    return nullptr;
  }
  /// True if a chunk or a velocity has no final report yet.
  bool streams() const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [](const Entry& entry) { return entry.id != 0 && entry.streams; });
  }
  /// Discards the reports for this session from now on.
  void forget(std::uint64_t session) {
    for (Entry& entry : entries_)
      if (entry.from.session == session) entry.from.slot = -1;
  }
  void remove(Entry& entry) {
    entry = {};
    --count_;
  }

 private:
  std::array<Entry, kMostUnreported> entries_{};
  int count_ = 0;
};

}  // namespace tactus
