#include "kernel/reference/admission_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/limit_check.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

/// x^(2/3) for x in (0, 1), from above: Newton on w^3 = x^2. Far from the root a step takes a third
/// off, near it the digits double.
double two_thirds_power(double x) {
  double w = 1.0;
  for (int i = 0; i < 80; ++i) w = (2.0 * w + x * x / (w * w)) / 3.0;
  return w;
}

/// The room `end` as a number of less precision, never above it.
float rounded_down(double room) {
  return room >= 1.0 ? 1.0F : static_cast<float>(std::max(room, 0.0) * (1.0 - 1e-6));
}

/// Room at one end of a segment of T seconds when it is `far` at the other and the rate changes as
/// `a` allows beside what the path itself takes of it, `own`.
template <class Values>
double room_across(double far, const Values& v, const Values& own, const Values& a, double T) {
  double room = 1.0;
  for (std::size_t c = 0; c < v.size(); ++c) {
    const double reach = v[c] * far + 2.0 * T * a[c], need = v[c] + 2.0 * T * own[c];
    if (room * need > reach) room = reach / need;
  }
  return room;
}

/// A path that takes nothing itself; in the mean it helps here and hinders there.
template <class Space>
constexpr typename Space::Levels kNone{};

/// The room on a segment of its own, in parts of equal length.
struct PartRooms {
  static constexpr int kParts = 8;
  std::array<double, kParts> most;
  double least = 1.0;

  /// Calls what(room, x) at both ends x, 0..1, of every part.
  template <class What>
  void for_ends(What what) const {
    for (int i = 0; i < kParts; ++i) {
      for (const int end : {i, i + 1})
        what(most[static_cast<std::size_t>(i)], static_cast<double>(end) / kParts);
    }
  }
  /// Room at the end. Where a segment breaks a limit at its beginning only, a little less there
  /// lets it rise by up to `rise` from there on.
  double at_end(double rise) const {
    const double begin = least - std::min(least, rise) / kParts;
    double room = 1.0;
    for_ends([&](double own, double x) {
      if (x > 0.0) room = std::min(room, (own - begin * (1.0 - x)) / x);
    });
    return room;
  }
  /// Room at the beginning so that a straight line from there to `end` is below it everywhere.
  double at_begin(double end) const {
    double room = 1.0;
    for_ends([&](double own, double x) {
      if (x < 1.0) room = std::min(room, (own - end * x) / (1.0 - x));
    });
    return room;
  }
};

/// A trajectory as admission sees it.
template <class Space>
struct Judge {
  const Trajectory<Space>& trajectory;
  const AdmissionSettings<Space>& settings;
  typename Space::Limits limits = Space::known_limits(trajectory.terms, settings.limits);
  typename Space::Latched terms = Space::anywhere(trajectory.terms, limits);
  typename Space::Peaks all = Space::peaks(limits);
  typename Space::Peaks most = all.reserved(1.0 - settings.stop_reserve);
  // Half of the reserve is for what the law that follows is late.
  typename Space::Peaks slowing = all.reserved(1.0 - 0.5 * settings.stop_reserve);

  typename Space::Measure measure(const typename Space::Segment& segment) const {
    return Space::measure(segment, limits, most);
  }
  double own(const typename Space::Measure& measure) const {
    return own_room(measure.peaks, most, Space::kChannelSize).most;
  }
  /// The half of a segment that ends at place `index`.
  typename Space::Segment half(int index) const {
    const typename Space::Segment segment = trajectory.segment((index + 1) / 2, terms);
    const double T = 0.5 * segment.duration();
    return segment.part(index % 2 == 0 ? T : 0.0, T);
  }
  /// Waypoint k is place 2 k, the middle of the way to it 2 k - 1.
  Shown<float>& room(int index) const {
    Waypoint<Space>& to = trajectory.waypoints[(index + 1) / 2 % trajectory.capacity];
    return index % 2 == 0 ? to.room : to.halfway;
  }
  PartRooms parts(const typename Space::Segment& segment, double least) const {
    PartRooms rooms;
    rooms.least = least;
    rooms.most.fill(1.0);
    const double T = segment.duration() / PartRooms::kParts;
    for (int i = 0; least < 1.0 && i < PartRooms::kParts; ++i)
      rooms.most[static_cast<std::size_t>(i)] =
          std::max(least, own(measure(segment.part(i * T, T))));
    return rooms;
  }
};

}  // namespace

