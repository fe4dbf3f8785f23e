#include "kernel/pipeline/recorder.hpp"

#include <algorithm>

#include "kernel/core/loop_bound.hpp"

namespace tactus {

std::size_t Recording::width() const {
  std::size_t width = 1;
  for (int i = 0; i < signal_count; ++i) {
    width +=
        static_cast<std::size_t>(info(signals[static_cast<std::size_t>(i)]->quantity).recorded);
  }
  return width;
}

int flatten(const PortEntry& port, double* to) {
  const int count = info(port.quantity).recorded;
  if (port.quantity == Quantity::kPose) {
    const Pose& pose = *static_cast<const Pose*>(port.value);
    const double numbers[] = {pose.p.x(), pose.p.y(), pose.p.z(), pose.r.w(),
                              pose.r.x(), pose.r.y(), pose.r.z()};
    std::copy(numbers, numbers + count, to);
  } else if (is_task_vector(port.quantity)) {
    const Vector6& vector = *static_cast<const Vector6*>(port.value);
    std::copy(vector.data(), vector.data() + count, to);
  } else if (port.quantity == Quantity::kFlag) {
    *to = *static_cast<const bool*>(port.value) ? 1.0 : 0.0;
  } else if (port.quantity == Quantity::kScalar) {
    *to = *static_cast<const double*>(port.value);
  } else if (port.quantity == Quantity::kDigitalOutputs) {
    const DigitalOutputs& outputs = *static_cast<const DigitalOutputs*>(port.value);
    to[0] = outputs.value;
    to[1] = outputs.mask;
  } else if (count > 0) {
    const JointVector& joints = *static_cast<const JointVector*>(port.value);
    std::copy(joints.data(), joints.data() + count, to);
  }
  return count;
}

void Recorder::start(const Recording& recording) {
  recording_ = recording;
  width_ = recording.width();
  positions_.start(static_cast<std::uint32_t>(size_ / width_));
  dropped_ = 0;
}

void Recorder::record(double time_s) {
  std::uint32_t row = 0;
  if (!positions_.to_write(row)) {
    dropped_.store(dropped() + 1, std::memory_order_relaxed);  // one writer
    return;
  }
  double* to = slot(row);
  *to++ = time_s;
  LoopBound<kMaxSignals> signals;
  for (int i = 0; i < recording_.signal_count; ++i) {
    signals.tick();
    to += flatten(*recording_.signals[static_cast<std::size_t>(i)], to);
  }
  positions_.written();
}

bool Recorder::take(double* row) {
  std::uint32_t oldest = 0;
  if (!positions_.to_read(oldest)) return false;
  const double* from = slot(oldest);
  std::copy(from, from + width_, row);
  positions_.was_read();
  return true;
}

}  // namespace tactus
