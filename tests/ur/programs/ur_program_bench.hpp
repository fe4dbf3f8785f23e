// A controller that runs uploaded programs; the test is the control computer on their sockets.
// Bytes are written here as the protocols' tables specify them.
#pragma once

#include <cstdio>
#include <cstring>
#include <initializer_list>

#include "sim_plant/ur/controller/controller.hpp"
#include "sim_plant/ur/programs/runner.hpp"
#include "tests/support/testing.hpp"

namespace tactus::ur {

/// The bytes that the robot sent on port 30001.
struct Said {
  std::array<char, 64 * 1024> bytes;
  std::size_t size = 0;

  bool has(std::string_view text) const { return count(text) > 0; }
  int count(std::string_view text) const {
    const std::string_view all(bytes.data(), size);
    int n = 0;
    for (std::size_t at = all.find(text); at != std::string_view::npos; at = all.find(text, at + 1))
      ++n;
    return n;
  }
  void take(const Outbox& outbox) {
    const std::size_t more = std::min(outbox.size(), bytes.size() - size);
    if (more > 0) std::memcpy(bytes.data() + size, outbox.data(), more);
    size += more;
  }
};

struct ProgramBench {
  Controller controller;
  ScriptIntake intake;
  Said said;
  bool listening = true;  // the control computer accepts connections

  explicit ProgramBench(const Settings& chosen = settings()) : controller(chosen) {
    ASSERT_OK(controller.start());
  }

  static Settings settings() {
    Settings settings;
    settings.initial_q << 0.0, -1.2, 1.2, -0.1, 1.57, 0.0;
    return settings;
  }
  Machine& machine() { return controller.machine(); }
  const Image& image() const { return controller.image(); }
  Joints target() { return machine().motion.q(); }

  /// Uploads as on a state port: direct commands are no programs.
  void upload(std::string_view text) {
    const auto sink = [&](std::string_view piece) {
      if (!run_direct_command(piece, controller.runner(), machine()))
        controller.runner().upload(piece, machine());
    };
    intake.take(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), sink);
  }
  void tick() {
    controller.tick();
    said.take(machine().messages.pending());
    machine().messages.clear();
    for (Link& link : machine().links.all()) {
      if (link.state() != Link::State::kWanted) continue;
      link.connecting();
      if (listening)
        link.connected();
      else
        link.failed();
    }
  }
  void run(int cycles) {
    for (int k = 0; k < cycles; ++k) tick();
  }
  void run_s(double seconds) { run(static_cast<int>(seconds / kCycle_s + 0.5)); }
  /// Runs until the program has ended; returns the number of cycles, or `most`.
  int run_to_end(int most = 2000) {
    int k = 0;
    for (; k < most && running(); ++k) tick();
    return k;
  }
  bool running() const { return image().program_running; }
  std::int32_t int_output(std::size_t i) { return machine().io.output.ints[i]; }
  double float_output(std::size_t i) { return machine().io.output.doubles[i]; }

  /// The open link of this name.
  Link& link(std::string_view name) {
    for (Link& link : machine().links.all())
      if (link.open() && link.name() == name) return link;
    _fail(__FILE__, __LINE__);
    return machine().links.all()[0];
  }
  bool connected(std::string_view name) {
    for (Link& link : machine().links.all())
      if (link.open() && link.name() == name) return true;
    return false;
  }
  /// Sends big-endian integers from the control computer to the robot.
  void send(std::string_view name, const std::int32_t* values, std::size_t count) {
    std::array<std::uint8_t, 256> bytes;
    ByteWriter writer(bytes.data(), bytes.size());
    for (std::size_t i = 0; i < count; ++i) writer.i32(values[i]);
    link(name).receive(writer.data(), writer.size());
  }
  /// Reads the integers that the robot has sent over a socket; returns their number.
  std::size_t received(std::string_view name, std::int32_t* values, std::size_t most) {
    Outbox& out = link(name).outbox();
    ByteReader reader(out.data(), out.size());
    std::size_t count = 0;
    while (count < most && reader.left() >= 4) values[count++] = reader.i32();
    out.clear();
    return count;
  }
};

/// Starts a program that runs these lines and then waits.
inline void start_and_wait(ProgramBench& bench, const char* lines) {
  std::array<char, 1024> text;
  const int size = std::snprintf(text.data(), text.size(),
                                 "def yields():\n%s  while True:\n    sync()\n  end\nend\n", lines);
  bench.upload({text.data(), static_cast<std::size_t>(size)});
}

inline Joints joints(std::initializer_list<double> values) {
  Joints q;
  std::copy(values.begin(), values.end(), q.data());
  return q;
}

inline const Joints kStart = ProgramBench::settings().initial_q;

inline std::int32_t fixed(double value) {
  return static_cast<std::int32_t>(std::lround(value * 1e6));
}

inline void assert_joints(const Joints& actual, const Joints& expected, double tolerance) {
  for (int i = 0; i < 6; ++i) ASSERT_NEAR(actual[i], expected[i], tolerance);
}

}  // namespace tactus::ur
