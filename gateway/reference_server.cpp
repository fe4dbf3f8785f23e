#include "gateway/reference_server.hpp"

#include <type_traits>

namespace tactus {
namespace {

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
  sent_ = false;
  part_ = 0;
  awaited_ = 0;
  failed_ = {};
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
    const auto waypoint = read_waypoint<Space>(waypoints, trajectory_->fields);
    if (!sent_ && trajectory_->count < trajectory_->capacity) {
      trajectory_->set(trajectory_->count++, waypoint);
      continue;
    }
    Verdict verdict = sent_ ? Verdict() : send_open();
    if (verdict.ok()) verdict = append(waypoint);
    if (verdict.status == Status::kWindowFull) return {};
    if (!verdict.ok()) return verdict;
  }
  return {};
}

template <class Space>
Verdict ReferenceServer<Space>::send_open() {
  trajectory_->open = true;
  const Verdict verdict = client_.send(*trajectory_, id_);
  sent_ = verdict.ok();
  return verdict;
}

template <class Space>
Verdict ReferenceServer<Space>::append(const Waypoint<Space>& waypoint) {
  if (!failed_.ok()) return failed_;
  if (awaited_ != 0) return {Status::kWindowFull};
  const Verdict verdict = client_.append(*trajectory_, waypoint);
  if (!verdict.ok()) return verdict;
  ++part_;
  return part_ < trajectory_->capacity / kParts ? Verdict() : flush(false);
}

template <class Space>
Verdict ReferenceServer<Space>::flush(bool last) {
  const Verdict verdict = client_.flush(*trajectory_, last, awaited_);
  if (verdict.ok()) part_ = 0;
  return verdict;
}

template <class Space>
Verdict ReferenceServer<Space>::end(std::uint32_t& id) {
  if (trajectory_ == nullptr) return {Status::kNothingToExtend};
  if (awaited_ != 0) return {Status::kWindowFull};
  Verdict verdict = failed_;
  if (verdict.ok()) verdict = sent_ ? flush(true) : client_.send(*trajectory_, id_);
  id = id_;
  trajectory_ = nullptr;
  return verdict;
}

template <class Space>
Verdict ReferenceServer<Space>::point(const TrajectoryTerms& terms, ByteReader& numbers,
                                      std::uint32_t& id) {
  typename Space::Header header;
  const Verdict verdict = place(terms, header);
  if (!verdict.ok()) return verdict;
  const auto waypoint = read_waypoint<Space>(numbers, terms.fields);
  return numbers.done() ? client_.send(waypoint.point, id, header) : Verdict{Status::kWireFormat};
}

template <class Space>
Verdict ReferenceServer<Space>::control(ControlKind kind, double rate, std::uint32_t& id) {
  switch (kind) {
    case ControlKind::kCancel: return client_.cancel(id);
    case ControlKind::kOverride: return client_.set_override(rate, id);
    case ControlKind::kPause: return client_.pause(id);
    case ControlKind::kResume: return client_.resume(id);
  }
  return {Status::kWireFormat};
}

/// The answers to parts are the server's; a refusal of one is that of its trajectory.
template <class Space>
bool ReferenceServer<Space>::poll() {
  Report report;
  bool any = false;
  while (count_ < kKept && client_.poll(report)) {
    any = true;
    if (awaited_ != 0 && report.id == awaited_) {
      awaited_ = 0;
      if (report.outcome == Outcome::kRefused) failed_ = report.verdict;
      continue;
    }
    reports_[static_cast<std::size_t>((first_ + count_++) % kKept)] = report;
  }
  return any;
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
