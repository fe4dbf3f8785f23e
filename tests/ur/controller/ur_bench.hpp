// An emulated UR10 controller for tests: the test runs its cycles, and exchanges bytes without
// sockets.
#pragma once

#include <array>
#include <cstring>
#include <new>
#include <string_view>

#include "sim_plant/ur/controller/emulator.hpp"

namespace tactus::ur {

inline constexpr double kEncoder_rad = 6.0e-6;  ///< half a step of an encoder

/// One controller at a time, because MuJoCo's memory outlives a failed assertion.
class Bench {
 public:
  ~Bench() { end(); }
  Emulator& start(const Settings& settings = {}) {
    end();
    emulator_ = new (memory_) Emulator(settings);
    started_ = emulator_->start() == Status::kOk;
    return *emulator_;
  }
  bool started() const { return started_; }
  Emulator& operator*() { return *emulator_; }
  Emulator* operator->() { return emulator_; }
  Controller& controller() { return emulator_->controller(); }
  const Image& image() { return controller().image(); }

  void ticks(int count) {
    for (int i = 0; i < count; ++i) emulator_->tick();
  }
  /// Ticks until the condition holds; false if it does not within `most` cycles.
  template <class Condition>
  bool until(Condition&& holds, int most) {
    for (int i = 0; i < most && !holds(); ++i) emulator_->tick();
    return holds();
  }
  void send(int session, std::string_view text) {
    emulator_->receive(session, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }
  /// Takes all bytes that wait for the client.
  std::string_view take(int session) {
    Outbox& out = emulator_->outbox(session);
    size_ = out.size();
    std::memcpy(taken_.data(), out.data(), size_);
    out.sent(size_);
    return {taken_.data(), size_};
  }

 private:
  void end() {
    if (emulator_ != nullptr) emulator_->~Emulator();
  }
  alignas(Emulator) unsigned char memory_[sizeof(Emulator)];
  Emulator* emulator_ = nullptr;
  bool started_ = false;
  std::array<char, Outbox::kCapacity> taken_;
  std::size_t size_ = 0;
};

inline Bench g_bench;  ///< that of a process

}  // namespace tactus::ur
