// Lies: while one exists, objects of the dictionary read what injected faults make them read.
#pragma once

#include "hal/can/protocol_canopen.hpp"
#include "hal/cia402/protocol.hpp"
#include "sim_plant/drives/dictionary.hpp"
#include "sim_plant/drives/faults.hpp"

namespace tactus::drives {

class Lies {
 public:
  Lies(Dictionary& dictionary, Faults& faults, std::int64_t syncs)
      : dictionary_(dictionary), faults_(faults), syncs_(syncs) {
    tell(FaultKind::kWrongMode, slot_of(0x6061));
    tell(FaultKind::kWrongIdentity, slot_of(can::kIdentity, 2));
    if (const Fault* fault = find(FaultKind::kNonsenseStatus))
      set(slot_of(0x6041), dictionary_.get(slot_of(0x6041)) | (fault->value & 0xFFFF));
    if (const Fault* fault = find(FaultKind::kWarning)) {
      set(slot_of(0x6041), dictionary_.get(slot_of(0x6041)) | cia402::kWarning);
      const auto word = static_cast<std::uint16_t>(dictionary_.get(slot_of(0x6041)));
      const cia402::State state = cia402::state_of(word);
      const bool faulty = state == cia402::State::kFault ||
                          state == cia402::State::kFaultReactionActive;  // whose code is the newer
      if (fault->value != 0 && !faulty) set(slot_of(0x603F), fault->value);
    }
    if (find(FaultKind::kSaturatedTorque) != nullptr) set(slot_of(0x6077), 32767);
    if (const Fault* fault = find(FaultKind::kWrongMapping))
      for (std::uint16_t i = 0; i < kPdos; ++i)
        for (const std::uint16_t base : {can::kRpdoMapping, can::kTpdoMapping})
          set(drives::find(static_cast<std::uint16_t>(base + i), 1).slot, fault->value);
  }
  ~Lies() {
    while (count_ > 0) {
      --count_;
      dictionary_.set(slots_[count_], truths_[count_]);
    }
  }
  Lies(const Lies&) = delete;
  Lies& operator=(const Lies&) = delete;

 private:
  const Fault* find(FaultKind kind) { return faults_.active(kind, syncs_); }
  void tell(FaultKind kind, Slot slot) {
    if (const Fault* fault = find(kind)) set(slot, fault->value);
  }
  void set(Slot slot, std::int64_t value) {
    slots_[count_] = slot;
    truths_[count_++] = dictionary_.get(slot);
    dictionary_.set(slot, value);
  }

  static constexpr std::size_t kMost = 6 + 2 * kPdos;

  Dictionary& dictionary_;
  Faults& faults_;
  std::int64_t syncs_;
  std::array<Slot, kMost> slots_{};
  std::array<std::int64_t, kMost> truths_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::drives
