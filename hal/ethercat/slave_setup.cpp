#include "hal/ethercat/slave_setup.hpp"

#include "hal/can/protocol_canopen.hpp"
#include "hal/ethercat/protocol_coe.hpp"

namespace tactus::ethercat {
namespace {

// Options of a drive (CiA 402): what it does by itself.
constexpr std::uint32_t kRampThenOff = 2;  // quick stop and fault reaction: the quick-stop ramp
constexpr std::uint32_t kFaultOnLostMaster = 1;  // abort of the connection

// Types of synchronization (ETG.1020).
constexpr std::uint16_t kOutputSync = 0x1C32, kInputSync = 0x1C33;
constexpr std::uint32_t kBySync0 = 2;

}  // namespace

void SlaveSetup::begin(const EthercatSettings& ethercat, CommandMode mode, int period_us) {
  count_ = 0;
  identity(ethercat, mode);
  identifying_ = count_;
  facts();
  options(mode, period_us);
  if (ethercat.has_sync0()) sync0();
  pdo(kRxAssign, kRxMapping, objects_of_outputs(mode));
  pdo(kTxAssign, kTxMapping, objects_of_inputs());
}

void SlaveSetup::identity(const EthercatSettings& ethercat, CommandMode mode) {
  expect(can::kDeviceType, 0, cia402::kDriveProfile, "profile of the device",
         "a CiA 402 drive is needed; check [ethercat] slave", 0xFFFF);
  if (ethercat.vendor != 0)
    expect(can::kIdentity, 1, static_cast<std::uint32_t>(ethercat.vendor), "vendor",
           "check [ethercat] vendor");
  if (ethercat.product != 0)
    expect(can::kIdentity, 2, static_cast<std::uint32_t>(ethercat.product), "product",
           "check [ethercat] product");
  const std::uint32_t bit = 1U << (static_cast<int>(cia402::mode_of(mode)) - 1);
  expect(cia402::kSupportedModes.index, 0, bit, "supported modes",
         "the drive does not have the mode that [robot] commands", bit);
  fact(cia402::kIdentityFact);
}

void SlaveSetup::fact(std::uint32_t row) {
  const auto& [object, what] = cia402::kFacts[row];
  steps_[static_cast<std::size_t>(count_++)] = {
      SetupStep::Kind::kFact, object.sub, 0, object.index, row, 0xFFFFFFFF, what, ""};
}

/// Writes the lines of the file before the facts, as they may set one; only the identity is first.
void SlaveSetup::facts() {
  steps_[static_cast<std::size_t>(count_++)].kind = SetupStep::Kind::kLines;
  for (std::uint32_t i = cia402::kIdentityFact + 1; i < cia402::kFactCount; ++i) fact(i);
  write(cia402::kStoreParameters, cia402::kSaveSignature,
        "its parameters cannot be stored, [cia402] store and store_ms");
  steps_[static_cast<std::size_t>(count_ - 1)].kind = SetupStep::Kind::kStore;
}

void SlaveSetup::options(CommandMode mode, int period_us) {
  write(cia402::kAbortConnectionOption, kFaultOnLostMaster, "abort connection option");
  write(cia402::kQuickStopOption, kRampThenOff, "quick stop option");
  write(cia402::kFaultReactionOption, kRampThenOff, "fault reaction option");
  const auto [value, index] = cia402::period_object(period_us);
  write(cia402::kPeriodValue, value, "interpolation time");
  write(cia402::kPeriodIndex, static_cast<std::uint8_t>(index), "interpolation time index");
  // Where it is mapped, the cycle writes it too; arming reads its display.
  write(cia402::kModeOfOperation, static_cast<std::uint8_t>(cia402::mode_of(mode)),
        "mode of operation");
}

void SlaveSetup::sync0() {
  write(kOutputSync, 1, 2, kBySync0, "synchronization of the outputs");
  write(kInputSync, 1, 2, kBySync0, "synchronization of the inputs");
}

void SlaveSetup::pdo(std::uint16_t assignment, std::uint16_t mapping,
                     const MappedObjects& objects) {
  write(assignment, 0, 1, 0, "number of assigned PDOs");
  write(mapping, 0, 1, 0, "number of mapped objects");
  for (int i = 0; i < objects.count; ++i)
    write(mapping, static_cast<std::uint8_t>(i + 1), 4,
          objects.list[static_cast<std::size_t>(i)].mapping(), "mapped object");
  write(mapping, 0, 1, static_cast<std::uint32_t>(objects.count), "number of mapped objects");
  write(assignment, 1, 2, mapping, "assigned PDO");
  write(assignment, 0, 1, 1, "number of assigned PDOs");
}

void SlaveSetup::expect(std::uint16_t index, std::uint8_t sub, std::uint32_t value,
                        const char* what, const char* remedy, std::uint32_t mask) {
  steps_[static_cast<std::size_t>(count_++)] = {
      SetupStep::Kind::kExpect, sub, 0, index, value, mask, what, remedy};
}

void SlaveSetup::write(std::uint16_t index, std::uint8_t sub, std::uint8_t bytes,
                       std::uint32_t value, const char* what) {
  steps_[static_cast<std::size_t>(count_++)] = {
      SetupStep::Kind::kMayWrite, sub, bytes, index, value, 0xFFFFFFFF, what, ""};
}

void MappingReader::begin(ProcessData& data) {
  data_ = &data;
  data.outputs.clear();
  data.inputs.clear();
  inputs_ = done_ = false;
  listed_ = 0;
  pdo_ = -1;
}

bool MappingReader::take(std::uint32_t value) {
  if (pdo_ >= 0) {
    if (entry_ == 0) {
      entries_ = static_cast<int>(value & 0xFF);
    } else {
      ProcessLayout& layout = inputs_ ? data_->inputs : data_->outputs;
      if (!layout.add(value)) return false;
    }
    return entry_++ < entries_ || next_pdo();
  }
  if (listed_ == 0) {
    pdos_count_ = static_cast<int>(value & 0xFF);
    if (pdos_count_ > kMostPdos) return false;
  } else {
    pdos_[static_cast<std::size_t>(listed_ - 1)] = static_cast<std::uint16_t>(value);
  }
  return listed_++ < pdos_count_ || next_pdo();
}

bool MappingReader::next_pdo() {
  if (++pdo_ == pdos_count_) {
    next_direction();
    return true;
  }
  mapped_ = pdos_[static_cast<std::size_t>(pdo_)];
  entry_ = entries_ = 0;
  return true;
}

void MappingReader::next_direction() {
  done_ = inputs_;
  inputs_ = true;
  listed_ = 0;
  pdo_ = -1;
}

}  // namespace tactus::ethercat
