// A controller for targets that run programs: whatever it receives, its outputs must be finite.
#pragma once

#include <new>

#include "sim_plant/ur/controller/controller.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace tactus::fuzz {

class RunningController {
 public:
  RunningController() {
    static ur::Controller* last = nullptr;
    if (last != nullptr) last->~Controller();
    last = controller_ = new (memory()) ur::Controller(settings());
    MUST(controller_->start() == Status::kOk);
  }
  ur::Controller& operator*() { return *controller_; }
  ur::Controller* operator->() { return controller_; }
  ur::Machine& machine() { return controller_->machine(); }

  /// Runs one cycle; every connection that a program asks for is made.
  void tick() {
    controller_->tick();
    machine().messages.clear();
    for (ur::Link& link : machine().links.all()) {
      link.outbox().clear();
      if (link.state() == ur::Link::State::kWanted) link.connected();
    }
    check(controller_->image());
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  /// A program must leave behind an arm that brakes within seconds, or one that creeps because its
  /// tool is so long that the speed limit of the tip stretches the braking too.
  void comes_to_rest() {
    constexpr int kMost = 1000;  // cycles
    for (int i = 0; i < kMost && !resting(); ++i) tick();
    MUST(resting() || machine().speed_scaling < 1.0);
  }

 private:
  bool resting() const { return controller_->image().target_qd.isZero(0.0); }
  static void* memory() {
    alignas(ur::Controller) static unsigned char bytes[sizeof(ur::Controller)];
    return bytes;
  }
  static ur::Settings settings() {
    ur::Settings settings;
    settings.initial_q << 0.0, -1.2, 1.2, -0.1, 1.57, 0.0;
    return settings;
  }
  static void check(const ur::Image& image) {
    MUST(image.actual_q.allFinite() && image.actual_qd.allFinite());
    MUST(image.target_q.allFinite() && image.target_qd.allFinite());
    MUST((image.target_qd.cwiseAbs() - ur::MotionLimits().speed).maxCoeff() <= 1e-9);
    MUST(image.actual_tcp_pose.allFinite() && image.actual_tcp_speed.allFinite());
    MUST(image.actual_tcp_force.allFinite() && image.tcp_offset.allFinite());
    MUST(image.speed_scaling >= 0.0 && image.speed_scaling <= 1.0);
    MUST(image.target_speed_fraction >= 0.0 && image.target_speed_fraction <= 1.0);
    MUST(std::isfinite(image.payload) && image.payload_cog.allFinite());
    MUST(std::isfinite(image.standard_analog_output0) &&
         std::isfinite(image.standard_analog_output1));
  }

  ur::Controller* controller_ = nullptr;
};

}  // namespace tactus::fuzz
