#include "sim_plant/ur/programs/trajectory_points.hpp"

#include <cmath>

#include "hal/ur/protocol.hpp"
#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {
namespace {

/// Returns a pose that is given directly or by joint positions.
Frame frame(const Vector6& values, bool joints, const Motion& motion) {
  return joints ? forward(values) * motion.tool() : Frame::of(values);
}

/// Finds the place of the integer that the text assigns to `variable`. A list of URScript that was
/// read from a socket begins with a count, so its elements are one place later.
void find_place(std::string_view text, std::string_view variable, std::size_t& place) {
  double element = 0.0;
  if (!number_after(text, variable, element)) return;
  if (element >= 1.0 && element <= static_cast<double>(kTrajectoryInts))
    place = static_cast<std::size_t>(element) - 1;
}

PointFormat::Places find_places(std::string_view text, PointFormat::Places places) {
  find_place(text, "velocity = raw_point[", places.v);
  find_place(text, "acceleration = raw_point[", places.a);
  return places;
}

void find_scale(std::string_view text, std::string_view variable, double& scale) {
  double value = 0.0;
  if (number_after(text, variable, value) && value >= 1.0) scale = value;
}

constexpr double kFastest = 6.283185, kDeceleration = 15.0;  // rad/s, rad/s^2
constexpr double kStopping_s = kFastest / kDeceleration;
constexpr double kShortestStep_s = 1e-5;

}  // namespace

Vector6 six_numbers(const TrajectoryPoint& point, std::size_t first, double scale) {
  Vector6 values;
  for (int i = 0; i < 6; ++i) values[i] = point[first + static_cast<std::size_t>(i)] / scale;
  return values;
}

PointFormat find_point_format(std::string_view text) {
  PointFormat format;
  format.moves = format.circles = find_places(text, format.moves);
  const std::size_t circle = text.find("== MOTION_TYPE_MOVEC");
  if (circle != std::string_view::npos)
    format.circles = find_places(text.substr(circle), format.moves);
  find_scale(text, "MULT_time = ", format.time_scale);
  find_scale(text, "MULT_velacc = ", format.rate_scale);
  return format;
}

bool is_optimove(std::int32_t type) {
  return type == kPointOptimoveJ || type == kPointOptimoveL || type == kPointOptimoveJPose ||
         type == kPointOptimoveLJoints;
}

bool is_move(std::int32_t type) {
  return (type >= kPointMoveJ && type <= kPointMoveC) ||
         (type >= kPointMoveJPose && type <= kPointMoveCPoseJoints);
}

bool read_move(const TrajectoryPoint& point, const PointFormat& format, const Machine& machine,
               Move& move) {
  const Motion& motion = machine.motion;
  const Vector6 target = six_numbers(point, 0), second = six_numbers(point, 6);
  const auto set_speed = [&](const PointFormat::Places& places) {
    move.v = point[places.v] / kFixedPoint;
    move.a = point[places.a] / kFixedPoint;
  };
  set_speed(format.moves);
  move.t = point[18] / format.time_scale;
  move.r = point[19] / format.time_scale;
  const std::int32_t type = point[20];
  switch (type) {
    case kPointMoveJ: move.q = target; return true;
    case kPointMoveJPose:
      return inverse(Frame::of(target), motion.tool(), point[14] != 0 ? second : motion.q(),
                     move.q);
    case kPointMoveL:
    case kPointMoveLJoints:
      move.kind = Move::Kind::kL;
      move.target = frame(target, type == kPointMoveLJoints, motion);
      return true;
    case kPointMoveP:
    case kPointMovePJoints:
      move.kind = Move::Kind::kP;
      move.t = 0.0;  // movep has none
      move.target = frame(target, type == kPointMovePJoints, motion);
      return true;
    case kPointMoveC:
    case kPointMoveCJoints:
    case kPointMoveCJointsPose:
    case kPointMoveCPoseJoints:
      move.kind = Move::Kind::kC;
      set_speed(format.circles);
      move.t = 0.0;
      move.fixed = point[14] != 0;
      // The names give the type of the end first.
      move.via = frame(second, type == kPointMoveCJoints || type == kPointMoveCPoseJoints, motion);
      move.target =
          frame(target, type == kPointMoveCJoints || type == kPointMoveCJointsPose, motion);
      return true;
    default: return false;
  }
}