template <int n>
OwnRoom own_room(const MotionPeaks<n>& peaks, const MotionPeaks<n>& limits, int channel_size) {
  OwnRoom own;
  const auto bound = [&](double value, double limit, Status status, std::size_t channel) {
    if (!exceeds(value, limit)) return;
    const double ratio = limit / value;
    const double room = status == Status::kVelocityLimit       ? ratio * ratio
                        : status == Status::kAccelerationLimit ? ratio
                                                               : two_thirds_power(ratio);
    if (room >= own.most) return;
    own.most = room > 0.0 ? room : 0.0;
    own.worst = {status, -1, channel_size * static_cast<int>(channel), value, limit};
  };
  for (std::size_t c = 0; c < peaks.v.size(); ++c) {
    bound(peaks.v[c], limits.v[c], Status::kVelocityLimit, c);
    bound(peaks.a[c], limits.a[c], Status::kAccelerationLimit, c);
    bound(peaks.j[c], limits.j[c], Status::kJerkLimit, c);
  }
  return own;
}

template <class Space>
float set_rooms(const Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings,
                int first, int fresh, int last, double end) {
  const Judge<Space> judge{trajectory, settings};
  const auto write = [&](int index, double room) {
    Shown<float>& now = judge.room(index);
    const float wanted = rounded_down(room);
    if (index < 2 * fresh && wanted <= now) return false;
    now = wanted;
    return true;
  };
  double room = end;
  for (int k = 2 * last; k > 2 * first; --k) {
    const typename Space::Segment half = judge.half(k);
    const typename Space::Measure measure = judge.measure(half);
    const PartRooms own = judge.parts(half, judge.own(measure));
    const double T = half.duration();
    const double rise = room_across(0.0, measure.peaks.v, kNone<Space>, judge.slowing.a, T);
    if (!write(k, std::min(room, own.at_end(rise)))) return 0.0F;
    const double after = static_cast<float>(judge.room(k));
    const double before = room_across(after, measure.peaks.v, measure.slowing, judge.slowing.a, T);
    // Its least room, kept up, needs no slowing down.
    room = std::min(own.at_begin(after), std::max(before, std::min(own.least, after)));
  }
  return rounded_down(room);
}

template <class Space>
double stretch(const Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings,
               int first, int last, float begin) {
  const Judge<Space> judge{trajectory, settings};
  double room = static_cast<double>(begin), longer_s = 0.0;
  for (int k = 2 * first + 1; k <= 2 * last; ++k) {
    const typename Space::Segment half = judge.half(k);
    const double T = half.duration();
    double next = static_cast<float>(judge.room(k));
    if (next > room)
      next = std::min(
          next, room_across(room, judge.measure(half).peaks.v, kNone<Space>, judge.slowing.a, T));
    longer_s += 2.0 * T / (std::sqrt(room) + std::sqrt(next)) - T;
    room = next;
  }
  return longer_s / (trajectory.at(last).time_s - trajectory.at(first).time_s);
}

template OwnRoom own_room(const JointSpace::Peaks&, const JointSpace::Peaks&, int);
template float set_rooms(const Trajectory<JointSpace>&, const AdmissionSettings<JointSpace>&, int,
                         int, int, double);
template double stretch(const Trajectory<JointSpace>&, const AdmissionSettings<JointSpace>&, int,
                        int, float);
template OwnRoom own_room(const TaskSpace::Peaks&, const TaskSpace::Peaks&, int);
template float set_rooms(const Trajectory<TaskSpace>&, const AdmissionSettings<TaskSpace>&, int,
                         int, int, double);
template double stretch(const Trajectory<TaskSpace>&, const AdmissionSettings<TaskSpace>&, int, int,
                        float);

}  // namespace tactus
