#include "gateway/reference_client.hpp"

namespace tactus {

Trajectory<JointSpace>* ReferenceClient::acquire() {
  for (std::size_t i = 0; i < away_.size(); ++i) {
    if (!away_[i]) return &channel_.stores[i];
  }
  return nullptr;
}

Verdict ReferenceClient::judge(const Trajectory<JointSpace>& trajectory) const {
  return admit(trajectory, channel_.settings);
}

Verdict ReferenceClient::send(Trajectory<JointSpace>& trajectory, std::uint32_t& id) {
  const auto store = static_cast<std::size_t>(&trajectory - channel_.stores.data());
  if (store >= away_.size() || away_[store]) return {Status::kNoFreeStore};
  Verdict verdict = judge(trajectory);
  if (!verdict.ok()) return verdict;
  Request<JointSpace> request;
  request.kind = RequestKind::kTrajectory;
  request.store = static_cast<int>(store);
  verdict = post(request, id);
  away_[store] = verdict.ok();
  return verdict;
}

Verdict ReferenceClient::send(const JointSpace::Point& point, std::uint32_t& id) {
  const Verdict verdict = admit(point, channel_.settings.limits);
  if (!verdict.ok()) return verdict;
  Request<JointSpace> request;
  request.kind = RequestKind::kPoint;
  request.point = point;
  return post(request, id);
}

Verdict ReferenceClient::cancel(std::uint32_t& id) {
  Request<JointSpace> request;
  request.kind = RequestKind::kCancel;
  return post(request, id);
}

Verdict ReferenceClient::post(Request<JointSpace> request, std::uint32_t& id) {
  request.id = next_id_;
  if (!channel_.requests.post(request)) return {Status::kMailboxFull};
  id = next_id_++;
  return {};
}

bool ReferenceClient::poll(Report& report) {
  if (!channel_.reports.take(report)) return false;
  const bool final = report.outcome != Outcome::kStarted;
  if (final && report.store >= 0) away_[static_cast<std::size_t>(report.store)] = false;
  return true;
}

}  // namespace tactus
