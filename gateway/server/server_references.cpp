// Server: the references of its clients.
#include <algorithm>
#include <type_traits>

#include "gateway/server/message_outputs.hpp"
#include "gateway/server/message_points.hpp"
#include "gateway/server/server.hpp"
#include "gateway/verdict_text.hpp"

namespace tactus {
namespace {

Fields fields_of(const tactus_Begin& begin) {
  return static_cast<Fields>((begin.velocities ? kVelocityField : 0) |
                             (begin.accelerations ? kAccelerationField : 0) |
                             (begin.efforts ? kEffortField : 0));
}

template <class Space>
constexpr bool kPoses = std::is_same_v<Space, TaskSpace>;

}  // namespace

Reply Server::reply(const Verdict& verdict) const {
  if (verdict.ok()) return {};
  Message text =
      describe(verdict, takes_poses() ? VerdictAxes::kTip : VerdictAxes::kJoints, kInfinity);
  Reply reply(verdict.status, text << remedy(verdict));
  reply.verdict = verdict;
  return reply;
}

/// Of one epoch only increasing sequences count, also those that wrap around.
Reply Server::judge_place(int slot, bool given, const tactus_Place& place) {
  if (!given) return {};
  Connection& connection = at(slot);
  const bool newer = connection.epoch != place.epoch ||
                     static_cast<std::int32_t>(place.sequence - connection.sequence) > 0;
  if (place.epoch != epoch_) return reply({Status::kEpochVoid});
  if (!newer) {
    ++dropped_;
    return {Status::kEpochVoid, "a duplicate, or older than the newest: dropped"};
  }
  connection.canceled = false;
  connection.epoch = place.epoch;
  connection.sequence = place.sequence;
  return {};
}

/// True while a cancel or a stop of a client is not yet in force.
bool Server::ending() const {
  const auto stops = [](const Order& order) {
    return order.id != 0 && order.what == CycleOrder::kStop;
  };
  return std::any_of(orders_.begin(), orders_.end(), stops) ||
         (takes_poses() ? poses_.canceling() : joints_.canceling());
}

/// What was sent before a cancel or a stop was in force is void, whatever place it names. After a
/// cancel of another client, the owner must show that it knows.
Reply Server::judge_void(int slot) const {
  const auto& asked = request_.request;
  bool placed = false;
  switch (request_.which_request) {
    case tactus_ToServer_point_tag: placed = asked.point.has_place; break;
    case tactus_ToServer_velocity_tag: placed = asked.velocity.has_place; break;
    case tactus_ToServer_chunk_tag: placed = asked.chunk.has_place; break;
    case tactus_ToServer_begin_tag: break;
    default: return {};
  }
  if (at(slot).behind)
    return {Status::kEpochVoid,
            "sent before a cancel or a stop was in force; send it again after the Report of that"};
  if (at(slot).canceled && !placed)
    return {Status::kEpochVoid,
            "another client has canceled it; take the lease again to go on, or name the epoch"};
  return {};
}

/// Refuses what does not belong into a message for this robot and pipeline.
Reply Server::judge_fields() const {
  const auto& asked = request_.request;
  const tactus_Terms* terms = nullptr;
  int joints = 0, poses = 0;  // numbers of either kind
  switch (request_.which_request) {
    case tactus_ToServer_point_tag:
      if (asked.point.has_terms) terms = &asked.point.terms;
      break;
    case tactus_ToServer_begin_tag:
      if (asked.begin.has_terms) terms = &asked.begin.terms;
      break;
    case tactus_ToServer_velocity_tag:
      if (asked.velocity.has_terms) terms = &asked.velocity.terms;
      joints = asked.velocity.dq_count;
      poses = asked.velocity.twist_count;
      break;
    case tactus_ToServer_chunk_tag:
      if (asked.chunk.has_terms) terms = &asked.chunk.terms;
      joints = asked.chunk.q_count + asked.chunk.dq_count;
      poses = asked.chunk.pose_count + asked.chunk.twist_count;
      break;
    default: return {};
  }
  if (joints > 0 && poses > 0)
    return {Status::kBadValue, takes_poses()
                                   ? "the pipeline takes poses: leave q and dq empty"
                                   : "the pipeline takes joints: leave pose and twist empty"};
  if (terms == nullptr || terms->held_joints == 0) return {};
  if (takes_poses())
    return {Status::kBadValue, "Terms.held_joints: the pipeline takes poses; leave it 0"};
  if (terms->held_joints >> kDof == 0) return {};
  Message text("Terms.held_joints has bits beyond the ");
  return {Status::kBadValue, text << kDof << " joints of the robot; bit 0 is the first joint"};
}

Reply Server::point(int slot, const Origin& from) {
  const tactus_Point& given = request_.request.point;
  const bool poses = given.which_target == tactus_Point_task_tag;
  if (given.which_target == 0)
    return {Status::kBadValue, "a Point has neither joint nor task; give one"};
  if (!takes_references() || poses != takes_poses())
    return {Status::kNotOffered, takes_poses() ? "the pipeline takes poses: give Point.task"
                                               : "the pipeline takes joints: give Point.joint"};
  Message why;
  const std::int64_t sent_ns = given.sent_ns != 0 ? given.sent_ns : request_.client_ns;
  const PointDetails details = {{given.outputs, given.outputs_mask},
                                sent_ns == 0 ? kNoStamp : 1e-9 * static_cast<double>(sent_ns),
                                from.session};
  const Status offered =
      judge_outputs(given.outputs_mask, setup_.loaded->robot.offered, "Point.outputs_mask", why);
  if (offered != Status::kOk) return {offered, why};
  const Reply placed = judge_place(slot, given.has_place, given.place);
  if (placed.status != Status::kOk) return placed;
  const TrajectoryTerms terms = terms_of(given.has_terms, given.terms);
  if (poses) {
    TaskSpace::Point point;
    if (!read_point(given.target.task, point, why)) return {Status::kBadValue, why};
    return reply(poses_.point(from, terms, point, details));
  }
  JointSpace::Point point;
  if (!read_point(given.target.joint, point, why)) return {Status::kBadValue, why};
  return reply(joints_.point(from, terms, point, details));
}

Reply Server::begin(const Origin& from, std::int64_t now_ns) {
  const tactus_Begin& given = request_.request.begin;
  if (!takes_references() || given.poses != takes_poses())
    return {Status::kNotOffered, takes_poses() ? "the pipeline takes poses: set Begin.poses"
                                               : "the pipeline takes joints, no poses"};
  TrajectoryTerms terms = terms_of(given.has_terms, given.terms);
  terms.poses = given.poses;
  terms.fields = fields_of(given);
  terms.interpolation = static_cast<Interpolation>(given.interpolation);
  if (name(terms.interpolation) == nullptr)
    return {Status::kBadValue, "Begin.interpolation is unknown"};
  terms.exact = given.exact;
  terms.check = given.check;
  terms.window = static_cast<int>(std::min<std::uint32_t>(given.window, kMostWaypoints));
  const auto wrap = static_cast<Wrap>(given.wrap);
  if (given.wrap > static_cast<std::uint32_t>(Wrap::kNearest))
    return {Status::kBadValue, "Begin.wrap is unknown"};
  if (wrap == Wrap::kNearest && !wraps())
    return {Status::kNotOffered, takes_poses() ? "the pipeline takes poses: leave out Begin.wrap"
                                               : "every joint of this robot has stops: leave out "
                                                 "Begin.wrap"};
  if (given.start_ns != 0) {
    const Verdict verdict = clock_.time_of(given.start_ns, now_ns, terms.start_s);
    if (!verdict.ok()) return reply(verdict);
  }
  return reply(with_intake([&](auto& intake) {
    const Verdict verdict = intake.begin(from, terms);
    if (verdict.ok()) intake.take_angles(wrap, present_joints(), terms.held);
    return verdict;
  }));
}

/// The reference of the joints, where they are measured without one, or infinity before the first
/// cycle.
JointVector Server::present_joints() const {
  if (!seen_) return JointVector::Constant(kInfinity);
  return (newest_.has & CycleSnapshot::kJointReference) != 0 ? newest_.q_d : newest_.q;
}

Reply Server::part(const Origin& from) {
  const tactus_Part& part = request_.request.part;
  return with_intake([&](auto& intake) -> Reply {
    using Space = typename std::decay_t<decltype(intake)>::Space;
    if (!intake.comes(from)) return reply({Status::kNothingToExtend});
    const int numbers = numbers_in_message<Space>(intake.fields());
    Reply why;
    if (part.numbers_count != part.time_s_count * numbers) {
      why = {Status::kBadValue, "Part.numbers has another count than its times and fields say"};
    } else if (part.time_s_count > intake.credit(from)) {
      why = {Status::kWindowFull, "more waypoints than there is credit for; wait for Credit"};
    }
    if (why.status != Status::kOk) {
      intake.refuse(from, {why.status});
      return why;
    }
    for (int i = 0; i < part.time_s_count; ++i) {
      Waypoint<Space> waypoint;
      waypoint.time_s = part.time_s[i];
      waypoint.point = point_of<Space>(part.numbers + i * numbers, intake.fields());
      intake.take(waypoint);
    }
    return {};
  });
}

Reply Server::end(const Origin& from) {
  return reply(with_intake([&from](auto& intake) { return intake.end(from); }));
}

}  // namespace tactus
