#include "kernel/recorder.hpp"

#include <algorithm>

#include "kernel/loop_bound.hpp"

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
  } else if (count > 0) {
    const JointVector& joints = *static_cast<const JointVector*>(port.value);
    std::copy(joints.data(), joints.data() + count, to);
  }
  return count;
}

void Recorder::start(const Recording& recording) {
  recording_ = recording;
  width_ = recording.width();
  rows_ = static_cast<std::uint32_t>(size_ / width_);
  head_ = tail_ = dropped_ = 0;
}

void Recorder::record(double time_s) {
  const std::uint32_t head = head_.load(std::memory_order_relaxed);
  const std::uint32_t tail = tail_.load(std::memory_order_acquire);
  if ((head >= tail ? head - tail : head + 2 * rows_ - tail) == rows_) {
    dropped_.store(dropped() + 1, std::memory_order_relaxed);  // one writer
    return;
  }
  double* to = slot(head);
  *to++ = time_s;
  LoopBound<kMaxSignals> signals;
  for (int i = 0; i < recording_.signal_count; ++i) {
    signals.tick();
    to += flatten(*recording_.signals[static_cast<std::size_t>(i)], to);
  }
  head_.store(next(head), std::memory_order_release);
}

bool Recorder::take(double* row) {
  const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
  if (tail == head_.load(std::memory_order_acquire)) return false;
  const double* from = slot(tail);
  std::copy(from, from + width_, row);
  tail_.store(next(tail), std::memory_order_release);
  return true;
}

}  // namespace tactus
