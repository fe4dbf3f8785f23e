// Tests trajectories through a window over a real TCP socket, which the server's own thread serves.
// Virtual time waits for the network, or does not.
#include "tests/gateway/server/socket_bench.hpp"
#include "tests/gateway/server/trajectory_parts.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr int kWindow = 512;
constexpr int kWhole_s = tries(600, 60);
constexpr double kTau = 6.28318530717958647692;

/// A path that passes each of its points once: in every 3 s joint 1 swings, and joint 2 goes a step
/// on. At rest between two steps and at both ends.
JointSpace::Point winding(double t, double whole_s) {
  constexpr double kSwing_s = 3.0, kStep = 0.5 / 200.0, kW = kTau / kSwing_s;
  const double steps = std::min(std::floor(t / kSwing_s), std::round(whole_s / kSwing_s));
  const double u = std::min(t, whole_s) - kSwing_s * steps, a = kStep / kSwing_s;
  JointSpace::Point point = swing(u, kSwing_s);
  point.q[1] += steps * kStep + a * (u - std::sin(kW * u) / kW);
  point.dq[1] = a * (1.0 - std::cos(kW * u));
  point.ddq[1] = a * kW * std::sin(kW * u);
  return point;
}

/// Returns the time at which the path passes the value of joint 2, near a time.
double time_of(const JointVector& q, double near_s, double whole_s) {
  double before = near_s - 1e-3, after = near_s + 2e-3;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (before + after);
    (winding(middle, whole_s).q[1] < q[1] ? before : after) = middle;
  }
  return std::min(0.5 * (before + after), whole_s);
}

/// A client that sends a trajectory at 1 kHz by the credit it gets, over a line that holds some
/// segments back; and the cycles meanwhile.
struct Sending {
  SocketBench served;
  SocketClient client;
  int waypoints = 0, sent = 0;
  double whole_s = 0.0;
  std::uint32_t goal = 0;
  Random random{18};
  bool delays = false;
  std::uint32_t until = 0;  // the cycle in which the line goes on
  std::size_t segment = 0;  // bytes of a Part
  int held_back = 0, segments = 0;
  int waits = 0;  // since the last cycle

  double place_s = 0.0, worst_rad = 0.0, longest_step_s = 0.0;
  int moving = 0, standing = 0;  // cycles on the path

  void begin(double its_whole_s) {
    whole_s = its_whole_s;
    waypoints = static_cast<int>(std::lround(1e3 * whole_s)) + 1;
    served.start();
    client.join(served);
    client.lease(0, 60000);
    goal = client.send(ask::kBegin, tactus::begin(kWindow));
    client.flush(client.queued);
    while (client.credit == 0) client.wait(1);
  }
  void send_parts() {
    while (sent < waypoints && client.credit >= std::min(60, waypoints - sent)) {
      const int count = std::min(60, waypoints - sent);
      const std::size_t before = client.queued;
      client.send(ask::kPart,
                  part(sent, sent + count, [this](double t) { return winding(t, whole_s); }));
      if (segment == 0) segment = client.queued - before;
      client.credit -= count;
      sent += count;
      if (sent == waypoints) client.send(ask::kEnd);
    }
  }
  /// Passes segments on, three out of ten of them later than the window lasts.
  void pass_on() {
    if (!delays) return client.flush(client.queued);
    while (client.queued > 0 && served.bench.cycles >= until) {
      client.flush(std::min(segment, client.queued));
      ++segments;
      if (random.uniform(0.0, 1.0) >= 0.3) continue;
      ++held_back;
      until = served.bench.cycles + static_cast<std::uint32_t>(random.uniform(800.0, 1600.0));
    }
  }
  /// Waypoints that the generator has ahead of the motion. Those of a whole path are negative.
  int ahead() const {
    const auto& channel = served.bench.channel;
    int most = 0;
    for (std::size_t i = 0; i < kStores; ++i)
      most = std::max(most, std::abs(channel.known[i].load()) - channel.needed[i].load());
    return most;
  }
  /// Waypoints that the motion has yet to pass, but for those of the present segment.
  int left() const { return waypoints - static_cast<int>(std::lround(1e3 * place_s)) - 2; }
  /// True if a cycle would find what a network without delay had brought: half the window or all
  /// that is left, or a part of it that the generator has yet to take.
  bool caught_up() const {
    return delays || !on_path(phase()) || ahead() >= std::min(kWindow / 2, left()) ||
           (served.bench.channel.requests.size() > 0 && takes_requests());
  }
  /// True if the server has fetched enough reports for the generator to take a request.
  bool takes_requests() const {
    return served.bench.channel.reports.space() >= kReportsPerRequest + kControls;
  }
  MotionPhase phase() const { return served.bench.generator.phase(); }

