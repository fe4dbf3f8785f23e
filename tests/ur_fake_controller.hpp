// A UR controller made of protocol bytes, behind sockets of its own on this machine: it answers a
// start as a CB3 does, or as the test wants it to fail, and sends the data packages that the test
// asks for. A thread serves the sockets; there is no arm in it.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <mutex>
#include <thread>

#include "tests/testing.hpp"
#include "tests/ur_fake_image.hpp"

namespace tactus::ur {

class FakeController {
 public:
  FakeImage image;    // guarded by mutex while the thread runs
  FakeFaults faults;  // set before start()
  std::mutex mutex;

  void start() {
    for (Door& door : doors_) open(door);
    thread_ = std::thread([this] { serve(); });
  }
  void stop() {
    ends_ = true;
    if (thread_.joinable()) thread_.join();
    for (Door& door : doors_) {
      drop(door);
      if (door.listening >= 0) ::close(door.listening);
    }
  }
  int rtde_port() const { return doors_[0].port; }
  int primary_port() const { return doors_[1].port; }
  int dashboard_port() const { return doors_[2].port; }

  /// From now on packages come from the test alone.
  void by_hand() {
    streams_ = false;
    const std::lock_guard<std::mutex> lock(mutex);
  }
  void by_itself() { streams_ = true; }

  /// The bytes of the next data package: `periods` later.
  std::size_t package(std::uint8_t* bytes, double periods = 1.0) {
    const std::lock_guard<std::mutex> lock(mutex);
    return write_package(bytes, periods);
  }
  void send(const std::uint8_t* bytes, std::size_t size) {
    assert_int_equal(::send(doors_[0].socket, bytes, size, MSG_NOSIGNAL), static_cast<long>(size));
  }
  void send_package(double periods = 1.0) {
    std::array<std::uint8_t, 1024> bytes;
    send(bytes.data(), package(bytes.data(), periods));
  }
  /// The primary port tells a code.
  void send_code(std::int32_t code, std::int32_t argument) {
    std::array<std::uint8_t, 64> bytes;
    ByteWriter out(bytes.data(), bytes.size());
    out.u32(0), out.i8(20), out.u64(0), out.i8(-2), out.u8(6);
    out.i32(code), out.i32(argument), out.i32(3), out.u32(0), out.u32(0);
    out.set_u32(0, out.size());
    ::send(doors_[1].socket, out.data(), out.size(), MSG_NOSIGNAL);
  }
  void drop_rtde() { drop(doors_[0]); }

  /// Waits until set-point `count` is there; its joint positions.
  std::array<double, 6> set_point(std::int32_t count) {
    for (int i = 0; i < 2000 && count_ != count; ++i) std::this_thread::sleep_for(kTick);
    assert_int_equal(count_, count);
    const std::lock_guard<std::mutex> lock(mutex);
    return q_set_;
  }
  std::int32_t count() const { return count_; }
  int uploads() const { return uploads_; }

 private:
  static constexpr std::chrono::microseconds kTick{500};
  struct Door {
    int listening = -1, port = 0, socket = -1;
    std::array<std::uint8_t, 16384> bytes;
    std::size_t size = 0;
  };

  static void open(Door& door) {
    door.listening = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    assert_int_equal(::bind(door.listening, reinterpret_cast<sockaddr*>(&at), size), 0);
    assert_int_equal(::listen(door.listening, 4), 0);
    getsockname(door.listening, reinterpret_cast<sockaddr*>(&at), &size);
    door.port = ntohs(at.sin_port);
  }
  static void drop(Door& door) {
    if (door.socket >= 0) ::close(door.socket);
    door.socket = -1;
    door.size = 0;
  }

  void serve() {
    for (; !ends_; std::this_thread::sleep_for(kTick)) {
      const std::lock_guard<std::mutex> lock(mutex);
      for (std::size_t i = 0; i < doors_.size(); ++i) attend(i);
      if (!streams_ || !started_ || doors_[0].socket < 0) continue;
      std::array<std::uint8_t, 1024> bytes;
      ::send(doors_[0].socket, bytes.data(), write_package(bytes.data(), 1.0), MSG_NOSIGNAL);
    }
  }
  void attend(std::size_t i) {
    Door& door = doors_[i];
    const int guest = ::accept4(door.listening, nullptr, nullptr, SOCK_NONBLOCK);
    if (guest >= 0) {
      drop(door);
      door.socket = guest;
      constexpr int kYes = 1;
      setsockopt(guest, IPPROTO_TCP, TCP_NODELAY, &kYes, sizeof kYes);
      if (i == 0) started_ = false, protocol_ = 1;
      if (i == 2) say(door, "Connected: Universal Robots Dashboard Server\n");
    }
    if (door.socket < 0) return;
    const long got = ::recv(door.socket, door.bytes.data() + door.size,
                            door.bytes.size() - door.size, MSG_DONTWAIT);
    if (got == 0) return drop(door);
    if (got < 0) return;
    door.size += static_cast<std::size_t>(got);
    if (i == 0) take_requests(door);
    if (i == 1) take_program(door);
    if (i == 2) take_command(door);
  }
  static void say(Door& door, std::string_view text) {
    ::send(door.socket, text.data(), text.size(), MSG_NOSIGNAL);
  }

