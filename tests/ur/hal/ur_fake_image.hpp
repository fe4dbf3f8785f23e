// The contents of the fake controller's data package, its faults, and its ports.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <string_view>

#include "hal/ur/protocol.hpp"
#include "sim_plant/ur/motion/kinematics.hpp"
#include "tests/support/testing.hpp"

namespace tactus::ur {

/// Contents of a data package, in the order of the HAL's recipe.
struct FakeImage {
  double timestamp_s = 100.0;
  std::array<double, 6> q = {0.0, -1.2, 1.2, -0.1, 1.57, 0.0};
  std::array<double, 6> dq{}, moment{}, tcp_force{};
  double speed_scaling = 1.0, speed_fraction = 1.0;
  std::int32_t robot_mode = 7, safety_mode = 1, echo = 0;
  std::uint32_t safety_bits = 1, runtime_state = 1;
  std::array<double, 6> tcp_offset{};
  double payload_kg = 0.0;
  std::array<double, 3> payload_com{};
  double tip_error_m = 0.0;  ///< added to x of the pose

  /// The flange, by the kinematics of the emulated controller.
  Vector6 tcp_pose() const {
    Vector6 pose = forward(Joints(q.data())).pose();
    pose[0] += tip_error_m;
    return pose;
  }
};

inline constexpr std::string_view kFakeOutputs =
    "DOUBLE,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D,DOUBLE,DOUBLE,INT32,INT32,INT32,"
    "UINT32,UINT32,VECTOR6D,DOUBLE,VECTOR3D";
/// Those of software that tells nothing of the tool, where it is asked for, and where it is not.
inline constexpr std::string_view kOldOutputs =
    "DOUBLE,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D,DOUBLE,DOUBLE,INT32,INT32,INT32,"
    "UINT32,UINT32,NOT_FOUND,NOT_FOUND,NOT_FOUND";
inline constexpr std::string_view kOldWithout = kOldOutputs.substr(0, kOldOutputs.size() - 30);
inline constexpr std::string_view kFakeInputs = "INT32,DOUBLE,DOUBLE,DOUBLE,DOUBLE,DOUBLE,DOUBLE";

/// The faults of a controller.
struct FakeFaults {
  int reset_at = 0;           ///< type of the request at which it closes the connection
  int silent_at = 0;          ///< type of the request after which it is silent
  bool old_software = false;  ///< tells nothing of the tool; a recipe that asks for it is void
  bool only_protocol_1 = false, refuses_start = false, refuses_program = false;
  bool drops_program = false, stops_on_program = false;
  std::uint32_t major = 3, minor = 15;
  std::string_view outputs = kFakeOutputs, inputs = kFakeInputs;
  int unlock_refusals = 0;
  bool silent_dashboard = false, refuses_power = false;
  bool local = false;         ///< an e-Series that is not in remote control
  bool does_nothing = false;  ///< the dashboard says yes
  bool uses_no_set_points = false;
  std::size_t dribbling_port = 3;       ///< 0 RTDE, 1 primary, 2 dashboard: one byte in 2 ms
  int begins_late = 0;                  ///< packages until a program runs
  DhTable kinematics;                   ///< that it tells on the primary port
  std::size_t kinematics_length = 225;  ///< 0: it cannot be read
};

/// The program on the robot, as far as the state shows it.
struct FakeProgram {
  std::int32_t count = 0;  ///< in the register
  int begins_in = -1;      ///< packages; below 0: no program waits
  bool ours = false;       ///< it is the one that was uploaded

