// A UR controller made of protocol bytes, behind sockets of its own on this machine: it answers as
// a CB3 does, or as the test wants it to fail, and sends the data packages that the test asks for.
// A thread serves the sockets; there is no arm in it.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>

#include "sim_plant/ur/wire/state_messages.hpp"
#include "tests/ur/hal/ur_fake_image.hpp"

namespace tactus::ur {

class FakeController {
 public:
  FakeImage image;    // guarded by mutex while the thread runs
  FakeFaults faults;  // likewise
  std::mutex mutex;

  void start() {
    for (FakeListener& listener : listeners_) listener.open();
    thread_ = std::thread([this] { serve(); });
  }
  void stop() {
    ends_ = true;
    if (thread_.joinable()) thread_.join();
    for (FakeListener& listener : listeners_) listener.close();
  }
  int rtde_port() const { return listeners_[0].port; }
  int primary_port() const { return listeners_[1].port; }
  int dashboard_port() const { return listeners_[2].port; }
  /// Connections to the port of RTDE so far.
  int connections() const { return listeners_[0].connections; }

  /// From now on only the test sends packages.
  void by_hand() {
    streams_ = false;
    const std::lock_guard<std::mutex> lock(mutex);
  }
  void by_itself() { streams_ = true; }
  /// Waits until it has taken everything that was sent before.
  void settle() {
    const int until = rounds_ + 2;
    while (rounds_ < until) std::this_thread::sleep_for(kTick);
  }
  /// Changes what it says.
  template <class Change>
  void change(Change change) {
    const std::lock_guard<std::mutex> lock(mutex);
    change(image);
  }

  /// Writes the next data package, `periods` later.
  std::size_t package(std::uint8_t* bytes, double periods = 1.0) {
    const std::lock_guard<std::mutex> lock(mutex);
    return write_package(bytes, periods);
  }
  void send(const std::uint8_t* bytes, std::size_t size) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (listeners_[0].socket < 0) return;
    assert_int_equal(::send(listeners_[0].socket, bytes, size, MSG_NOSIGNAL),
                     static_cast<long>(size));
  }
  void send_package(double periods = 1.0) {
    std::array<std::uint8_t, 1024> bytes;
    send(bytes.data(), package(bytes.data(), periods));
  }
  /// Sends a code over the primary port.
  void send_code(std::int32_t code, std::int32_t argument) {
    std::array<std::uint8_t, 64> bytes;
    ByteWriter out(bytes.data(), bytes.size());
    out.u32(0);
    out.i8(20);
    out.u64(0);
    out.i8(-2);
    out.u8(6);
    out.i32(code);
    out.i32(argument);
    out.i32(3);
    out.u32(0);
    out.u32(0);
    out.set_u32(0, out.size());
    listeners_[1].send(out.data(), out.size());
  }
  void tell_kinematics() {
    std::array<std::uint8_t, 256> bytes;
    ByteWriter out(bytes.data(), bytes.size());
    out.u32(0);
    out.i8(16);
    write_kinematics(faults.kinematics, out);
    out.set_u32(0, out.size());
    out.set_u32(5, faults.kinematics_length);
    listeners_[1].send(out.data(), out.size());
  }
  void drop_rtde() { drop(0); }
  void drop_primary() { drop(1); }
  void drop_dashboard() { drop(2); }
  /// It takes no other connection either.
  void close_dashboard() {
    const std::lock_guard<std::mutex> lock(mutex);
    listeners_[2].close();
    listeners_[2].listening = -1;
  }
  /// Connections to the dashboard so far.
  int dashboard_connections() const { return listeners_[2].connections; }
  /// It leaves what comes through RTDE where it is, or reads on.
  void stop_reading() { reads_ = false; }
  void read_on() { reads_ = true; }

  /// Waits until set-point `count` has arrived; returns its joint positions.
  std::array<double, 6> set_point(std::int32_t count) {
    for (int i = 0; i < 2000 && count_ != count; ++i) std::this_thread::sleep_for(kTick);
    assert_int_equal(count_, count);
    const std::lock_guard<std::mutex> lock(mutex);
    return q_set_;
  }
  std::int32_t count() const { return count_; }
  int uploads() const { return uploads_; }
  int ends() const { return ends_told_; }

 private:
  static constexpr std::chrono::microseconds kTick{500};

  void drop(std::size_t port) {
    const std::lock_guard<std::mutex> lock(mutex);
    listeners_[port].drop();
  }

  void serve() {
    for (; !ends_; std::this_thread::sleep_for(kTick), ++rounds_) {
      const std::lock_guard<std::mutex> lock(mutex);
      for (std::size_t i = 0; i < listeners_.size(); ++i) attend(i);
      if (!streams_ || !started_ || listeners_[0].socket < 0) continue;
      std::array<std::uint8_t, 1024> bytes;
      listeners_[0].send(bytes.data(), write_package(bytes.data(), 1.0));
    }
  }
  void attend(std::size_t i) {
    FakeListener& listener = listeners_[i];
    listener.dribbles = i == faults.dribbling_port;
    if (listener.accept()) {
      if (i == 0) {
        started_ = false;
        protocol_ = 1;
      }
      if (i == 1) tell_kinematics();
      if (i == 2) made_in_local_ = faults.local;
      if (i == 2 && !faults.silent_dashboard)
        listener.say("Connected: Universal Robots Dashboard Server\n");
    }
    listener.dribble();
    if (listener.socket < 0 || (i == 0 && !reads_) || !listener.take()) return;
    if (i == 0) take_requests(listener);
    if (i == 1) take_program(listener);
    if (i == 2) take_command(listener);
  }

