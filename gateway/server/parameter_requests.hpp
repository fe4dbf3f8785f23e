// ParameterRequests: the parameters of a running pipeline, listed and set by clients. One set at a
// time is under way to the cycle.
#pragma once

#include "gateway/server/clients.hpp"
#include "gateway/server/cycle_mailboxes.hpp"
#include "kernel/load/parameter_book.hpp"

namespace tactus {

class ParameterRequests {
 public:
  /// `book` null: the parameters do not change while the pipeline runs.
  ParameterRequests(ParameterBook* book, const Pipeline& pipeline, CycleMailboxes& mailboxes,
                    Clients& clients)
      : book_(book), pipeline_(pipeline), mailboxes_(mailboxes), clients_(clients) {}

  bool offered() const { return book_ != nullptr; }
  /// Number of sets that have taken effect.
  std::uint32_t sets() const { return sets_; }
  /// Posts a set to the cycle, or only checks it; offered() is true.
  Reply set(const tactus_Parameters& request, const Origin& from);
  /// Sends a page of the list; offered() is true. A client without space for it is asked to read.
  Reply list(const tactus_ListParameters& request, const Origin& from);
  /// Takes the cycle's verdict on the set and reports it, with the generator time of the newest
  /// cycle.
  void take_verdict(double time_s, std::int64_t now_ns);

 private:
  void send_changes(std::int64_t now_ns);

  ParameterBook* book_;
  const Pipeline& pipeline_;
  CycleMailboxes& mailboxes_;
  Clients& clients_;
  bool tuning_ = false;  // a set is the cycle's
  Origin from_;
  Name by_;
  std::uint32_t sets_ = 0;
};

}  // namespace tactus