void SplineRun::start(const Joints& q, const Joints& q_end, const Joints& dq_end,
                      const Joints& ddq_end, double duration_s, bool quintic, bool last) {
  const double T = duration_s, T2 = T * T, T3 = T2 * T;
  const Joints way = q_end - q;
  c_.fill(Joints::Zero());
  c_[1] = dq_;
  if (quintic) {
    c_[2] = 0.5 * ddq_;
    c_[3] = (20.0 * way - 3.0 * ddq_ * T2 + ddq_end * T2 - 12.0 * dq_ * T - 8.0 * dq_end * T) /
            (2.0 * T3);
    c_[4] =
        (-30.0 * way + 3.0 * ddq_ * T2 - 2.0 * ddq_end * T2 + 16.0 * dq_ * T + 14.0 * dq_end * T) /
        (2.0 * T3 * T);
    c_[5] = (12.0 * way - ddq_ * T2 + ddq_end * T2 - 6.0 * dq_ * T - 6.0 * dq_end * T) /
            (2.0 * T3 * T2);
  } else {
    c_[2] = (3.0 * way - 2.0 * dq_ * T - dq_end * T) / T2;
    c_[3] = (-2.0 * way + dq_ * T + dq_end * T) / T3;
  }
  duration_s_ = T;
  time_s_ = 0.0;
  scale_ = 1.0;
  last_ = last;
  slowing_ = false;
  phase_ = Phase::kSteps;
}

Joints SplineRun::speed(double t) const {
  Joints sum = Joints::Zero();
  for (int k = 5; k >= 1; --k) sum = sum * t + k * c_[static_cast<std::size_t>(k)];
  return sum;
}

Joints SplineRun::acceleration(double t) const {
  Joints sum = Joints::Zero();
  for (int k = 5; k >= 2; --k) sum = sum * t + k * (k - 1) * c_[static_cast<std::size_t>(k)];
  return sum;
}

bool SplineRun::too_fast_to_stop(double left_s, double cycle_s) const {
  const double allowed = kFastest - (kStopping_s - (left_s - cycle_s)) * kDeceleration;
  return speed(time_s_ + cycle_s).cwiseAbs().maxCoeff() > allowed;
}

void SplineRun::step(double to_s, double step_s, Motion& motion) {
  time_s_ = to_s;
  const Joints before = dq_;
  dq_ = scale_ * speed(to_s);
  ddq_ = acceleration(to_s);
  if (step_s < kShortestStep_s) return;
  motion.speed_j(dq_, (dq_ - before).cwiseAbs().maxCoeff() / step_s, step_s);
}

bool SplineRun::command(Motion& motion, double cycle_s) {
  const double left_s = duration_s_ - time_s_;
  if (phase_ == Phase::kSteps) {
    if (left_s > cycle_s + 1e-9) {
      if (last_ && !slowing_ && left_s <= kStopping_s && too_fast_to_stop(left_s, cycle_s)) {
        slowing_ = true;
        slowing_s_ = left_s + cycle_s;
      }
      if (slowing_) scale_ = left_s / slowing_s_;
      step(time_s_ + cycle_s * scale_, cycle_s, motion);
      return true;
    }
    phase_ = slowing_ ? Phase::kSlowing : Phase::kLast;
  }
  if (phase_ == Phase::kSlowing) {
    if (left_s >= kShortestStep_s) {
      scale_ = left_s / slowing_s_;
      step(time_s_ + cycle_s * scale_, cycle_s, motion);
      return true;
    }
    scale_ = 0.0;
    phase_ = Phase::kLast;
  }
  if (phase_ == Phase::kLast) {
    phase_ = Phase::kDone;
    step(duration_s_, left_s, motion);
    return motion.busy();
  }
  return false;
}

}  // namespace tactus::ur
