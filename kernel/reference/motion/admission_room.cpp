#include "kernel/reference/motion/admission_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/limit_check.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {
namespace {

/// Returns x^(2/3) for x in (0, 1), from above, by Newton on w^3 = x^2. Far from the root a step
/// removes a third, near it the number of digits doubles.
double two_thirds_power(double x) {
  double w = 1.0;
  for (int i = 0; i < 80; ++i) w = (2.0 * w + x * x / (w * w)) / 3.0;
  return w;
}

/// Returns the room in single precision, never rounded up.
float rounded_down(double room) {
  return room >= 1.0 ? 1.0F : static_cast<float>(std::max(room, 0.0) * (1.0 - 1e-6));
}

/// Returns the room at one end of a segment of T seconds with the room `far` at the other. The rate
/// changes by the part of the acceleration limit `a` that the path itself, with `own`, leaves.
template <class Values>
double room_across(double far, const Values& v, const Values& own, const Values& a, double T) {
  double room = 1.0;
  for (std::size_t c = 0; c < v.size(); ++c) {
    const double reach = v[c] * far + 2.0 * T * a[c], need = v[c] + 2.0 * T * own[c];
    if (room * need > reach) room = reach / need;
  }
  return room;
}

/// A path that takes no acceleration itself; on average it helps as much as it hinders.
template <class Space>
constexpr typename Space::Levels kNone{};

/// The room of a segment by itself, in parts of equal duration.
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
  /// Returns a room for the beginning of a segment that is a little below its least. Where the
  /// segment breaks a limit at its beginning only, the room can then rise by up to `rise` after it.
  double low_begin(double rise) const { return least - std::min(least, rise) / kParts; }
  /// Returns the room at the end for which the straight line from `begin` stays within all parts.
  double at_end(double begin) const {
    double room = 1.0;
    for_ends([&](double own, double x) {
      if (x > 0.0) room = std::min(room, (own - begin * (1.0 - x)) / x);
    });
    return room;
  }
  /// Returns the room at the beginning for which the straight line to `end` stays within all parts.
  double at_begin(double end) const {
    double room = 1.0;
    for_ends([&](double own, double x) {
      if (x < 1.0) room = std::min(room, (own - end * x) / (1.0 - x));
    });
    return room;
  }
};

/// A trajectory with the limits and the placement that admission uses for it.
template <class Space>
struct Judge {
  const Trajectory<Space>& trajectory;
  const AdmissionSettings<Space>& settings;
  typename Space::Limits limits = Space::known_limits(trajectory.header, settings.limits);
  typename Space::Placement placement = Space::anywhere(trajectory.header, limits);
  typename Space::Peaks all = Space::peaks(limits);
  typename Space::Peaks most = all.reserved(1.0 - settings.stop_reserve);
  // Half of the reserve is for the delay of the path law.
  typename Space::Peaks slowing = all.reserved(1.0 - 0.5 * settings.stop_reserve);

  typename Space::Measure measure(const typename Space::Segment& segment) const {
    return Space::measure(segment, limits, most);
  }
  double own(const typename Space::Measure& measure) const {
    return own_room(measure.peaks, most, Space::kChannelSize).most;
  }
  /// Returns the half of a segment that ends at place `index`.
  typename Space::Segment half(int index) const {
    const typename Space::Segment segment = trajectory.segment((index + 1) / 2, placement);
    const double T = 0.5 * segment.duration();
    return segment.part(index % 2 == 0 ? T : 0.0, T);
  }
  /// The room at place `index`: waypoint k is place 2 k, the middle of the way to it 2 k - 1.
  Published<float>& room(int index) const {
    WaypointRooms& to = trajectory.rooms((index + 1) / 2);
    return index % 2 == 0 ? to.room : to.halfway;
  }
  /// Sets the room at place `index`; false if it `only_rises` and would not.
  bool write(int index, double value, bool only_rises) const {
    Published<float>& now = room(index);
    const float wanted = rounded_down(value);
    if (only_rises && wanted <= now) return false;
    now = wanted;
    return true;
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
  double room = end;
  for (int k = 2 * last; k > 2 * first; --k) {
    const typename Space::Segment half = judge.half(k);
    const typename Space::Measure measure = judge.measure(half);
    const PartRooms own = judge.parts(half, judge.own(measure));
    const double T = half.duration();
    const double rise = room_across(0.0, measure.peaks.v, kNone<Space>, judge.slowing.a, T);
    // The room published for the beginning stays valid.
    const double begin = k <= 2 * fresh ? static_cast<double>(static_cast<float>(judge.room(k - 1)))
                                        : own.low_begin(rise);
    if (!judge.write(k, std::min(room, own.at_end(begin)), k < 2 * fresh)) return 0.0F;
    const double after = static_cast<float>(judge.room(k));
    const double before = room_across(after, measure.peaks.v, measure.slowing, judge.slowing.a, T);
    // At the least room of the segment no slowing down is needed.
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
  return longer_s / (trajectory.time_s(last) - trajectory.time_s(first));
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
