// InjectedValues: gives objects of the dictionary the values of injected faults during its
// lifetime.
#pragma once

#include "hal/can/protocol_canopen.hpp"
#include "hal/cia402/protocol.hpp"
#include "sim_plant/drives/dictionary.hpp"
#include "sim_plant/drives/faults.hpp"

namespace tactus::drives {

class InjectedValues {
 public:
  InjectedValues(Dictionary& dictionary, Faults& faults, std::int64_t syncs)
      : dictionary_(dictionary), faults_(faults), syncs_(syncs) {
    inject(FaultKind::kWrongMode, slot_of(0x6061));
    inject(FaultKind::kWrongIdentity, slot_of(can::kIdentity, 2));
    if (const Fault* fault = find(FaultKind::kNonsenseStatus))
      set(slot_of(0x6041), dictionary_.get(slot_of(0x6041)) | (fault->value & 0xFFFF));
    if (const Fault* fault = find(FaultKind::kWarning)) {
      set(slot_of(0x6041), dictionary_.get(slot_of(0x6041)) | cia402::kWarning);
      const bool faulty = (dictionary_.get(slot_of(0x6041)) & cia402::kFaultBit) != 0;
      if (fault->value != 0 && !faulty) set(slot_of(0x603F), fault->value);  // the newer one
    }
    if (find(FaultKind::kSaturatedTorque) != nullptr) set(slot_of(0x6077), 32767);
    if (const Fault* fault = find(FaultKind::kWrongMapping))
      for (std::uint16_t i = 0; i < kPdos; ++i)
        for (const std::uint16_t base : {can::kRpdoMapping, can::kTpdoMapping})
          set(drives::find(static_cast<std::uint16_t>(base + i), 1).slot, fault->value);
  }
  ~InjectedValues() {
    while (count_ > 0) {
      --count_;
      dictionary_.set(slots_[count_], originals_[count_]);
    }
  }
  InjectedValues(const InjectedValues&) = delete;
  InjectedValues& operator=(const InjectedValues&) = delete;

 private:
  const Fault* find(FaultKind kind) { return faults_.active(kind, syncs_); }
  void inject(FaultKind kind, Slot slot) {
    if (const Fault* fault = find(kind)) set(slot, fault->value);
  }
  void set(Slot slot, std::int64_t value) {
    slots_[count_] = slot;
    originals_[count_++] = dictionary_.get(slot);
    dictionary_.set(slot, value);
  }

  static constexpr std::size_t kMost = 6 + 2 * kPdos;

  Dictionary& dictionary_;
  Faults& faults_;
  std::int64_t syncs_;
  std::array<Slot, kMost> slots_{};
  std::array<std::int64_t, kMost> originals_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::drives
