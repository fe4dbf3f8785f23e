#include "gateway/server/reference_intake.hpp"

#include <algorithm>

namespace tactus {

template <class Space>
Verdict ReferenceIntake<Space>::point(const Origin& from, const TrajectoryTerms& terms,
                                      const typename Space::Point& point,
                                      const PointDetails& details) {
  return offer({RequestKind::kPoint, from, terms, point, details, {}}, waiting_chunk_);
}

/// The epochs of the generator void references that a stop overtakes on the way to the cycle.
/// References after a cancel by the server, as for a new owner, belong to the epoch it begins.
template <class Space>
std::uint32_t ReferenceIntake<Space>::present_epoch() const {
  return std::max<std::uint32_t>(1, stream().epoch) + (ending_ != 0 ? 1 : 0);
}

/// The order is that of arrival, since the server has judged the clients' places.
template <class Space>
Verdict ReferenceIntake<Space>::chunk(const Origin& from, const TrajectoryTerms& terms,
                                      Chunk<Space>& chunk) {
  chunk.epoch = present_epoch();
  chunk.sequence = ++sequence_;
  const Verdict verdict = offer({RequestKind::kChunk, from, terms, {}, {}, {}}, chunk);
  if (verdict.ok()) ++chunks_;
  return verdict;
}

template <class Space>
Verdict ReferenceIntake<Space>::velocity(const Origin& from, const TrajectoryTerms& terms,
                                         Velocity<Space>& velocity) {
  velocity.epoch = present_epoch();
  velocity.sequence = ++sequence_;
  return offer({RequestKind::kVelocity, from, terms, {}, {}, velocity}, waiting_chunk_);
}

template <class Space>
Verdict ReferenceIntake<Space>::post(const Reference& reference, Chunk<Space>& chunk,
                                     std::uint32_t& id) {
  if (reference.kind == RequestKind::kPoint)
    return server_.point(reference.terms, reference.point, id, reference.details);
  typename Space::Header header;
  const Verdict verdict = server_.place(reference.terms, header);
  if (!verdict.ok()) return verdict;
  if (reference.kind == RequestKind::kVelocity) return client_.send(reference.velocity, id, header);
  chunk.header = header;
  return client_.send(chunk, id);
}

/// Stores of chunks become free as long as the cycle has not answered all that were sent.
template <class Space>
bool ReferenceIntake<Space>::finds_no_space(const Verdict& verdict) const {
  return verdict.status == Status::kMailboxFull ||
         (verdict.status == Status::kNoFreeStore && book_.streams());
}

/// Sends a reference, or lets it wait for space; either supersedes the one that waits.
template <class Space>
Verdict ReferenceIntake<Space>::offer(const Reference& reference, Chunk<Space>& chunk) {
  if (busy()) return {Status::kMailboxFull};
  std::uint32_t id = 0;
  const Verdict verdict = post(reference, chunk, id);
  const bool waits = finds_no_space(verdict);
  if (!verdict.ok() && !waits) return verdict;
  drop_waiting();
  if (!waits) {
    book_.add({id, reference.from, {}, 0.0, reference.kind != RequestKind::kPoint});
    return {};
  }
  waits_ = true;
  waiting_ = reference;
  if (reference.kind == RequestKind::kChunk) waiting_chunk_ = chunk;
  return {};
}

/// Sends the reference that waits; false: there is still no space.
template <class Space>
bool ReferenceIntake<Space>::send_waiting() {
  if (!waits_) return true;
  if (book_.full()) return false;
  std::uint32_t id = 0;
  const Verdict verdict = post(waiting_, waiting_chunk_, id);
  if (finds_no_space(verdict)) return false;
  waits_ = false;
  if (verdict.ok())
    book_.add({id, waiting_.from, {}, 0.0, waiting_.kind != RequestKind::kPoint});
  else
    queue_report(waiting_.from, Outcome::kRefused, verdict);
  return true;
}

template <class Space>
void ReferenceIntake<Space>::drop_waiting() {
  if (waits_) queue_report(waiting_.from, Outcome::kSuperseded, {});
  waits_ = false;
}

template <class Space>
void ReferenceIntake<Space>::queue_report(const Origin& to, Outcome outcome, const Verdict& verdict,
                                          double stretch) {
  reports_[static_cast<std::size_t>(report_count_++)] = {to, outcome, verdict, 0.0, stretch};
}

template <class Space>
Verdict ReferenceIntake<Space>::control(const Origin& from, ControlKind kind, double rate,
                                        const ControlEffect& effect) {
  if (busy() || (!effect.by_owner && client_.unanswered() >= kControls / 2))
    return {Status::kMailboxFull};
  std::uint32_t id = 0;
  const Verdict verdict = server_.control(kind, rate, id);
  if (!verdict.ok()) return verdict;
  book_.add({id, from, {}, 0.0, false, effect});
  if (kind == ControlKind::kCancel) canceling_ = id;
  return {};
}

template <class Space>
Verdict ReferenceIntake<Space>::begin(const Origin& from, const TrajectoryTerms& terms) {
  // Two reports must find space: of the one that is given up, and of this one, which may end before
  // it is sent.
  if (report_count_ + 2 > static_cast<int>(reports_.size())) return {Status::kMailboxFull};
  if (terms.check && coming_ && !comes(from)) return {Status::kNoFreeStore};
  if (coming_) give_up(origin_.session);
  const Verdict verdict = server_.begin(terms);
  if (!verdict.ok()) return verdict;
  coming_ = true;
  ended_ = false;
  checks_ = terms.check;
  origin_ = from;
  fields_ = terms.fields;
  id_ = 0;
  first_ = count_ = outstanding_ = 0;
  free_ = server_.capacity();
  return {};
}

template <class Space>
void ReferenceIntake<Space>::take(const Waypoint<Space>& waypoint) {
  if (count_ == kStagedWaypoints) move_on();  // into the window: it was granted with the rest
  if (!coming_ || count_ == kStagedWaypoints) return;
  --outstanding_;
  Waypoint<Space>& staged =
      staged_[static_cast<std::size_t>((first_ + count_++) % kStagedWaypoints)];
  staged = waypoint;
  turns_.take(staged.point);
}

template <class Space>
Message ReferenceIntake<Space>::about_turns(const ClientReport& result) {
  if (result.to.session != origin_.session || result.to.number != origin_.number) return {};
  if (const TurnStep* const step = turns_.explain(result.verdict)) return remedy(*step);
  const TurnStep* const longest = turns_.longest();
  if (warned_ || longest == nullptr || !result.verdict.ok()) return {};
  warned_ = true;
  return describe(*longest);
}

template <class Space>
Verdict ReferenceIntake<Space>::end(const Origin& from) {
  if (!comes(from) || ended_) return {Status::kNothingToExtend};
  ended_ = true;
  return {};
}

template <class Space>
void ReferenceIntake<Space>::give_up(std::uint64_t session) {
  if (coming_ && origin_.session == session) fail({}, Outcome::kCanceled);
}

template <class Space>
void ReferenceIntake<Space>::cancel() {
  std::uint32_t id = 0;  // not reported
  cancel_due_ = !server_.control(ControlKind::kCancel, 1.0, id).ok();
  if (!cancel_due_) ending_ = id;
}

template <class Space>
void ReferenceIntake<Space>::forget(std::uint64_t session) {
  book_.forget(session);
  if (waiting_.from.session == session) waiting_.from.slot = -1;
  if (stream_.from.session == session) stream_ = {};
}

/// Ends the trajectory in transfer. If the generator already has it, its report follows.
template <class Space>
void ReferenceIntake<Space>::fail(const Verdict& verdict, Outcome outcome) {
  coming_ = false;
  count_ = outstanding_ = 0;
  ReportBook::Entry* const entry = id_ != 0 ? book_.find(id_) : nullptr;
  if (entry == nullptr && id_ == 0) {
    queue_report(origin_, outcome, verdict);
  } else if (entry != nullptr && !verdict.ok()) {
    entry->failed = verdict;
    cancel();  // or the arm would wait on the path for waypoints that never arrive
  }
}

/// Notes under which number the generator has the trajectory, once it does.
template <class Space>
void ReferenceIntake<Space>::note_sent() {
  if (id_ != 0 || server_.sent() == 0) return;
  id_ = server_.sent();
  free_ = 0;
  book_.add({id_, origin_, {}, server_.stretch()});
}

template <class Space>
void ReferenceIntake<Space>::move_on() {
  if (cancel_due_) cancel();
  if (cancel_due_ || !send_waiting()) return;
  while (coming_ && count_ > 0) {
    const Verdict verdict = server_.take(staged_[static_cast<std::size_t>(first_)]);
    note_sent();
    if (verdict.status == Status::kWindowFull) return;
    if (!verdict.ok()) return fail(verdict, Outcome::kRefused);
    first_ = (first_ + 1) % kStagedWaypoints;
    --count_;
    free_ -= free_ > 0 ? 1 : 0;
  }
  if (!coming_ || !ended_) return;
  std::uint32_t id = 0;
  const Verdict verdict = server_.end(id);
  if (verdict.status == Status::kWindowFull) return;
  if (!verdict.ok()) return fail(verdict, Outcome::kRefused);
  coming_ = false;
  if (checks_)
    queue_report(origin_, Outcome::kExecuted, {}, server_.stretch());
  else if (id_ == 0)
    book_.add({id, origin_, {}, server_.stretch()});
}

template <class Space>
bool ReferenceIntake<Space>::work(ClientReport& result) {
  move_on();
  while (report_count_ > 0) {
    result = reports_[0];
    std::move(reports_.begin() + 1, reports_.begin() + report_count_--, reports_.begin());
    if (result.to.slot >= 0) return true;
  }
  Report report;
  while (server_.fetch(report))
    if (translate(report, result)) return true;
  return false;
}

/// Fills in `result`. Returns false for reports without a client: on stores, and for closed
/// sessions.
template <class Space>
bool ReferenceIntake<Space>::translate(const Report& report, ClientReport& result) {
  if (report.id == canceling_) canceling_ = 0;
  if (report.id == ending_) ending_ = 0;
  ReportBook::Entry* const entry = report.id != 0 ? book_.find(report.id) : nullptr;
  if (entry == nullptr) {
    result = {stream_.from, report.outcome, report.verdict, report.time_s, 0.0};
    return report.outcome == Outcome::kStarved && report.id == stream_.id && result.to.slot >= 0;
  }
  result = {entry->from, report.outcome, report.verdict, report.time_s, entry->stretch};
  if (report.outcome == Outcome::kCanceled && !entry->failed.ok()) {
    result.outcome = Outcome::kAborted;
    result.verdict = entry->failed;
  }
  if (!is_final(report.outcome)) return result.to.slot >= 0;
  if (report.outcome == Outcome::kExecuted) result.effect = entry->effect;
  if (report.id == id_ && coming_) coming_ = false;
  if (entry->streams && report.outcome == Outcome::kExecuted) stream_ = *entry;
  book_.remove(*entry);
  return result.to.slot >= 0;
}

/// Grants only as many waypoints as fit at any moment, staged or in the window.
template <class Space>
bool ReferenceIntake<Space>::grant(Credit& credit) {
  if (!coming_ || ended_) return false;
  const int space = kStagedWaypoints - count_ + free_;
  credit = {origin_, space - outstanding_};
  if (credit.waypoints <= 0) return false;
  outstanding_ = space;
  return true;
}

template <class Space>
std::uint32_t ReferenceIntake<Space>::number_of(std::uint32_t id, std::uint64_t session) {
  const ReportBook::Entry* const entry = id != 0 ? book_.find(id) : nullptr;
  return entry != nullptr && entry->from.session == session ? entry->from.number : 0;
}

template class ReferenceIntake<JointSpace>;
template class ReferenceIntake<TaskSpace>;

}  // namespace tactus
