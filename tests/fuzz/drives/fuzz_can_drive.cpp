// Fuzzes the emulated drives with frames of a bus. A drive must answer in frames of the standard,
// apply torque only where its state allows, and never hang.
//
// The tape is a row of frames: a byte for the identifier, one for size and time, then the data.
#include "sim_plant/drives/drive_arm.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus;
using namespace tactus::drives;

constexpr std::size_t kDrives = 2;
constexpr std::int64_t kMillisecond_ns = 1'000'000;

DriveArmSettings settings_of(bool fd) {
  DriveArmSettings settings;
  for (std::size_t i = 0; i < kDrives; ++i) settings.joints[i] = {0, static_cast<int>(i) + 1};
  settings.fd = fd;
  settings.brake_release_s = 0.002;
  return settings;
}

/// Mostly identifiers that drive 1 listens to.
std::uint16_t id_of(std::uint8_t byte) {
  constexpr std::uint16_t kIds[] = {0x000, 0x080, 0x080, 0x081, 0x201, 0x301, 0x401, 0x501,
                                    0x601, 0x601, 0x601, 0x601, 0x602, 0x701, 0x77F, 0x181};
  return byte < 0xF0 ? kIds[byte % 16] : static_cast<std::uint16_t>((byte & 0x0F) << 7 | 0x01);
}

void check_frame(const can::CanFrame& frame, bool fd) {
  MUST(frame.id > 0 && frame.id <= 0x7FF);
  MUST(frame.size <= (fd ? can::kMaxData : can::kClassicData));
  MUST(!frame.remote);
  if (frame.id > 0x580 && frame.id < 0x600) MUST(frame.size == 8 && !frame.fd);
  if (frame.id > 0x700 && frame.id < 0x780) MUST(frame.size == 1 && !frame.fd);
}

void check_drive(Node& node) {
  const Axis& axis = node.axis();
  const cia402::State state = axis.state();
  const bool moves = state == cia402::State::kOperationEnabled ||
                     state == cia402::State::kQuickStopActive ||
                     state == cia402::State::kFaultReactionActive;
  MUST(axis.powered() == moves);
  MUST(moves || axis.braked());
  MUST(cia402::is_standard(axis.statusword()));
  const std::int64_t torque = node.dictionary().get(slot_of(0x6077));
  MUST(torque >= -32768 && torque <= 32767);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static DriveArm arm;
  const bool fd = size > 0 && (data[0] & 1) != 0;
  std::int64_t now_ns = kMillisecond_ns;
  MUST(arm.load(settings_of(fd), now_ns) == Status::kOk);
  now_ns += 20 * kMillisecond_ns;
  arm.advance(now_ns);
  for (std::size_t at = 1; at + 2 <= size;) {
    can::CanFrame frame;
    frame.id = id_of(data[at]);
    const std::uint8_t form = data[at + 1];
    at += 2;
    frame.remote = (form & 0x70) == 0x70;
    frame.fd = fd;
    const std::size_t wanted = (form & 0x0F) <= 8 ? form & 0x0F : fd ? 32 : 8;
    frame.size = static_cast<std::uint8_t>(std::min(wanted, size - at));
    std::copy_n(data + at, frame.size, frame.data.begin());
    at += frame.size;
    arm.receive(0, frame, now_ns);
    if ((form & 0x80) != 0) now_ns += kMillisecond_ns * (form & 0x7F);
    arm.advance(now_ns);
    can::CanFrame answer;
    while (arm.take(0, answer)) check_frame(answer, fd);
    for (std::size_t i = 0; i < kDrives; ++i) check_drive(arm.node(static_cast<int>(i)));
  }
  return 0;
}
