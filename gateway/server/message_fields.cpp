#include "gateway/server/message_fields.hpp"

#include <cmath>

#include "gateway/server/codec.hpp"
#include "kernel/core/digital_outputs.hpp"

namespace tactus {
namespace {

constexpr int kPose = 7, kTwist = 6;

int fields_in(Fields fields) {
  return ((fields & kVelocityField) != 0 ? 1 : 0) + ((fields & kAccelerationField) != 0 ? 1 : 0) +
         ((fields & kEffortField) != 0 ? 1 : 0);
}

Pose pose_of(const double* n) {
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}};
}

/// Takes the next vector if the field is given.
template <class Vector>
void take(const double*& numbers, bool given, Vector& vector) {
  if (!given) return;
  vector = Eigen::Map<const Vector>(numbers);
  numbers += vector.size();
}

/// True if a repeated field has all its numbers, or none and may be left out.
bool complete(const char* field, int count, int whole, bool required, Message& why) {
  if (count == whole || (count == 0 && !required)) return true;
  why << field << " has " << count << " numbers instead of " << whole;
  return false;
}

template <class Vector, std::size_t N>
void read(const double (&field)[N], pb_size_t count, Vector& vector) {
  if (count > 0) vector = Eigen::Map<const Vector>(field);
}

template <class Vector, std::size_t N>
void write(const Vector& vector, double (&field)[N], pb_size_t& count) {
  if (vector.allFinite()) set_numbers(field, count, vector.data(), static_cast<int>(vector.size()));
}

Message channel_field(pb_size_t channel, const char* field) {
  Message text("Chunk.channels[");
  text << static_cast<int>(channel) << "]." << field;
  return text;
}

/// Lists the outputs of a mask as "0 1 2".
void list(std::uint32_t mask, Message& text) {
  for (int i = 0; i < kMostOutputs; ++i)
    if ((mask >> i & 1u) != 0) text << " " << i;
}

Status judge_output(std::uint32_t output, std::uint32_t offered, const char* field, Message& why) {
  if (output < kMostOutputs && (offered >> output & 1u) != 0) return Status::kOk;
  why << field << ": ";
  if (offered == 0) {
    why << "the pipeline puts out no digital outputs; wire [robot] outputs to its generator";
    return Status::kNotOffered;
  }
  why << "there is no digital output " << static_cast<double>(output) << "; take one of";
  list(offered, why);
  return Status::kNotOffered;
}

}  // namespace

TrajectoryTerms terms_of(bool given, const tactus_Terms& from) {
  TrajectoryTerms terms;
  if (!given) return terms;
  terms.held = from.held_joints;
  terms.motion = from.motion_frame;
  terms.wrench = from.wrench_frame;
  return terms;
}

template <>
int numbers_in_message<JointSpace>(Fields fields) {
  return kDof * (1 + fields_in(fields));
}
template <>
int numbers_in_message<TaskSpace>(Fields fields) {
  return kPose + kTwist * fields_in(fields);
}

template <>
JointSpace::Point point_of<JointSpace>(const double* numbers, Fields fields) {
  JointSpace::Point point;
  take(numbers, true, point.q);
  take(numbers, (fields & kVelocityField) != 0, point.dq);
  take(numbers, (fields & kAccelerationField) != 0, point.ddq);
  take(numbers, (fields & kEffortField) != 0, point.tau);
  return point;
}
template <>
TaskSpace::Point point_of<TaskSpace>(const double* numbers, Fields fields) {
  TaskSpace::Point point;
  point.x = pose_of(numbers);
  numbers += kPose;
  take(numbers, (fields & kVelocityField) != 0, point.v);
  take(numbers, (fields & kAccelerationField) != 0, point.a);
  take(numbers, (fields & kEffortField) != 0, point.h);
  return point;
}

bool read_point(const tactus_JointPoint& from, JointSpace::Point& point, Message& why) {
  if (!complete("JointPoint.q", from.q_count, kDof, true, why) ||
      !complete("JointPoint.dq", from.dq_count, kDof, false, why) ||
      !complete("JointPoint.ddq", from.ddq_count, kDof, false, why) ||
      !complete("JointPoint.tau", from.tau_count, kDof, false, why))
    return false;
  read(from.q, from.q_count, point.q);
  read(from.dq, from.dq_count, point.dq);
  read(from.ddq, from.ddq_count, point.ddq);
  read(from.tau, from.tau_count, point.tau);
  return true;
}

bool read_point(const tactus_TaskPoint& from, TaskSpace::Point& point, Message& why) {
  if (!complete("TaskPoint.pose", from.pose_count, kPose, true, why) ||
      !complete("TaskPoint.twist", from.twist_count, kTwist, false, why) ||
      !complete("TaskPoint.acceleration", from.acceleration_count, kTwist, false, why) ||
      !complete("TaskPoint.wrench", from.wrench_count, kTwist, false, why))
    return false;
  point.x = pose_of(from.pose);
  read(from.twist, from.twist_count, point.v);
  read(from.acceleration, from.acceleration_count, point.a);
  read(from.wrench, from.wrench_count, point.h);
  return true;
}

void write_point(const JointSpace::Point& point, tactus_JointPoint& to) {
  write(point.q, to.q, to.q_count);
  write(point.dq, to.dq, to.dq_count);
  write(point.ddq, to.ddq, to.ddq_count);
  write(point.tau, to.tau, to.tau_count);
}

void write_point(const TaskSpace::Point& point, tactus_TaskPoint& to) {
  write_pose(point.x, to.pose);
  to.pose_count = kPose;
  write(point.v, to.twist, to.twist_count);
  write(point.a, to.acceleration, to.acceleration_count);
  write(point.h, to.wrench, to.wrench_count);
}

void write_pose(const Pose& pose, double* numbers) {
  const double all[kPose] = {pose.p.x(), pose.p.y(), pose.p.z(), pose.r.w(),
                             pose.r.x(), pose.r.y(), pose.r.z()};
  std::memcpy(numbers, all, sizeof all);
}

Status judge_outputs(std::uint32_t mask, std::uint32_t offered, const char* field, Message& why) {
  for (std::uint32_t i = 0; i < kMostOutputs; ++i)
    if ((mask >> i & 1u) != 0) TRY(judge_output(i, offered, field, why));
  return Status::kOk;
}

Status judge_channels(const tactus_Chunk& from, std::uint32_t offered, Message& why) {
  std::uint32_t seen = 0;
  for (pb_size_t k = 0; k < from.channels_count; ++k) {
    const tactus_Channel& channel = from.channels[k];
    TRY(judge_output(channel.output, offered, channel_field(k, "output").c_str(), why));
    const std::uint32_t bit = std::uint32_t{1} << channel.output;
    if ((seen & bit) != 0) {
      why << channel_field(k, "output") << ": output " << static_cast<int>(channel.output)
          << " has a channel before this one; give it one";
      return Status::kBadValue;
    }
    seen |= bit;
    if (channel.values_count == from.time_s_count) continue;
    why << channel_field(k, "values") << " has " << static_cast<int>(channel.values_count)
        << " values instead of " << static_cast<int>(from.time_s_count) << "; give one per target";
    return Status::kBadValue;
  }
  if (std::abs(from.outputs_lead_s) <= kLongestLead_s) return Status::kOk;
  why << "Chunk.outputs_lead_s " << from.outputs_lead_s << " s is not from " << -kLongestLead_s
      << " to " << kLongestLead_s << " s; give the latency of the gripper, in s";
  return Status::kBadValue;
}

}  // namespace tactus
