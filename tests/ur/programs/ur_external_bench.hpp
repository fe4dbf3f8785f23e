// External control, with the control computer's side of its three sockets.
#pragma once

#include "tests/ur/programs/ur_program_bench.hpp"

namespace tactus::ur {

/// A program of the recognised shape; the test omits or adds parts.
struct ExternalText {
  std::string_view cancelled =
      "    socket_send_int(TRAJECTORY_RESULT_CANCELED, \"trajectory_socket\")\n";
  std::string_view spline = "";
  std::string_view behind = "";
};

struct ExternalBench : ProgramBench {
  std::array<char, 4096> text;
  std::size_t size = 0;

  void add(std::string_view part) {
    assert_true(size + part.size() <= text.size());
    part.copy(text.data() + size, part.size());
    size += part.size();
  }
  void start(const ExternalText& parts = {}) {
    start_unconnected(parts);
    run(6);
    for (const std::string_view name :
         {"trajectory_socket", "script_command_socket", "reverse_socket"})
      assert_true(connected(name));
  }
  void start_unconnected(const ExternalText& parts = {}) {
    size = 0;
    add("def external():\n"
        "  def connect_socket_with_retry(ip, port, name):\n"
        "    connected = socket_open(ip, port, name)\n"
        "  end\n"
        "  thread servoThread():\n"
        "    servoj(q, t=steptime, lookahead_time=0.03, gain=2000)\n"
        "  end\n"
        "  def spline_step():\n");
    add(parts.spline);
    add("  end\n"
        "  connect_socket_with_retry(\"10.0.0.7\", 50003, \"trajectory_socket\")\n"
        "  connect_socket_with_retry(\"10.0.0.7\", 50004, \"script_command_socket\")\n"
        "  connect_socket_with_retry(\"10.0.0.7\", 50001, \"reverse_socket\")\n"
        "  while control_mode > MODE_STOPPED:\n"
        "    params = socket_read_binary_integer(8, \"reverse_socket\", read_timeout)\n");
    add(parts.cancelled);
    add("  end\n"
        "  socket_close(\"reverse_socket\")\n"
        "  socket_close(\"trajectory_socket\")\n"
        "  socket_close(\"script_command_socket\")\n");
    add(parts.behind);
    add("end\n");
    upload({text.data(), size});
    run(1);
  }

  void reverse(std::int32_t timeout_ms, ControlMode mode, const Vector6& values = Vector6::Zero()) {
    std::int32_t ints[8] = {timeout_ms};
    for (int i = 0; i < 6; ++i) ints[i + 1] = fixed(values[i]);
    ints[7] = static_cast<std::int32_t>(mode);
    send("reverse_socket", ints, 8);
  }
  /// The same command in every one of `cycles`.
  void reverse_for(int cycles, ControlMode mode, const Vector6& values = Vector6::Zero()) {
    for (int k = 0; k < cycles; ++k) {
      reverse(20, mode, values);
      tick();
    }
  }
  /// Sub-commands are not fixed-point numbers.
  void reverse_raw(std::int32_t timeout_ms, ControlMode mode, std::int32_t first,
                   std::int32_t second = 0) {
    const std::int32_t ints[8] = {timeout_ms, first, second, 0,
                                  0,          0,     0,      static_cast<std::int32_t>(mode)};
    send("reverse_socket", ints, 8);
  }
  void forward(std::int32_t command, std::int32_t number = 0) {
    reverse_raw(0, ControlMode::kForward, command, number);
  }
  void point(const std::array<std::int32_t, 21>& ints) {
    send("trajectory_socket", ints.data(), ints.size());
  }
  void spline_point(const Joints& q, const Joints& dq, const Joints& ddq, double time_s, int type) {
    std::array<std::int32_t, 21> ints{};
    for (std::size_t i = 0; i < 6; ++i) {
      const int k = static_cast<int>(i);
      ints[i] = fixed(q[k]);
      ints[6 + i] = fixed(dq[k]);
      ints[12 + i] = fixed(ddq[k]);
    }
    ints[18] = fixed(time_s);
    ints[19] = type;
    ints[20] = 51;
    point(ints);
  }
  void move_point(const Vector6& target, std::int32_t type, double v, double a,
                  double time_s = 0.0) {
    std::array<std::int32_t, 21> ints{};
    for (std::size_t i = 0; i < 6; ++i) ints[i] = fixed(target[static_cast<int>(i)]);
    ints[12] = fixed(v);
    ints[13] = fixed(a);
    ints[18] = fixed(time_s);
    ints[20] = type;
    point(ints);
  }
  /// The only result received, or -1.
  std::int32_t result() {
    std::int32_t results[4];
    const std::size_t count = received("trajectory_socket", results, 4);
    assert_true(count <= 1);
    return count == 1 ? results[0] : -1;
  }
  /// Runs until a result comes; calls `each` after every cycle.
  template <class Each>
  std::int32_t await_result(int most, Each each) {
    for (int k = 0; k < most; ++k) {
      tick();
      each();
      const std::int32_t value = result();
      if (value >= 0) return value;
    }
    return -1;
  }
  std::int32_t await_result(int most = 2000) {
    return await_result(most, [] {});
  }
};

inline Joints beside(double dq0) {
  Joints q = kStart;
  q[0] += dq0;
  return q;
}

/// A point of a spline beside the start, at rest.
inline void spline_to(ExternalBench& bench, double dq0, double time_s) {
  bench.spline_point(beside(dq0), Joints::Zero(), Joints::Zero(), time_s, 1);
}

/// Asserts that a trajectory of one spline now comes to its end, and nowhere else.
inline void assert_spline_succeeds(ExternalBench& bench, double dq0, double time_s) {
  bench.forward(1, 1);
  spline_to(bench, dq0, time_s);
  assert_int_equal(bench.await_result(), 0);
  ASSERT_NEAR(bench.target()[0], dq0, 1e-3);
}

/// Streams positions of joint 1 that increase by `speed`; returns the last.
inline double stream(ExternalBench& bench, double from, double speed, int cycles) {
  for (int k = 0; k < cycles; ++k) {
    from += speed * kCycle_s;
    bench.reverse(20, ControlMode::kServoJ, beside(from));
    bench.tick();
  }
  return from;
}

}  // namespace tactus::ur
