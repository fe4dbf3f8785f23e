#include "gateway/trajectory/trajectory_stream.hpp"

namespace tactus {
namespace {

constexpr const char* kChanged =
    "the file changed after it was judged; leave it alone while it runs, and run it again";

}  // namespace

bool of_derivatives(Status status) {
  return status == Status::kVelocityLimit || status == Status::kVelocityStep ||
         status == Status::kAccelerationLimit || status == Status::kJerkLimit ||
         status == Status::kNotAtRest;
}

template <class Space>
bool TrajectoryStream<Space>::open(const char* path, bool partial, std::uint64_t hash,
                                   Trajectory<Space>& store) {
  window_ = &store;
  return reader_.open(path, partial, hash, refusal_.row) && fill_window();
}

template <class Space>
bool TrajectoryStream<Space>::fill_window() {
  window_->count = 0;
  has_next_ = whole_known_ = false;
  RowResult taken = take(-1);
  for (; taken == RowResult::kWaypoint && window_->count < window_->capacity; taken = take(-1)) {
    note(window_->count);
    window_->set(window_->count++, next_);
    has_next_ = false;
  }
  if (taken == RowResult::kRefused) return false;
  window_->fields = reader_.fields();
  reader_.note_terms(window_->header);
  window_->open = longer_ = taken == RowResult::kWaypoint;
  sender_.begin(window_->count);
  state_ = longer_ ? FeedResult::kMore : FeedResult::kIdle;
  return true;
}

template <class Space>
RowResult TrajectoryStream<Space>::take(int wait_ms) {
  const RowResult taken = reader_.next(next_, refusal_.row, wait_ms);
  has_next_ = taken == RowResult::kWaypoint;
  whole_known_ = whole_known_ || taken == RowResult::kEnd;
  return taken;
}

template <class Space>
bool TrajectoryStream<Space>::may_be_smoothed(bool accepted) const {
  const Interpolation how = window_->interpolation;
  if (!reader_.lines().regular() || !refusal_.row.reason.empty() ||
      (how != Interpolation::kByFields && how != Interpolation::kQuintic))
    return false;
  return accepted ? longer_s() > 0.0 || (reader_.fields() & kVelocityField) == 0
                  : of_derivatives(refusal_.verdict.status);
}

template <class Space>
bool TrajectoryStream<Space>::judge(const AdmissionSettings<Space>& settings,
                                    const SmoothingTolerance& tolerance) {
  const bool accepted = judge_once(settings);
  if (!tolerance.allows() || !may_be_smoothed(accepted)) return accepted;
  // Lines between positions step in velocity, so that a curve is better even if it takes longer.
  const bool lines = accepted && (reader_.fields() & kVelocityField) == 0;
  const double longer = accepted ? longer_s() : kInfinity;
  reader_.run_up_within(Space::peaks(settings.limits));
  if (judge_smoothed(settings, tolerance) && (lines || longer_s() <= longer)) return true;
  // A curve that is near shows what is wrong, which lines between positions may hide.
  const bool curve = refusal_.row.reason.empty() && of_derivatives(refusal_.verdict.status);
  if (curve && !(accepted && longer > 0.0)) return false;
  return restart({}) && judge_once(settings);
}

/// Judges the likeliest curve, then smoother ones. The refusal is that of the first.
template <class Space>
bool TrajectoryStream<Space>::judge_smoothed(const AdmissionSettings<Space>& settings,
                                             const SmoothingTolerance& tolerance) {
  for (int rounding = 0; rounding <= Smoothing::kMostRounding; ++rounding) {
    if (restart({tolerance, rounding}) && judge_once(settings)) return true;
    if (!refusal_.row.reason.empty() || !of_derivatives(refusal_.verdict.status)) return false;
  }
  return restart({tolerance}) && judge_once(settings);
}

template <class Space>
bool TrajectoryStream<Space>::restart(const Smoothing& smoothing) {
  refusal_ = {};
  return reader_.restart(smoothing, refusal_.row) && fill_window();
}

template <class Space>
bool TrajectoryStream<Space>::judge_once(const AdmissionSettings<Space>& settings) {
  if (!judged(judge_.begin(*window_, settings))) return false;
  if (!longer_ || !reader_.lines().regular()) return true;
  if (!judge_parts(settings)) return false;
  judged_hash_ = hash();
  const bool again = reader_.rewind(refusal_.row) && fill_window();
  return changed(false) || (again && !longer_) ? refuse(kChanged) : again;
}

template <class Space>
bool TrajectoryStream<Space>::judge_rest(const AdmissionSettings<Space>& settings) {
  return !longer_ || reader_.lines().regular() || judge_parts(settings);
}

/// Judges all parts behind the first window, which they overwrite.
template <class Space>
bool TrajectoryStream<Space>::judge_parts(const AdmissionSettings<Space>& settings) {
  for (;;) {
    const RowResult taken = has_next_ ? RowResult::kWaypoint : take(-1);
    if (taken == RowResult::kRefused) return false;
    if (taken != RowResult::kWaypoint) return judged(judge_.end(*window_, settings));
    note(judge_.next());
    if (!judged(judge_.append(*window_, next_, settings))) return false;
    has_next_ = false;
  }
}

/// Takes the judge's results so far.
template <class Space>
bool TrajectoryStream<Space>::judged(const Verdict& verdict) {
  if (!verdict.ok()) return refuse(verdict);
  count_ = judge_.count() - reader_.run_ups();
  end_s_ = judge_.end_s();
  return true;
}

template <class Space>
FeedResult TrajectoryStream<Space>::feed(ReferenceClient<Space>& client, int wait_ms) {
  if (state_ != FeedResult::kMore) return state_;
  if (sender_.awaiting()) return FeedResult::kAhead;
  for (;;) {
    if (!has_next_ && !whole_known_) {
      const RowResult taken = take(wait_ms);
      if (taken == RowResult::kRefused && reader_.lines().regular()) return give_up(kChanged);
      if (taken == RowResult::kRefused) return state_ = FeedResult::kRefused;
      const bool starves =
          sender_.sent() - client.needed(*window_) < PartSender<Space>::part_size(*window_);
      if (taken == RowResult::kNotYet)
        return starves && sender_.unsent() > 0 ? send_part(client, false) : FeedResult::kNotYet;
    }
    if (!has_next_) return send_part(client, true);
    const int index = sender_.appended();
    const Verdict verdict = sender_.append(client, *window_, next_);
    if (verdict.status == Status::kWindowFull) return FeedResult::kAhead;
    note(index);
    if (!verdict.ok()) return give_up(verdict);
    has_next_ = false;
    if (sender_.part_full(*window_)) return send_part(client, false);
  }
}

template <class Space>
FeedResult TrajectoryStream<Space>::send_part(ReferenceClient<Space>& client, bool last) {
  if (changed(last)) return give_up(kChanged);
  const Verdict verdict = sender_.flush(client, *window_, last);
  if (!verdict.ok()) return give_up(verdict);
  if (!reader_.lines().regular()) {
    count_ = sender_.sent();
    end_s_ = window_->time_s(sender_.sent() - 1);
  }
  return state_ = last ? FeedResult::kWhole : FeedResult::kMore;
}

template <class Space>
void TrajectoryStream<Space>::answered(const Report& report) {
  if (sender_.answered(report) && !sender_.failed().ok() && state_ != FeedResult::kIdle)
    refuse(sender_.failed());
}

/// True if a file that was judged is not the same any more.
template <class Space>
bool TrajectoryStream<Space>::changed(bool at_end) const {
  if (!reader_.lines().regular()) return false;
  return !reader_.lines().unchanged() || (at_end && hash() != judged_hash_);
}

template <class Space>
void TrajectoryStream<Space>::note(int index) {
  newest_ = index;
  lines_[static_cast<std::size_t>(index % window_->capacity)] = reader_.line();
}

template <class Space>
bool TrajectoryStream<Space>::refuse(const Verdict& verdict) {
  state_ = FeedResult::kRefused;
  refusal_.verdict = verdict;
  if (verdict.waypoint >= 0 && in_window(verdict.waypoint))
    refusal_.line = lines_[static_cast<std::size_t>(verdict.waypoint % window_->capacity)];
  if (verdict.waypoint > 0) refusal_.verdict.waypoint -= reader_.run_ups();
  return false;
}

template <class Space>
bool TrajectoryStream<Space>::refuse(std::string_view reason) {
  state_ = FeedResult::kRefused;
  refusal_.row = {};
  refusal_.row.reason = Message(reason);
  return false;
}

template <class Space>
double TrajectoryStream<Space>::time_s(int waypoint) const {
  const int index = waypoint + reader_.run_ups();
  return in_window(index) ? window_->time_s(index) : kInfinity;
}

template class TrajectoryStream<JointSpace>;
template class TrajectoryStream<TaskSpace>;

}  // namespace tactus