  /// One cycle; the reference is somewhere on the path, not before where it was.
  void cycle() {
    served.bench.step();
    if (phase() != MotionPhase::kFollowing && phase() != MotionPhase::kStarving) return;
    const JointSpace::Point& reference = served.bench.generator.reference();
    const double place = time_of(reference.q, place_s, whole_s);
    const JointVector error = reference.q - winding(place, whole_s).q;
    worst_rad = std::max(worst_rad, error.cwiseAbs().maxCoeff());
    longest_step_s = std::max({longest_step_s, place - place_s, place_s - place});
    place_s = place;
    ++(phase() == MotionPhase::kStarving ? standing : moving);
  }
  void run() {
    while (client.finals[goal] == 0) {
      client.read();
      send_parts();
      pass_on();
      if (caught_up()) {
        cycle();
        waits = 0;
      } else {
        client.wait(1);
        assert_true(++waits < 20'000);  // the server grants or sends nothing more
      }
    }
  }
};

Sending& fresh() {
  static Sending* sending = nullptr;
  delete sending;
  sending = new Sending;
  return *sending;
}

// Proves GW-6.

void ten_minutes_at_one_kilohertz_pass_a_tcp_socket_without_a_gap(void**) {
  Sending& sending = fresh();
  sending.begin(kWhole_s);
  sending.run();
  assert_int_equal(sending.waypoints, 1000 * kWhole_s + 1);
  assert_int_equal(sending.client.outcome[sending.goal], 10);  // SUCCEEDED
  assert_int_equal(sending.client.starved, 0);
  assert_int_equal(sending.standing, 0);
  assert_in_range(sending.moving, 1000 * kWhole_s - 5, 1000 * kWhole_s + 5);
  ASSERT_NEAR(sending.place_s, kWhole_s, 2e-3);
  assert_true(sending.longest_step_s < 1.1e-3);
  ASSERT_NEAR(sending.worst_rad, 0.0, 1e-6);
}

void a_network_that_holds_segments_back_longer_than_the_window_lasts_stops_the_arm_on_its_path(
    void**) {
  Sending& sending = fresh();
  sending.delays = true;
  sending.begin(60.0);
  sending.run();
  assert_in_range(sending.held_back, sending.segments / 5, sending.segments * 2 / 5);
  assert_true(sending.held_back > 200);
  assert_int_equal(sending.client.outcome[sending.goal], 10);  // SUCCEEDED
  assert_true(sending.client.starved > 100);
  assert_true(sending.standing > 10'000);
  ASSERT_NEAR(sending.place_s, 60.0, 2e-3);
  assert_true(sending.longest_step_s < 1.1e-3);  // no waypoint is left out
  ASSERT_NEAR(sending.worst_rad, 0.0, 1e-6);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(ten_minutes_at_one_kilohertz_pass_a_tcp_socket_without_a_gap),
      cmocka_unit_test(
          a_network_that_holds_segments_back_longer_than_the_window_lasts_stops_the_arm_on_its_path),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
