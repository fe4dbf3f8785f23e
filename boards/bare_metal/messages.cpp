#include "boards/bare_metal/messages.hpp"

#include <algorithm>
#include <new>

#include "boards/bare_metal/embedded_text.hpp"
#include "boards/bare_metal/fault_record.hpp"
#include "boards/bare_metal/provoke.hpp"
#include "boards/bare_metal/timer.hpp"
#include "gateway/fnv1a.hpp"

namespace bare {

using namespace tactus;
using serial::Frame;
using serial::Kind;

namespace {

alignas(Machine) unsigned char machine_bytes[sizeof(Machine)];
LoadError load_error;

}  // namespace

bool Messages::work() {
  Frame frame;
  const bool polled = machine_ != nullptr && machine_->poll();
  reports_ = static_cast<std::uint8_t>(machine_ != nullptr ? machine_->reports() : 0);
  if (!link_.message(frame)) return polled;
  execute(frame);
  link_.answered();
  return true;
}

void Messages::execute(const Frame& frame) {
  const ByteReader payload(frame.payload, frame.size);
  switch (frame.kind) {
    case Kind::kHello: return hello();
    case Kind::kText: return take_text(payload);
    case Kind::kLoad: return load(payload);
    case Kind::kStart: return start(payload);
    case Kind::kStop: return stop();
    case Kind::kFault: return give_fault();
    case Kind::kForget: forget_fault(); return answer(Status::kOk);
    case Kind::kProvoke: return answer(provoke(payload));
    default: break;
  }
  machine_ != nullptr ? execute_reference(frame) : answer(Status::kNotStarted);
}

void Messages::hello() {
  serial::Greeting greeting;
  greeting.joints = static_cast<std::uint8_t>(kDof);
  greeting.robot = Text<31>(Robot::kName);
  greeting.text = fnv1a(text());
  greeting.fault = fault_record().cause;
  write(link_.answer(Status::kOk), greeting);
}

std::string_view Messages::text() const {
  return text_size_ > 0 ? std::string_view(text_.data(), text_size_) : embedded_text();
}

/// A text comes in parts, in any order, while no cycle runs. It overwrites the one before, so until
/// it is loaded the embedded one is there.
void Messages::take_text(ByteReader payload) {
  const std::size_t offset = payload.u32();
  const std::string_view part = payload.rest();
  if (running() != nullptr) return answer(Status::kNotAtRest);
  if (!payload.ok() || offset > kMaxText || part.size() > kMaxText - offset)
    return answer(Status::kTooLarge);
  machine_ = nullptr;
  text_size_ = 0;
  std::copy(part.begin(), part.end(), text_.begin() + static_cast<std::ptrdiff_t>(offset));
  answer(Status::kOk);
}

/// Has a machine that has never run load the text, unless there is one.
Status Messages::prepare() {
  if (machine_ != nullptr) return Status::kOk;
  load_error = LoadError();
  Machine* const machine = new (machine_bytes) Machine(hal_);
  const Status status = machine->load(text(), load_error);
  if (status == Status::kOk) machine_ = machine;
  return status;
}

/// Loads what has come, or the embedded text. If it is refused, the answer says why, and the
/// embedded one is there again.
void Messages::load(ByteReader payload) {
  const std::size_t size = payload.u32();
  const std::uint64_t hash = payload.u64();
  if (running() != nullptr) return answer(Status::kNotAtRest);
  if (!payload.done() || size > kMaxText) return answer(Status::kTooLarge);
  if (size > 0 && fnv1a({text_.data(), size}) != hash) return answer(Status::kWireFormat);
  text_size_ = size;
  machine_ = nullptr;
  const Status status = prepare();
  if (status != Status::kOk) text_size_ = 0;
  link_.answer(status).short_text(load_error.message());
}

void Messages::start(ByteReader payload) {
  const auto pace = static_cast<serial::Pace>(payload.u8());
  if (!payload.done() || pace > serial::Pace::kLockStep) return answer(Status::kWireFormat);
  if (running() != nullptr) return answer(Status::kNotAtRest);
  Status status = prepare();
  if (status == Status::kOk) status = machine_->start();
  if (status == Status::kOk) {
    pace_ = pace;
    set_period(machine_->period_us());
    running_.store(machine_, std::memory_order_release);
  }
  answer(status);
}

/// A machine that was stopped is not started again: the next start loads the text anew.
void Messages::stop() {
  Machine* const running = running_.exchange(nullptr, std::memory_order_acq_rel);
  if (running != nullptr) running->stop();
  machine_ = nullptr;
  answer(Status::kOk);
}

void Messages::give_fault() {
  write(link_.answer(Status::kOk), fault_record());
}

}  // namespace bare
