// The bench of the tests of streamed trajectory files: a client and a generator with a window of a
// chosen size, and files of smooth random motions between two rests.
#pragma once

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>

#include "gateway/trajectory/trajectory_stream.hpp"
#include "kernel/math/so3.hpp"
#include "kernel/streams/generator_streams.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr int kMostRows = 2048;
inline constexpr double kStreamPeriod_s = 1e-3;

/// A file of this process; each test that uses it writes it again.
inline const char* stream_file() {
  static char path[64];
  std::snprintf(path, sizeof path, "/tmp/tactus-stream-%d.csv", static_cast<int>(getpid()));
  return path;
}

inline JointSpace::Point home_of(const JointSpace&) {
  const JointLimits limits;
  JointSpace::Point home;
  home.q = 0.5 * (limits.q_min + limits.q_max);
  return home;
}
inline TaskSpace::Point home_of(const TaskSpace&) {
  TaskSpace::Point home;
  home.x = {{0.4, 0.1, 0.5}, exp_so3({3.0, 0.2, -0.1})};
  return home;
}

/// A generator and its client; static, because it is too large for a stack.
template <class Space>
struct StreamBench {
  ChannelMemory<Space> channel;
  std::array<Waypoint<Space>, kMostRows> waypoints;
  ReferenceClient<Space> client{channel};
  ReferenceGenerator<Space> generator;
  typename ReferenceGenerator<Space>::Params params;
  TrajectoryStream<Space> stream;
  std::uint32_t id = 0;
  Outcome outcome = Outcome::kStarted;  ///< of the trajectory
  int cycles = 0;

  /// Opens a file with a window of `capacity` waypoints. False: refused.
  bool open(int capacity, bool exact = false, Interpolation how = Interpolation::kByFields,
            const char* path = stream_file()) {
    channel.settings.period_s = kStreamPeriod_s;
    for (Trajectory<Space>& store : channel.stores) {
      store.waypoints = waypoints.data();
      store.capacity = capacity;
    }
    Trajectory<Space>* const store = client.acquire();
    if (!stream.open(path, false, 0, *store)) return false;
    store->interpolation = how;
    store->exact = exact;
    if (!stream.judge(client.settings())) return false;
    ASSERT_OK(generator.start(channel, params, home_of(Space())));
    return client.send(*store, id).ok();
  }
  /// Feeds what there is space for, runs one cycle and takes the reports.
  FeedResult step() {
    const FeedResult fed = stream.feed(client, 0);
    ASSERT_OK(generator.step(kStreamPeriod_s, generator.reference()));
    ++cycles;
    Report report;
    while (client.poll(report)) {
      stream.answered(report);
      if (report.id == id) outcome = report.outcome;
    }
    return fed;
  }
  const typename Space::Point& out() const { return generator.reference(); }
};

/// A motion that begins and ends at rest, and moves by less than the limits allow:
/// `amplitude` sin^3 (pi swings t / duration) along `along`.
struct Swing {
  double amplitude, swings, duration_s;
  std::array<double, 7> along;

  explicit Swing(Random& random, double largest, double slowest_s)
      : amplitude(random.uniform(0.2, 1.0) * largest),
        swings(1 + random.below(4)),
        duration_s(swings * random.uniform(1.0, 1.5) * slowest_s) {
    for (double& part : along) part = random.uniform(-1.0, 1.0);
  }
  /// Value, first and second derivative at t.
  std::array<double, 3> at(double t) const {
    const double w = swings * 3.14159265358979323846 / duration_s;
    const double s = std::sin(w * t), c = std::cos(w * t);
    return {amplitude * s * s * s, amplitude * 3.0 * w * s * s * c,
            amplitude * 3.0 * w * w * (2.0 * s * c * c - s * s * s)};
  }
};

