// Server: chunks and velocities.
#include <cmath>
#include <type_traits>

#include "gateway/server/message_outputs.hpp"
#include "gateway/server/message_points.hpp"
#include "gateway/server/server.hpp"

namespace tactus {
namespace {

constexpr std::uint32_t kLongestVelocity_ms = 10'000;

ChunkBase base_of(std::uint32_t base) {
  return base == tactus_Chunk_Base_COMMANDED  ? ChunkBase::kCommanded
         : base == tactus_Chunk_Base_MEASURED ? ChunkBase::kMeasured
                                              : ChunkBase::kAbsolute;
}

/// The numbers of one space in a message: of a position and of a velocity, all of them and how many
/// there are.
struct Given {
  int position, velocity;
  const double *positions, *velocities;
  int position_count, velocity_count;
};

Given given_in(const tactus_Chunk& chunk, const JointSpace&) {
  return {kDof, kDof, chunk.q, chunk.dq, chunk.q_count, chunk.dq_count};
}
Given given_in(const tactus_Chunk& chunk, const TaskSpace&) {
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
  const Given given = given_in(from, Space());
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

}  // namespace

/// The times of a chunk by the clock of the generator.
Reply Server::read_chunk_time(int slot, std::int64_t now_ns, double& origin_s,
                              double& observed_s) const {
  const tactus_Chunk& given = request_.request.chunk;
  const bool on_arrival = given.time == tactus_Chunk_Time_ON_ARRIVAL;
  Verdict verdict =
      clock_.time_of(on_arrival ? at(slot).received_ns : given.origin_ns, now_ns, origin_s);
  if (given.base != tactus_Chunk_Base_NONE && given.observed_ns > now_ns)
    return {Status::kStampRange,
            "Chunk.observed_ns is in the future; give the server's time of the observation, as "
            "State.server_ns has it"};
  if (verdict.ok() && given.base != tactus_Chunk_Base_NONE)
    verdict = clock_.time_of(given.observed_ns, now_ns, observed_s);
  return reply(verdict);
}

/// Every target is as near to now as a stamp must be: a curve through one that is not has no finite
/// derivatives.
Verdict Server::judge_targets(double origin_s, std::int64_t now_ns) const {
  const tactus_Chunk& given = request_.request.chunk;
  const double range_s = static_cast<double>(kStampRange_ns) * 1e-9;
  for (int i = 0; i < given.time_s_count; ++i) {
    const double ahead_s = origin_s + given.time_s[i] - clock_.time_s(now_ns);
    if (!(std::abs(ahead_s) <= range_s)) return {Status::kStampRange, -1, -1, ahead_s, range_s};
  }
  return {};
}

Reply Server::chunk(int slot, const Origin& from, std::int64_t now_ns) {
  const tactus_Chunk& given = request_.request.chunk;
  if (given.time > tactus_Chunk_Time_ON_ARRIVAL || given.base > tactus_Chunk_Base_MEASURED)
    return {Status::kBadValue, "Chunk.time or Chunk.base is unknown"};
  if (given.has_crossfade_s && !(given.crossfade_s >= 0.0 && given.crossfade_s <= kLongestFade_s))
    return {Status::kBadValue, "Chunk.crossfade_s is not from 0 to 0.3"};
  if (!takes_references()) return {Status::kNotOffered, "the pipeline takes no references"};
  double origin_s = 0.0, observed_s = 0.0;
  Reply why = read_chunk_time(slot, now_ns, origin_s, observed_s);
  if (why.status == Status::kOk) why = reply(judge_targets(origin_s, now_ns));
  if (why.status == Status::kOk) {
    Message text;
    const Status status = judge_channels(given, setup_.loaded->robot.offered, text);
    if (status != Status::kOk) why = {status, text};
  }
  if (why.status == Status::kOk) why = judge_place(slot, given.has_place, given.place);
  if (why.status != Status::kOk) return why;
  return with_intake([&](auto& intake) -> Reply {
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

Reply Server::velocity(int slot, const Origin& from) {
  const tactus_Velocity& given = request_.request.velocity;
  if (!takes_references()) return {Status::kNotOffered, "the pipeline takes no references"};
  if (given.timeout_ms < 1 || given.timeout_ms > kLongestVelocity_ms)
    return {Status::kBadValue, "Velocity.timeout_ms is not from 1 to 10000"};
  return with_intake([&](auto& intake) -> Reply {
    using Space = typename std::decay_t<decltype(intake)>::Space;
    int count = 0;
    const double* const rates = rates_in(given, count, Space());
    Velocity<Space> velocity;
    if (count != static_cast<int>(velocity.rates.size()))
      return {Status::kBadValue, takes_poses() ? "Velocity.twist needs six numbers"
                                               : "Velocity.dq needs a number for each joint"};
    const Reply placed = judge_place(slot, given.has_place, given.place);
    if (placed.status != Status::kOk) return placed;
    velocity.rates = Eigen::Map<const typename Space::Rates>(rates);
    velocity.timeout_s = 1e-3 * given.timeout_ms;
    return reply(intake.velocity(from, terms_of(given.has_terms, given.terms), velocity));
  });
}

}  // namespace tactus