  /// Begins in as many packages, or at once.
  void begin(int late) { begins_in = late; }
  /// With each package: it begins, and ends where the count is negative.
  void step(FakeImage& image) {
    if (ours && image.runtime_state == 2 && count < 0) {
      image.runtime_state = 1;
      image.echo = -1;
      ours = false;
    }
    if (begins_in == 0) {
      image.runtime_state = 2;
      image.echo = count;
      ours = true;
    }
    if (begins_in >= 0) --begins_in;
  }
};

/// What the dashboard says to a command that is sent while the robot is not in remote control, and
/// ever after over the same connection.
/// Source: the words of an e-Series in
/// github.com/UniversalRobots/Universal_Robots_ROS2_Driver/issues/181.
inline constexpr std::string_view kNotInRemoteControl =
    "Command is not allowed due to safety reasons, please switch robot to Remote Control mode and "
    "reconnect to port 29999\n";
/// What the dashboard says, and what it does.
inline std::string_view dashboard_reply(std::string_view line, FakeImage& image,
                                        FakeFaults& faults) {
  if (line == "power on\n" && faults.refuses_power) return "Failed to execute: power on\n";
  const bool acts = !faults.does_nothing;
  if (line == "power on\n") {
    if (acts) image.robot_mode = 5;
    return "Powering on\n";
  }
  if (line == "brake release\n") {
    if (acts) image.robot_mode = 7;
    return "Brake releasing\n";
  }
  if (line != "unlock protective stop\n") return {};
  if (faults.unlock_refusals-- > 0)
    return "Cannot unlock protective stop until 5s after occurrence.\n";
  if (acts) {
    image.safety_mode = 1;
    image.safety_bits = 1;
  }
  return "Protective stop releasing\n";
}

/// A data package, in version 1 or 2 of the protocol, with what the controller says of the `tool`.
inline void write_image(const FakeImage& image, int protocol, bool tool, ByteWriter& out) {
  out.u16(0);
  out.u8('U');
  if (protocol == 2) out.u8(1);
  out.f64(image.timestamp_s);
  for (const auto* six : {&image.q, &image.q, &image.dq, &image.moment})
    for (const double value : *six) out.f64(value);
  for (const double value : image.tcp_pose()) out.f64(value);
  for (const double value : image.tcp_force) out.f64(value);
  out.f64(image.speed_scaling);
  out.f64(image.speed_fraction);
  out.i32(image.robot_mode);
  out.i32(image.safety_mode);
  out.i32(image.echo);
  out.u32(image.safety_bits);
  out.u32(image.runtime_state);
  if (tool) {
    for (const double value : image.tcp_offset) out.f64(value);
    out.f64(image.payload_kg);
    for (const double value : image.payload_com) out.f64(value);
  }
  out.set_u16(0, out.size());
}

/// A port of a controller made of bytes: one connection at a time, on this machine.
struct FakeListener {
  int listening = -1, port = 0, socket = -1;
  std::atomic<int> connections{0};  // so far
  std::array<std::uint8_t, 16384> bytes;
  std::size_t size = 0;
  bool dribbles = false;  // sends one byte now and then

  void open() {
    listening = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    constexpr int kBuffer = 4096;  // soon full where nobody reads
    setsockopt(listening, SOL_SOCKET, SO_RCVBUF, &kBuffer, sizeof kBuffer);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof at;
    assert_int_equal(::bind(listening, reinterpret_cast<sockaddr*>(&at), length), 0);
    assert_int_equal(::listen(listening, 4), 0);
    getsockname(listening, reinterpret_cast<sockaddr*>(&at), &length);
    port = ntohs(at.sin_port);
  }
  /// A new connection takes the place of the one before.
  bool accept() {
    const int connection = ::accept4(listening, nullptr, nullptr, SOCK_NONBLOCK);
    if (connection < 0) return false;
    drop();
    socket = connection;
    ++connections;
    constexpr int kYes = 1;
    setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &kYes, sizeof kYes);
    return true;
  }
  void drop() {
    if (socket >= 0) ::close(socket);
    socket = -1;
    size = slow_size_ = 0;
  }
  void close() {
    drop();
    if (listening >= 0) ::close(listening);
  }
  /// Takes bytes that have come; false: none.
  bool take() {
    const long got = ::recv(socket, bytes.data() + size, bytes.size() - size, MSG_DONTWAIT);
    if (got == 0) drop();
    if (got > 0) size += static_cast<std::size_t>(got);
    return got > 0;
  }

  void send(const std::uint8_t* data, std::size_t count) {
    if (!dribbles) {
      ::send(socket, data, count, MSG_NOSIGNAL);
      return;
    }
    count = std::min(count, slow_.size() - slow_size_);
    std::memcpy(slow_.data() + slow_size_, data, count);
    slow_size_ += count;
  }
  void say(std::string_view text) {
    send(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }
  void dribble() {
    constexpr int kTicks = 4;  // 2 ms
    if (slow_size_ == 0 || ++tick_ % kTicks != 0) return;
    ::send(socket, slow_.data(), 1, MSG_NOSIGNAL);
    std::memmove(slow_.data(), slow_.data() + 1, --slow_size_);
  }

 private:
  std::array<std::uint8_t, 4096> slow_;
  std::size_t slow_size_ = 0;
  int tick_ = 0;
};

}  // namespace tactus::ur
