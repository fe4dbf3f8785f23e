#include "hal/can/node_setup.hpp"

namespace tactus::can {
namespace {

constexpr std::uint32_t kIdBits = kPdoInvalid | 0x7FF;  // of a PDO's COB-ID
constexpr int kPdos = 4;                                // of the predefined connection set

// Options of a drive (CiA 402): what it does by itself.
constexpr std::uint32_t kRampThenOff = 2;  // quick stop and fault reaction: the quick-stop ramp
constexpr std::uint32_t kStopOnLostMaster = 3;  // abort of the connection: quick stop

std::uint32_t millis(int time_ms) {
  return static_cast<std::uint32_t>(time_ms);
}

}  // namespace

void NodeSetup::begin(const CanSettings& can, const PdoLayout& layout, const Slot& slot,
                      CommandMode mode, int period_us) {
  count_ = 0;
  identity(can, mode);
  identifying_ = count_;
  facts();
  watchdogs(can, period_us);
  pdos(can, layout, slot, period_us);
  const auto code = static_cast<std::uint8_t>(cia402::mode_of(mode));
  write(Kind::kWrite, cia402::kModeOfOperation, code, "mode of operation");
  write(Kind::kAwait, cia402::kModeDisplay, code, "display of the mode of operation");
}

void NodeSetup::identity(const CanSettings& can, CommandMode mode) {
  expect(kDeviceType, 0, 4, cia402::kDriveProfile, "profile of the device",
         "a CiA 402 drive is needed; check [can] node", 0xFFFF);
  if (can.vendor != 0)
    expect(kIdentity, 1, 4, static_cast<std::uint32_t>(can.vendor), "vendor", "check [can] vendor");
  if (can.product != 0)
    expect(kIdentity, 2, 4, static_cast<std::uint32_t>(can.product), "product",
           "check [can] product");
  const std::uint32_t bit = 1U << (static_cast<int>(cia402::mode_of(mode)) - 1);
  expect(cia402::kSupportedModes.index, 0, 4, bit, "supported modes",
         "the drive does not have the mode that [robot] commands", bit);
  fact(cia402::kIdentityFact);
}

void NodeSetup::fact(std::uint32_t row) {
  const auto& [object, what] = cia402::kFacts[row];
  steps_[static_cast<std::size_t>(count_++)] = {Kind::kFact, object.sub, object.bytes, object.index,
                                                row,         0xFFFFFFFF, what,         ""};
}

/// Writes the lines of the file before the facts, as they may set one; only the identity is first.
void NodeSetup::facts() {
  write(Kind::kLines, 0, 0, 0, 0, "");
  for (std::uint32_t i = cia402::kIdentityFact + 1; i < cia402::kFactCount; ++i) fact(i);
  write(Kind::kStore, cia402::kStoreParameters, cia402::kSaveSignature,
        "its parameters cannot be stored, [cia402] store and store_ms");
}

/// Makes the drive stop if heartbeats or commands of this program are missing.
void NodeSetup::watchdogs(const CanSettings& can, int period_us) {
  const std::uint32_t consumer =
      static_cast<std::uint32_t>(can.master_node) << 16 | millis(3 * can.heartbeat_ms);
  write(Kind::kWrite, kHeartbeatProducer, 0, 2, millis(can.heartbeat_ms), "heartbeat time");
  write(Kind::kMayWrite, kHeartbeatConsumer, 1, 4, consumer, "consumer of our heartbeat");
  steps_[static_cast<std::size_t>(count_ - 1)].watches = true;
  write(Kind::kMayWrite, cia402::kAbortConnectionOption, kStopOnLostMaster,
        "abort connection option");
  write(Kind::kMayWrite, cia402::kQuickStopOption, kRampThenOff, "quick stop option");
  write(Kind::kMayWrite, cia402::kFaultReactionOption, kRampThenOff, "fault reaction option");
  write(Kind::kMayWrite, kSyncIdObject, 0, 4, kSyncId, "identifier of SYNC");
  // The commands have a time-out; a watch over SYNC would stop the arm for half a period of jitter.
  write(Kind::kMayWrite, kSyncPeriod, 0, 4, 0, "SYNC period");
  const auto [value, index] = cia402::period_object(period_us);
  write(Kind::kMayWrite, cia402::kPeriodValue, value, "interpolation time period");
  write(Kind::kMayWrite, cia402::kPeriodIndex, static_cast<std::uint8_t>(index),
        "interpolation time index");
}

void NodeSetup::pdos(const CanSettings& can, const PdoLayout& layout, const Slot& slot,
                     int period_us) {
  std::array<Pdo, PdoLayout::kMaxCommands> commands;
  const int count = layout.commands(slot, commands);
  for (int i = 0; i < kPdos; ++i) {
    const auto offset = static_cast<std::uint16_t>(i);
    const auto receive = static_cast<std::uint16_t>(kRpdoCommunication + offset);
    const auto send = static_cast<std::uint16_t>(kTpdoCommunication + offset);
    if (i < count) {
      // A frame that is sent on change has no time-out of its own.
      const int timeout_ms = i + 1 == count ? can.timeout_ms(period_us) : 0;
      pdo(receive, static_cast<std::uint16_t>(kRpdoMapping + offset),
          commands[static_cast<std::size_t>(i)], timeout_ms);
    } else {
      unused(receive, static_cast<std::uint16_t>(kRpdoBase[i] + slot.node));
    }
    if (i == 0)
      pdo(send, kTpdoMapping, layout.feedback(slot), 0);
    else
      unused(send, static_cast<std::uint16_t>(kTpdoBase[i] + slot.node));
  }
}

void NodeSetup::pdo(std::uint16_t communication, std::uint16_t mapping, const Pdo& pdo,
                    int timeout_ms) {
  const std::uint32_t id = pdo.id | kPdoNoRemote * (communication >= kTpdoCommunication);
  write(Kind::kWrite, communication, kPdoId, 4, id | kPdoInvalid, "identifier of a PDO");
  write(Kind::kWrite, mapping, 0, 1, 0, "number of mapped objects");
  for (int i = 0; i < pdo.count; ++i)
    write(Kind::kWrite, mapping, static_cast<std::uint8_t>(i + 1), 4,
          pdo.entries[static_cast<std::size_t>(i)], "mapped object");
  const auto count = static_cast<std::uint8_t>(pdo.count);
  write(Kind::kWrite, mapping, 0, 1, count, "number of mapped objects");
  write(Kind::kWrite, communication, kPdoType, 1, kEverySync, "transmission type of a PDO");
  if (timeout_ms > 0) {
    write(Kind::kMayWrite, communication, kPdoEventTimer, 2, millis(timeout_ms),
          "time-out of the commands");
    steps_[static_cast<std::size_t>(count_ - 1)].watches = true;
  }
  write(Kind::kWrite, communication, kPdoId, 4, id, "identifier of a PDO");

  const char* remedy = "the drive did not keep what was written; power it off and on";
  expect(mapping, 0, 1, count, "number of mapped objects", remedy, 0xFF);
  for (int i = 0; i < pdo.count; ++i)
    expect(mapping, static_cast<std::uint8_t>(i + 1), 4, pdo.entries[static_cast<std::size_t>(i)],
           "mapped object", remedy);
  expect(communication, kPdoType, 1, kEverySync, "transmission type of a PDO", remedy, 0xFF);
  expect(communication, kPdoId, 4, pdo.id, "identifier of a PDO", remedy, kIdBits);
}

/// A PDO that a drive has by default would load the bus, or command the drive.
void NodeSetup::unused(std::uint16_t communication, std::uint16_t id) {
  write(Kind::kMayWrite, communication, kPdoId, 4, id | kPdoInvalid, "identifier of a PDO");
}

void NodeSetup::expect(std::uint16_t index, std::uint8_t sub, std::uint8_t bytes,
                       std::uint32_t value, const char* what, const char* remedy,
                       std::uint32_t mask) {
  steps_[static_cast<std::size_t>(count_++)] = {Kind::kExpect, sub,  bytes, index,
                                                value,         mask, what,  remedy};
}

void NodeSetup::write(Kind kind, std::uint16_t index, std::uint8_t sub, std::uint8_t bytes,
                      std::uint32_t value, const char* what) {
  steps_[static_cast<std::size_t>(count_++)] = {kind,  sub,        bytes, index,
                                                value, 0xFFFFFFFF, what,  ""};
}

void NodeSetup::write(Kind kind, const cia402::Object& object, std::uint32_t value,
                      const char* what) {
  write(kind, object.index, object.sub, object.bytes, value, what);
}

}  // namespace tactus::can
