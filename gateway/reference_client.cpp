#include "gateway/reference_client.hpp"

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {

template <class Space>
Trajectory<Space>* ReferenceClient<Space>::acquire() {
  for (std::size_t i = 0; i < away_.size(); ++i) {
    if (!away_[i]) return &channel_.stores[i];
  }
  return nullptr;
}

template <class Space>
Verdict ReferenceClient<Space>::judge(Trajectory<Space>& trajectory) const {
  return admit(trajectory, channel_.settings);
}

template <class Space>
Verdict ReferenceClient<Space>::send(Trajectory<Space>& trajectory, std::uint32_t& id) {
  const auto store = static_cast<std::size_t>(&trajectory - channel_.stores.data());
  if (store >= away_.size() || away_[store]) return {Status::kNoFreeStore};
  Verdict verdict = judge(trajectory);
  if (!verdict.ok()) return verdict;
  Request<Space> request;
  request.kind = RequestKind::kTrajectory;
  request.store = static_cast<int>(store);
  verdict = post(request, id);
  away_[store] = verdict.ok();
  return verdict;
}

template <class Space>
Verdict ReferenceClient<Space>::send(const typename Space::Point& point, std::uint32_t& id) {
  const Verdict verdict = Space::judge(point, channel_.settings.limits);
  if (!verdict.ok()) return verdict;
  Request<Space> request;
  request.kind = RequestKind::kPoint;
  request.point = point;
  return post(request, id);
}

template <class Space>
Verdict ReferenceClient<Space>::set_override(double rate, std::uint32_t& id) {
  Request<Space> request;
  request.kind = RequestKind::kOverride;
  request.rate = rate;
  return post(request, id);
}

template <class Space>
Verdict ReferenceClient<Space>::ask(RequestKind kind, std::uint32_t& id) {
  Request<Space> request;
  request.kind = kind;
  return post(request, id);
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
  if (!channel_.reports.take(report)) return false;
  if (report.store >= 0) away_[static_cast<std::size_t>(report.store)] = false;
  return true;
}

template class ReferenceClient<JointSpace>;
template class ReferenceClient<TaskSpace>;

}  // namespace tactus