  void take_requests(FakeListener& listener) {
    std::size_t at = 0;
    while (listener.size - at >= 3) {
      const std::size_t size = std::size_t{listener.bytes[at]} << 8 | listener.bytes[at + 1];
      if (size < 3 || listener.size - at < size) break;
      answer(listener, listener.bytes[at + 2],
             ByteReader(listener.bytes.data() + at + 3, size - 3));
      if (listener.socket < 0) return;
      at += size;
    }
    std::memmove(listener.bytes.data(), listener.bytes.data() + at, listener.size - at);
    listener.size -= at;
  }
  void answer(FakeListener& listener, int type, ByteReader in) {
    if (type == faults.reset_at) return listener.drop();
    if (type == faults.silent_at) return;
    if (type == 'U') return take_set_point(in);
    std::array<std::uint8_t, 512> bytes;
    ByteWriter out(bytes.data(), bytes.size());
    out.u16(0);
    out.u8(static_cast<std::uint8_t>(type));
    if (type == 'V') {
      const bool good = in.u16() == 1 || !faults.only_protocol_1;
      protocol_ = good ? (faults.only_protocol_1 ? 1 : 2) : protocol_;
      out.u8(good ? 1 : 0);
    }
    if (type == 'v') {
      out.u32(faults.major);
      out.u32(faults.minor);
      out.u32(8);
      out.u32(106339);
    }
    if (type == 'O' && protocol_ == 2) out.u8(1);
    if (type == 'O') {
      tells_tool_ = !faults.old_software;
      const bool asks_tool = in.rest().find("tcp_offset") != std::string_view::npos;
      out.text(tells_tool_ ? faults.outputs : asks_tool ? kOldOutputs : kOldWithout);
      void_recipe_ = !tells_tool_ && asks_tool;
    }
    if (type == 'I') {
      out.u8(faults.inputs == kFakeInputs ? 1 : 0);
      out.text(faults.inputs);
    }
    if (type == 'S') {
      started_ = !faults.refuses_start && !void_recipe_;
      out.u8(started_ ? 1 : 0);
    }
    out.set_u16(0, out.size());
    listener.send(out.data(), out.size());
  }
  void take_set_point(ByteReader& in) {
    assert_int_equal(in.u8(), 1);
    const std::int32_t count = in.i32();
    for (double& q : q_set_) q = in.f64();
    assert_true(in.done());
    if (count > 0 && image.runtime_state == 2 && !faults.uses_no_set_points) {
      image.echo = count;
      image.q = q_set_;
    }
    if (count < 0) ++ends_told_;
    count_ = count;
    program_.count = count;
  }
  void take_program(FakeListener& listener) {
    const std::string_view text(reinterpret_cast<const char*>(listener.bytes.data()),
                                listener.size);
    if (text.size() < 5 || text.substr(text.size() - 5) != "\nend\n") return;
    assert_true(text.substr(0, 18) == "def tactus_servo()");
    listener.size = 0;
    ++uploads_;
    if (faults.drops_program) return listener.drop();
    if (faults.stops_on_program) {
      image.safety_mode = 3;
      image.safety_bits = 4;
    }
    if (!faults.refuses_program) return program_.begin(faults.begins_late);
    std::array<std::uint8_t, 128> bytes;
    ByteWriter out(bytes.data(), bytes.size());
    out.u32(0);
    out.i8(20);
    out.u64(0);
    out.i8(-3);
    out.u8(10);
    out.i32(2);
    out.i32(3);
    out.text("compile_error_name_not_found:foo:");
    out.set_u32(0, out.size());
    listener.send(out.data(), out.size());
  }
  void take_command(FakeListener& listener) {
    const std::string_view line(reinterpret_cast<const char*>(listener.bytes.data()),
                                listener.size);
    const bool refuses = made_in_local_ || faults.local;
    if (!faults.silent_dashboard)
      listener.say(refuses ? kNotInRemoteControl : dashboard_reply(line, image, faults));
    listener.size = 0;
  }

  std::size_t write_package(std::uint8_t* bytes, double periods) {
    image.timestamp_s += 0.008 * periods;
    program_.step(image);
    ByteWriter out(bytes, 1024);
    write_image(image, protocol_, tells_tool_, out);
    return out.size();
  }

  std::array<FakeListener, 3> listeners_;
  std::thread thread_;
  std::atomic<bool> ends_{false}, streams_{true}, reads_{true};
  std::atomic<std::int32_t> count_{0};
  std::atomic<int> uploads_{0}, ends_told_{0}, rounds_{0};
  std::array<double, 6> q_set_{};
  FakeProgram program_;
  bool started_ = false, tells_tool_ = true, void_recipe_ = false;
  bool made_in_local_ = false;  // the connection to the dashboard
  int protocol_ = 1;
};

}  // namespace tactus::ur