  void take_requests(Door& door) {
    std::size_t at = 0;
    while (door.size - at >= 3) {
      const std::size_t size = std::size_t{door.bytes[at]} << 8 | door.bytes[at + 1];
      if (size < 3 || door.size - at < size) break;
      answer(door, door.bytes[at + 2], ByteReader(door.bytes.data() + at + 3, size - 3));
      if (door.socket < 0) return;
      at += size;
    }
    std::memmove(door.bytes.data(), door.bytes.data() + at, door.size - at);
    door.size -= at;
  }
  void answer(Door& door, int type, ByteReader in) {
    if (type == faults.reset_at) return drop(door);
    if (type == faults.silent_at) return;
    if (type == 'U') return take_set_point(in);
    std::array<std::uint8_t, 512> bytes;
    ByteWriter out(bytes.data(), bytes.size());
    out.u16(0), out.u8(static_cast<std::uint8_t>(type));
    if (type == 'V') {
      const bool good = in.u16() == 1 || !faults.only_protocol_1;
      protocol_ = good ? (faults.only_protocol_1 ? 1 : 2) : protocol_;
      out.u8(good ? 1 : 0);
    }
    if (type == 'v') out.u32(faults.major), out.u32(faults.minor), out.u32(8), out.u32(106339);
    if (type == 'O' && protocol_ == 2) out.u8(1);
    if (type == 'O') out.text(faults.outputs);
    if (type == 'I') out.u8(faults.inputs == kFakeInputs ? 1 : 0), out.text(faults.inputs);
    if (type == 'S') out.u8(faults.refuses_start ? 0 : 1), started_ = !faults.refuses_start;
    out.set_u16(0, out.size());
    ::send(door.socket, out.data(), out.size(), MSG_NOSIGNAL);
  }
  void take_set_point(ByteReader& in) {
    assert_int_equal(in.u8(), 1);
    const std::int32_t count = in.i32();
    for (double& q : q_set_) q = in.f64();
    assert_true(in.done());
    if (count < 0 && image.runtime_state == 2) image.runtime_state = 1, image.echo = -1;
    if (count > 0 && image.runtime_state == 2) image.echo = count, image.q = q_set_;
    count_ = count;
  }
  void take_program(Door& door) {
    const std::string_view text(reinterpret_cast<const char*>(door.bytes.data()), door.size);
    if (text.size() < 5 || text.substr(text.size() - 5) != "\nend\n") return;
    door.size = 0;
    ++uploads_;
    if (faults.drops_program) return drop(door);
    if (faults.stops_on_program) image.safety_mode = 3, image.safety_bits = 4;
    if (!faults.refuses_program) image.runtime_state = 2, image.echo = count_;
    if (!faults.refuses_program) return;
    std::array<std::uint8_t, 128> bytes;
    ByteWriter out(bytes.data(), bytes.size());
    out.u32(0), out.i8(20), out.u64(0), out.i8(-3), out.u8(10), out.i32(2), out.i32(3);
    out.text("compile_error_name_not_found:foo:");
    out.set_u32(0, out.size());
    ::send(door.socket, out.data(), out.size(), MSG_NOSIGNAL);
  }
  void take_command(Door& door) {
    const std::string_view line(reinterpret_cast<const char*>(door.bytes.data()), door.size);
    if (line == "power on\n") say(door, "Powering on\n"), image.robot_mode = 5;
    if (line == "brake release\n") say(door, "Brake releasing\n"), image.robot_mode = 7;
    if (line == "unlock protective stop\n" && faults.unlock_refusals-- > 0) {
      say(door, "Cannot unlock protective stop until 5s after occurrence.\n");
    } else if (line == "unlock protective stop\n") {
      say(door, "Protective stop releasing\n");
      image.safety_mode = 1, image.safety_bits = 1;
    }
    door.size = 0;
  }

  std::size_t write_package(std::uint8_t* bytes, double periods) {
    image.timestamp_s += 0.008 * periods;
    ByteWriter out(bytes, 1024);
    write_image(image, protocol_, out);
    return out.size();
  }

  std::array<Door, 3> doors_;
  std::thread thread_;
  std::atomic<bool> ends_{false}, streams_{true};
  std::atomic<std::int32_t> count_{0};
  std::atomic<int> uploads_{0};
  std::array<double, 6> q_set_{};
  bool started_ = false;
  int protocol_ = 1;
};

}  // namespace tactus::ur