inline void set(const Swing& swing, double t, JointSpace::Point& point) {
  const auto [x, v, a] = swing.at(t);
  point = home_of(JointSpace());
  for (int j = 0; j < kDof; ++j) {
    const double part = swing.along[static_cast<std::size_t>(j)];
    point.q[j] += part * x;
    point.dq[j] = part * v;
    point.ddq[j] = part * a;
  }
}
inline void set(const Swing& swing, double t, TaskSpace::Point& point) {
  const auto [x, v, a] = swing.at(t);
  const TaskSpace::Point home = home_of(TaskSpace());
  Vector6 along;
  for (int i = 0; i < 6; ++i) along[i] = swing.along[static_cast<std::size_t>(i)];
  point.x = {home.x.p + along.head<3>() * x, exp_so3(along.tail<3>() * x) * home.x.r};
  point.v = along * v;
  point.a = along * a;
}

inline void write_header(std::FILE* file, Fields fields, const JointSpace&) {
  constexpr const char* kGroups[][2] = {{"q", "rad"}, {"dq", "rad_s"}, {"ddq", "rad_s2"}};
  const int groups = fields & kAccelerationField ? 3 : fields & kVelocityField ? 2 : 1;
  std::fprintf(file, "time_s");
  for (int g = 0; g < groups; ++g) {
    for (int j = 0; j < kDof; ++j)
      std::fprintf(file, ",%s%d_%s", kGroups[g][0], j + 1, kGroups[g][1]);
  }
  std::fprintf(file, "\n");
}
inline void write_header(std::FILE* file, Fields fields, const TaskSpace&) {
  std::fprintf(file, "time_s,x_m,y_m,z_m,qw,qx,qy,qz");
  if (fields & kVelocityField)
    std::fprintf(file, ",vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s");
  if (fields & kAccelerationField)
    std::fprintf(file, ",ax_m_s2,ay_m_s2,az_m_s2,alphax_rad_s2,alphay_rad_s2,alphaz_rad_s2");
  std::fprintf(file, "\n");
}

/// Writes the numbers of a vector, each as the same bits come back.
template <class Vector>
void write_numbers(std::FILE* file, const Vector& numbers) {
  for (int i = 0; i < static_cast<int>(numbers.size()); ++i)
    std::fprintf(file, ",%.17g", numbers[i]);
}
inline void write_row(std::FILE* file, Fields fields, double t, const JointSpace::Point& point) {
  std::fprintf(file, "%.17g", t);
  write_numbers(file, point.q);
  if (fields & kVelocityField) write_numbers(file, point.dq);
  if (fields & kAccelerationField) write_numbers(file, point.ddq);
  std::fprintf(file, "\n");
}
inline void write_row(std::FILE* file, Fields fields, double t, const TaskSpace::Point& point) {
  std::fprintf(file, "%.17g", t);
  write_numbers(file, point.x.p);
  const Eigen::Quaterniond& r = point.x.r;
  std::fprintf(file, ",%.17g,%.17g,%.17g,%.17g", r.w(), r.x(), r.y(), r.z());
  if (fields & kVelocityField) write_numbers(file, point.v);
  if (fields & kAccelerationField) write_numbers(file, point.a);
  std::fprintf(file, "\n");
}

/// Writes a swing of `rows` waypoints to the stream's file; damage(row, time, point) may change
/// one.
template <class Space, class Damage>
void write_swing(const Swing& swing, int rows, Fields fields, Damage damage) {
  std::FILE* file = std::fopen(stream_file(), "wb");
  assert_non_null(file);
  write_header(file, fields, Space());
  for (int i = 0; i < rows; ++i) {
    double t = swing.duration_s * i / (rows - 1);
    typename Space::Point point;
    set(swing, t, point);
    if (i == rows - 1) point = point.at_rest();
    damage(i, t, point);
    write_row(file, fields, t, point);
  }
  std::fclose(file);
}
template <class Space>
void write_swing(const Swing& swing, int rows, Fields fields) {
  write_swing<Space>(swing, rows, fields, [](int, double&, typename Space::Point&) {});
}

inline int remove_stream_file(void**) {
  std::remove(stream_file());
  return 0;
}

}  // namespace tactus
