#include "gateway/server/reference_requests.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "gateway/server/message_fields.hpp"

namespace tactus {
namespace {

Fields fields_of(const tactus_Begin& begin) {
  return static_cast<Fields>((begin.velocities ? kVelocityField : 0) |
                             (begin.accelerations ? kAccelerationField : 0) |
                             (begin.efforts ? kEffortField : 0));
}

constexpr std::uint32_t kLongestVelocity_ms = 10'000;

ChunkBase base_of(std::uint32_t base) {
  return base == tactus_Chunk_Base_COMMANDED  ? ChunkBase::kCommanded
         : base == tactus_Chunk_Base_MEASURED ? ChunkBase::kMeasured
                                              : ChunkBase::kAbsolute;
}

/// The position and velocity fields of a message for one space: size of one position and velocity,
/// the values, and their counts.
struct SpaceFields {
  int position, velocity;
  const double *positions, *velocities;
  int position_count, velocity_count;
};

SpaceFields fields_in(const tactus_Chunk& chunk, const JointSpace&) {
  return {kDof, kDof, chunk.q, chunk.dq, chunk.q_count, chunk.dq_count};
}
SpaceFields fields_in(const tactus_Chunk& chunk, const TaskSpace&) {
  return {7, 6, chunk.pose, chunk.twist, chunk.pose_count, chunk.twist_count};
}
const double* rates_in(const tactus_Velocity& velocity, int& count, const JointSpace&) {
  count = velocity.dq_count;
  return velocity.dq;
}
const double* rates_in(const tactus_Velocity& velocity, int& count, const TaskSpace&) {
  count = velocity.twist_count;
  return velocity.twist;
}

/// Reads the targets of a chunk; false if their numbers are not complete.
template <class Space>
bool read_targets(const tactus_Chunk& from, double origin_s, Chunk<Space>& chunk) {
  const SpaceFields given = fields_in(from, Space());
  chunk.count = 0;
  chunk.velocities = given.velocity_count > 0;
  if (from.time_s_count == 0 || given.position_count != given.position * from.time_s_count ||
      (chunk.velocities && given.velocity_count != given.velocity * from.time_s_count))
    return false;
  for (int i = 0; i < from.time_s_count; ++i) {
    typename Space::Point target = point_of<Space>(given.positions + i * given.position, Fields{0});
    if (chunk.velocities)
      Space::rates(target) =
          Eigen::Map<const typename Space::Rates>(given.velocities + i * given.velocity);
    if (!chunk.add(origin_s + from.time_s[i], target)) return false;
  }
  return true;
}

bool read_target(const tactus_Point& from, JointSpace::Point& point, Message& why) {
  return read_point(from.target.joint, point, why);
}
bool read_target(const tactus_Point& from, TaskSpace::Point& point, Message& why) {
  return read_point(from.target.task, point, why);
}

}  // namespace

bool ReferenceRequests::takes(pb_size_t kind) {
  switch (kind) {
    case tactus_ToServer_point_tag:
    case tactus_ToServer_velocity_tag:
    case tactus_ToServer_chunk_tag:
    case tactus_ToServer_begin_tag:
    case tactus_ToServer_part_tag:
    case tactus_ToServer_end_tag: return true;
    default: return false;
  }
}

Reply ReferenceRequests::execute(const tactus_ToServer& message, const Origin& from,
                                 std::int64_t now_ns) {
  const auto& asked = message.request;
  switch (message.which_request) {
    case tactus_ToServer_point_tag: return point(asked.point, message.client_ns, from);
    case tactus_ToServer_velocity_tag: return velocity(asked.velocity, from);
    case tactus_ToServer_chunk_tag: return chunk(asked.chunk, from, now_ns);
    case tactus_ToServer_begin_tag: return begin(asked.begin, from, now_ns);
    case tactus_ToServer_part_tag: return part(asked.part, from);
    default: return end(from);
  }
}

/// Within an epoch only increasing sequences count; they may wrap around.
Reply ReferenceRequests::judge_place(Connection& connection, bool given,
                                     const tactus_Place& place) {
  if (!given) return {};
  const bool newer = connection.epoch != place.epoch ||
                     static_cast<std::int32_t>(place.sequence - connection.sequence) > 0;
  if (place.epoch != references_.epoch()) return reply({Status::kEpochVoid});
  if (!newer) {
    ++dropped_;
    return {Status::kEpochVoid, "a duplicate, or older than the newest: dropped"};
  }
  connection.canceled = false;
  connection.epoch = place.epoch;
  connection.sequence = place.sequence;
  return {};
}

Reply ReferenceRequests::judge_void(const tactus_ToServer& message,
                                    const Connection& connection) const {
  const auto& asked = message.request;
  bool placed = false;
  switch (message.which_request) {
    case tactus_ToServer_point_tag: placed = asked.point.has_place; break;
    case tactus_ToServer_velocity_tag: placed = asked.velocity.has_place; break;
    case tactus_ToServer_chunk_tag: placed = asked.chunk.has_place; break;
    case tactus_ToServer_begin_tag: break;
    default: return {};
  }
  if (connection.behind)
    return {Status::kEpochVoid,
            "sent before a cancel or a stop was in force; send it again after the Report of that"};
  if (connection.canceled && !placed)
    return {Status::kEpochVoid,
            "another client has canceled it; take the lease again to go on, or name the epoch"};
  return {};
}

Reply ReferenceRequests::judge_fields(const tactus_ToServer& message) const {
  const auto& asked = message.request;
  const tactus_Terms* terms = nullptr;
  int joints = 0, poses = 0;  // numbers of either kind
  switch (message.which_request) {
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
    return {Status::kBadValue, references_.takes_poses()
                                   ? "the pipeline takes poses: leave q and dq empty"
                                   : "the pipeline takes joints: leave pose and twist empty"};
  if (terms == nullptr || terms->held_joints == 0) return {};
  if (references_.takes_poses())
    return {Status::kBadValue, "Terms.held_joints: the pipeline takes poses; leave it 0"};
  if (terms->held_joints >> kDof == 0) return {};
  Message text("Terms.held_joints has bits beyond the ");
  return {Status::kBadValue, text << kDof << " joints of the robot; bit 0 is the first joint"};
}

Reply ReferenceRequests::point(const tactus_Point& given, std::int64_t client_ns,
                               const Origin& from) {
  const bool poses = given.which_target == tactus_Point_task_tag;
  if (given.which_target == 0)
    return {Status::kBadValue, "a Point has neither joint nor task; give one"};
  if (!references_.takes_any() || poses != references_.takes_poses())
    return {Status::kNotOffered, references_.takes_poses()
                                     ? "the pipeline takes poses: give Point.task"
                                     : "the pipeline takes joints: give Point.joint"};
  Message why;
  const std::int64_t sent_ns = given.sent_ns != 0 ? given.sent_ns : client_ns;
  const PointDetails details = {{given.outputs, given.outputs_mask},
                                sent_ns == 0 ? kNoStamp : 1e-9 * static_cast<double>(sent_ns),
                                from.session};
  const Status offered =
      judge_outputs(given.outputs_mask, pipeline_.robot.offered, "Point.outputs_mask", why);
  if (offered != Status::kOk) return {offered, why};
  const Reply placed = judge_place(clients_.at(from.slot), given.has_place, given.place);
  if (placed.status != Status::kOk) return placed;
  const TrajectoryTerms terms = terms_of(given.has_terms, given.terms);
  return references_.with_intake([&](auto& intake) -> Reply {
    typename std::decay_t<decltype(intake)>::Space::Point point;
    if (!read_target(given, point, why)) return {Status::kBadValue, why};
    return reply(intake.point(from, terms, point, details));
  });
}

Reply ReferenceRequests::velocity(const tactus_Velocity& given, const Origin& from) {
  if (!references_.takes_any()) return {Status::kNotOffered, "the pipeline takes no references"};
  if (given.timeout_ms < 1 || given.timeout_ms > kLongestVelocity_ms)
    return {Status::kBadValue, "Velocity.timeout_ms is not from 1 to 10000"};
  return references_.with_intake([&](auto& intake) -> Reply {
    using Space = typename std::decay_t<decltype(intake)>::Space;
    int count = 0;
    const double* const rates = rates_in(given, count, Space());
    Velocity<Space> velocity;
    if (count != static_cast<int>(velocity.rates.size()))
      return {Status::kBadValue, references_.takes_poses()
                                     ? "Velocity.twist needs six numbers"
                                     : "Velocity.dq needs a number for each joint"};
    const Reply placed = judge_place(clients_.at(from.slot), given.has_place, given.place);
    if (placed.status != Status::kOk) return placed;
    velocity.rates = Eigen::Map<const typename Space::Rates>(rates);
    velocity.timeout_s = 1e-3 * given.timeout_ms;
    return reply(intake.velocity(from, terms_of(given.has_terms, given.terms), velocity));
  });
}

/// The times of a chunk by the clock of the generator.
Reply ReferenceRequests::read_chunk_time(const tactus_Chunk& given, const Connection& connection,
                                         std::int64_t now_ns, double& origin_s,
                                         double& observed_s) const {
  const bool on_arrival = given.time == tactus_Chunk_Time_ON_ARRIVAL;
  Verdict verdict = cycles_.clock().time_of(on_arrival ? connection.received_ns : given.origin_ns,
                                            now_ns, origin_s);
  if (given.base != tactus_Chunk_Base_NONE && given.observed_ns > now_ns)
    return {Status::kStampRange,
            "Chunk.observed_ns is in the future; give the server's time of the observation, as "
            "State.server_ns has it"};
  if (verdict.ok() && given.base != tactus_Chunk_Base_NONE)
    verdict = cycles_.clock().time_of(given.observed_ns, now_ns, observed_s);
  return reply(verdict);
}

/// Every target is as near to now as a stamp must be: a curve through one that is not has no finite
/// derivatives.
Verdict ReferenceRequests::judge_targets(const tactus_Chunk& given, double origin_s,
                                         std::int64_t now_ns) const {
  const double range_s = static_cast<double>(kStampRange_ns) * 1e-9;
  for (int i = 0; i < given.time_s_count; ++i) {
    const double ahead_s = origin_s + given.time_s[i] - cycles_.clock().time_s(now_ns);
    if (!(std::abs(ahead_s) <= range_s)) return {Status::kStampRange, -1, -1, ahead_s, range_s};
  }
  return {};
}

Reply ReferenceRequests::chunk(const tactus_Chunk& given, const Origin& from, std::int64_t now_ns) {
  Connection& connection = clients_.at(from.slot);
  if (given.time > tactus_Chunk_Time_ON_ARRIVAL || given.base > tactus_Chunk_Base_MEASURED)
    return {Status::kBadValue, "Chunk.time or Chunk.base is unknown"};
  if (given.has_crossfade_s && !(given.crossfade_s >= 0.0 && given.crossfade_s <= kLongestFade_s))
    return {Status::kBadValue, "Chunk.crossfade_s is not from 0 to 0.3"};
  if (!references_.takes_any()) return {Status::kNotOffered, "the pipeline takes no references"};
  double origin_s = 0.0, observed_s = 0.0;
  Reply why = read_chunk_time(given, connection, now_ns, origin_s, observed_s);
  if (why.status == Status::kOk) why = reply(judge_targets(given, origin_s, now_ns));
  if (why.status == Status::kOk) {
    Message text;
    const Status status = judge_channels(given, pipeline_.robot.offered, text);
    if (status != Status::kOk) why = {status, text};
  }
  if (why.status == Status::kOk) why = judge_place(connection, given.has_place, given.place);
  if (why.status != Status::kOk) return why;
  return references_.with_intake([&](auto& intake) -> Reply {
    auto& chunk = chunk_of(typename std::decay_t<decltype(intake)>::Space());
    if (!read_targets(given, origin_s, chunk))
      return {Status::kBadValue,
              "Chunk: there must be a position, and a velocity or none, for each of its times, in "
              "the joints or as poses as the pipeline takes them"};
    read_channels(given, chunk);
    chunk.stamped = given.time == tactus_Chunk_Time_ABSOLUTE;
    chunk.sender = from.session;
    chunk.ends = given.ends;
    chunk.fade_s = given.has_crossfade_s ? given.crossfade_s : kUsualFade_s;
    chunk.base = base_of(given.base);
    chunk.observed_s = observed_s;
    const Verdict verdict = intake.chunk(from, terms_of(given.has_terms, given.terms), chunk);
    if (verdict.status == Status::kNoFreeStore)
      return {Status::kNoFreeStore,
              "eight chunks are in force or wait for their first target; send the next one later"};
    return reply(verdict);
  });
}

Reply ReferenceRequests::begin(const tactus_Begin& given, const Origin& from, std::int64_t now_ns) {
  if (!references_.takes_any() || given.poses != references_.takes_poses())
    return {Status::kNotOffered, references_.takes_poses()
                                     ? "the pipeline takes poses: set Begin.poses"
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
  if (wrap == Wrap::kNearest && !references_.wraps())
    return {Status::kNotOffered, references_.takes_poses()
                                     ? "the pipeline takes poses: leave out Begin.wrap"
                                     : "every joint of this robot has stops: leave out "
                                       "Begin.wrap"};
  if (given.start_ns != 0) {
    const Verdict verdict = cycles_.clock().time_of(given.start_ns, now_ns, terms.start_s);
    if (!verdict.ok()) return reply(verdict);
  }
  return reply(references_.with_intake([&](auto& intake) {
    const Verdict verdict = intake.begin(from, terms);
    if (verdict.ok()) intake.take_angles(wrap, cycles_.present_joints(), terms.held);
    return verdict;
  }));
}

Reply ReferenceRequests::part(const tactus_Part& part, const Origin& from) {
  return references_.with_intake([&](auto& intake) -> Reply {
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

Reply ReferenceRequests::end(const Origin& from) {
  return reply(references_.with_intake([&from](auto& intake) { return intake.end(from); }));
}

}  // namespace tactus
