#include "gateway/reference_server.hpp"

#include <algorithm>
#include <type_traits>

namespace tactus {
namespace {

/// Waypoints in a window: two of the segment that is passed, and two ahead.
constexpr int kLeastWindow = 4;

/// Finds the pose that a name means; the base frame, null, for none. False: no pose has it.
bool find_pose(const PortTable& ports, std::string_view name, const Pose*& pose) {
  pose = nullptr;
  if (name.empty()) return true;
  const PortEntry* const port = ports.find(name);
  if (port == nullptr || port->quantity != Quantity::kPose) return false;
  pose = static_cast<const Pose*>(port->value);
  return true;
}

}  // namespace

template <class Space>
Verdict ReferenceServer<Space>::place(const TrajectoryTerms& terms,
                                      typename Space::Header& header) const {
  if constexpr (std::is_same_v<Space, JointSpace>) {
    if (!terms.motion.empty() || !terms.wrench.empty()) return {Status::kNotOffered};
    header.held = terms.held;
  } else if (!find_pose(ports_, terms.motion, header.motion) ||
             !find_pose(ports_, terms.wrench, header.wrench)) {
    return {Status::kUnknownPort};
  }
  return {};
}

template <class Space>
Verdict ReferenceServer<Space>::begin(const TrajectoryTerms& terms) {
  const bool chosen = terms.interpolation == Interpolation::kMonotone;  // by admission
  trajectory_ = client_.acquire(static_cast<Fields>(terms.fields | (chosen ? kVelocityField : 0)));
  if (trajectory_ == nullptr) return {Status::kNoFreeStore};
  trajectory_->fields = terms.fields;
  trajectory_->interpolation = terms.interpolation;
  trajectory_->exact = terms.exact;
  trajectory_->start_s = terms.start_s;
  if (terms.window > 0)
    trajectory_->capacity = std::min(std::max(terms.window, kLeastWindow), trajectory_->capacity);
  sent_ = false;
  checks_ = terms.check;
  parts_.begin(0);
  return place(terms, trajectory_->header);
}

template <class Space>
Verdict ReferenceServer<Space>::take(ByteReader& waypoints, int count, int& taken) {
  if (trajectory_ == nullptr) return {Status::kNothingToExtend};
  const int numbers = 1 + Space::numbers(trajectory_->fields);
  if (!waypoints.ok() ||
      waypoints.left() != sizeof(double) * static_cast<std::size_t>(count * numbers))
    return {Status::kWireFormat};
  for (taken = 0; taken < count; ++taken) {
    const Verdict verdict = take(read_waypoint<Space>(waypoints, trajectory_->fields));
    if (verdict.status == Status::kWindowFull) return {};
    if (!verdict.ok()) return verdict;
  }
  return {};
}

template <class Space>
Verdict ReferenceServer<Space>::take(const Waypoint<Space>& waypoint) {
  if (trajectory_ == nullptr) return {Status::kNothingToExtend};
  if (!sent_ && trajectory_->count < trajectory_->capacity) {
    trajectory_->set(trajectory_->count++, waypoint);
    return {};
  }
  if (checks_) return check(waypoint);
  Verdict verdict = sent_ ? flush_full() : send_open();
  if (verdict.ok()) verdict = parts_.append(client_, *trajectory_, waypoint);
  if (verdict.ok()) verdict = flush_full();
  return verdict;
}

/// Sends the present part if it is whole. With a full mailbox it is sent before the next waypoint.
template <class Space>
Verdict ReferenceServer<Space>::flush_full() {
  if (!parts_.part_full(*trajectory_)) return {};
  const Verdict verdict = parts_.flush(client_, *trajectory_, false);
  return verdict.status == Status::kMailboxFull ? Verdict() : verdict;
}

template <class Space>
Verdict ReferenceServer<Space>::send_open() {
  trajectory_->open = true;
  const Verdict verdict = client_.send(*trajectory_, id_);
  sent_ = verdict.ok();
  stretch_ = trajectory_->stretch;
  parts_.begin(trajectory_->count);
  return verdict;
}

/// Judges one more waypoint, and before the first that does not fit into the window those in it.
template <class Space>
Verdict ReferenceServer<Space>::check(const Waypoint<Space>& waypoint) {
  Verdict verdict;
  if (!trajectory_->open) {
    trajectory_->open = true;
    verdict = judge_.begin(*trajectory_, client_.settings());
  }
  return verdict.ok() ? judge_.append(*trajectory_, waypoint, client_.settings()) : verdict;
}

template <class Space>
Verdict ReferenceServer<Space>::end_check() {
  const Verdict verdict = trajectory_->open ? judge_.end(*trajectory_, client_.settings())
                                            : judge_.begin(*trajectory_, client_.settings());
  trajectory_ = nullptr;
  stretch_ = judge_.stretch(judge_.end_s());
  return verdict;
}

template <class Space>
Verdict ReferenceServer<Space>::end(std::uint32_t& id) {
  if (trajectory_ == nullptr) return {Status::kNothingToExtend};
  if (checks_) {
    id = 0;
    return end_check();
  }
  if (parts_.awaiting()) return {Status::kWindowFull};
  const Verdict verdict =
      sent_ ? parts_.flush(client_, *trajectory_, true) : client_.send(*trajectory_, id_);
  if (verdict.status == Status::kMailboxFull) return {Status::kWindowFull};
  if (!sent_) stretch_ = trajectory_->stretch;
  id = id_;
  trajectory_ = nullptr;
  return verdict;
}

template <class Space>
Verdict ReferenceServer<Space>::point(const TrajectoryTerms& terms,
                                      const typename Space::Point& point, std::uint32_t& id,
                                      const PointDetails& details) {
  typename Space::Header header;
  const Verdict verdict = place(terms, header);
  return verdict.ok() ? client_.send(point, id, header, details) : verdict;
}

template <class Space>
Verdict ReferenceServer<Space>::point(const TrajectoryTerms& terms, ByteReader& numbers,
                                      std::uint32_t& id) {
  const auto waypoint = read_waypoint<Space>(numbers, terms.fields);
  return numbers.done() ? point(terms, waypoint.point, id) : Verdict{Status::kWireFormat};
}

template <class Space>
Verdict ReferenceServer<Space>::control(ControlKind kind, double rate, std::uint32_t& id) {
  switch (kind) {
    case ControlKind::kCancel: return client_.cancel(id);
    case ControlKind::kOverride: return client_.set_override(rate, id);
    case ControlKind::kPause: return client_.pause(id);
    case ControlKind::kResume: return client_.resume(id);
    case ControlKind::kSlowDown: return client_.slow_down(rate, id);
  }
  return {Status::kWireFormat};
}

/// The answers to parts are the server's; a refusal of one is that of its trajectory.
template <class Space>
bool ReferenceServer<Space>::fetch(Report& report) {
  while (client_.poll(report))
    if (!parts_.answered(report)) return true;
  return false;
}

template <class Space>
bool ReferenceServer<Space>::poll() {
  const int before = count_;
  Report report;
  while (count_ < kKept && fetch(report))
    reports_[static_cast<std::size_t>((first_ + count_++) % kKept)] = report;
  return count_ > before;
}

template <class Space>
Report ReferenceServer<Space>::next() {
  const Report report = reports_[static_cast<std::size_t>(first_)];
  first_ = (first_ + 1) % kKept;
  --count_;
  return report;
}

template class ReferenceServer<JointSpace>;
template class ReferenceServer<TaskSpace>;

}  // namespace tactus
