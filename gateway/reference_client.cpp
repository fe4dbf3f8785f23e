#include "gateway/reference_client.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/judge_channels.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

template <class Space>
Trajectory<Space>* ReferenceClient<Space>::acquire() {
  for (std::size_t i = 0; i < away_.size(); ++i) {
    if (away_[i]) continue;
    channel_.stores[i].clear();
    return &channel_.stores[i];
  }
  return nullptr;
}

template <class Space>
Verdict ReferenceClient<Space>::judge_goal(const Feedback<Space>& feedback) const {
  if (tolerances() == nullptr) return {Status::kNotStarted};
  const Verdict near = Space::judge_error(feedback.desired, feedback.actual, tolerances()->goal,
                                          Status::kGoalTolerance);
  const bool measured = Space::rates(feedback.actual).allFinite();
  if (!near.ok() || !measured) return near;
  return judge_stopped<Space>(feedback.actual, tolerances()->stopped_velocity);
}

template <class Space>
Trajectory<Space>* ReferenceClient<Space>::acquire(Fields fields) {
  Trajectory<Space>* const trajectory = acquire();
  if (trajectory == nullptr) return nullptr;
  trajectory->fields = fields;
  trajectory->pack(fields);
  return trajectory;
}

template <class Space>
Verdict ReferenceClient<Space>::admit(Trajectory<Space>& trajectory) const {
  return tactus::admit(trajectory, channel_.settings);
}

template <class Space>
Verdict ReferenceClient<Space>::send(Trajectory<Space>& trajectory, std::uint32_t& id) {
  const std::size_t store = index_of(trajectory);
  if (store >= away_.size() || away_[store]) return {Status::kNoFreeStore};
  Admitted<Space> admitted;
  Verdict verdict = tactus::admit(trajectory, channel_.settings, admitted);
  if (!verdict.ok()) return verdict;
  Request<Space> request;
  request.kind = RequestKind::kTrajectory;
  request.store = static_cast<int>(store);
  channel_.needed[store].store(0, std::memory_order_relaxed);
  channel_.known[store].store(trajectory.count, std::memory_order_relaxed);
  Stream& stream = streams_[store];
  stream.parts.begin(trajectory.count, admitted);
  stream.settled = trajectory.count;
  stream.whole = false;
  verdict = post(request, id);
  away_[store] = verdict.ok();
  return verdict;
}

template <class Space>
Verdict ReferenceClient<Space>::append(const Trajectory<Space>& trajectory,
                                       const Waypoint<Space>& waypoint) {
  const std::size_t store = index_of(trajectory);
  if (store >= away_.size() || !away_[store]) return {Status::kNothingToExtend};
  settle(store);
  PartAccount<Space>& parts = streams_[store].parts;
  if (parts.count() - needed(trajectory) >= trajectory.capacity) return {Status::kWindowFull};
  return parts.append(trajectory, waypoint, channel_.settings);
}

template <class Space>
Verdict ReferenceClient<Space>::flush(const Trajectory<Space>& trajectory, bool last,
                                      std::uint32_t& id) {
  const std::size_t store = index_of(trajectory);
  if (store >= away_.size() || !away_[store]) return {Status::kNothingToExtend};
  settle(store);
  PartAccount<Space>& parts = streams_[store].parts;
  double longer = 0.0;
  Verdict verdict = parts.judge_part(trajectory, last, channel_.settings, longer);
  if (!verdict.ok()) return verdict;
  Request<Space> request;
  request.kind = RequestKind::kAppend;
  request.store = static_cast<int>(store);
  request.count = parts.count();
  request.last = last;
  request.extent = parts.extent();
  verdict = post(request, id);
  if (verdict.ok()) parts.end_part();
  return verdict;
}

/// Raises the rooms of an open trajectory once the generator has taken its new part; not before, as
/// the generator may refuse it.
template <class Space>
void ReferenceClient<Space>::settle(std::size_t store) {
  Stream& stream = streams_[store];
  const int known = channel_.known[store].load(std::memory_order_acquire);
  const int count = std::abs(known);
  const bool whole = known < 0;
  if (!away_[store] || (count == stream.settled && whole == stream.whole)) return;
  const int needed = channel_.needed[store].load(std::memory_order_acquire);
  const Trajectory<Space>& trajectory = channel_.stores[store];
  const float room = set_rooms(trajectory, channel_.settings, needed, stream.settled, count - 1,
                               whole ? 1.0 : 0.0);
  Published<float>& first = trajectory.rooms(needed).room;
  if (room > first) first = room;
  stream.settled = count;
  stream.whole = whole;
}

template <class Space>
Verdict ReferenceClient<Space>::send(const typename Space::Point& point, std::uint32_t& id,
                                     const typename Space::Header& header,
                                     const PointDetails& details) {
  if (!std::isfinite(details.stamp_s)) return {Status::kReferenceNotFinite};
  const typename Space::Limits limits = Space::known_limits(header, channel_.settings.limits);
  typename Space::Point placed = Space::placed(point, Space::anywhere(header, limits));
  if constexpr (kStreams)
    static_cast<void>(Space::saturate(placed, limits));  // the generator reports it
  const Verdict verdict = judge_online<Space>(placed, limits);
  if (!verdict.ok()) return verdict;
  Request<Space> request;
  request.kind = RequestKind::kPoint;
  request.point = point;
  request.header = header;
  if constexpr (kStreams) request.details = details;
  return post(request, id);
}

template <class Space>
bool ReferenceClient<Space>::poll_feedback(Feedback<Space>& feedback) {
  if (!channel_.feedback.take(feedback)) return false;
  if constexpr (kStreams) history_.push(feedback);
  return true;
}

/// Sends a control only if there is space for its report: see kControls.
template <class Space>
Verdict ReferenceClient<Space>::control(ControlKind kind, std::uint32_t& id, double rate) {
  const auto free = std::find(unanswered_.begin(), unanswered_.end(), std::uint32_t{0});
  if (free == unanswered_.end() || !channel_.controls.post({next_id_, kind, rate}))
    return {Status::kMailboxFull};
  *free = id = next_id_++;
  return {};
}

template <class Space>
Verdict ReferenceClient<Space>::post(Request<Space> request, std::uint32_t& id) {
  request.id = next_id_;
  if (!channel_.requests.post(request)) return {Status::kMailboxFull};
  id = next_id_++;
  return {};
}

template <class Space>
bool ReferenceClient<Space>::poll(Report& report) {
  for (std::size_t store = 0; store < away_.size(); ++store) settle(store);
  if (!channel_.reports.take(report)) return false;
  if (report.id != 0)
    std::replace(unanswered_.begin(), unanswered_.end(), report.id, std::uint32_t{0});
  if (report.store >= 0) away_[static_cast<std::size_t>(report.store)] = false;
  return true;
}

template class ReferenceClient<JointSpace>;
template class ReferenceClient<TaskSpace>;

}  // namespace tactus
