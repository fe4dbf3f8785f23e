// Faults: the handlers, and the record that survives the reset.
#include "boards/bare_metal/fault_record.hpp"
#include "boards/bare_metal/registers.hpp"
#include "hal/serial/crc32.hpp"

namespace bare {

/// As memory is when the board is switched on, the check sum is wrong.
struct Kept {
  std::uint32_t magic;
  FaultRecord record;
  std::uint32_t sum;
};

}  // namespace bare

extern "C" {
extern bare::Kept kept_fault;  // placed by the linker script, where no start-up touches it
extern std::uint32_t fault_stack_top, cycle_stack_limit, cycle_stack_top, work_stack_limit,
    work_stack_top;
void on_fault();
[[noreturn]] void keep_fault(const std::uint32_t* frame, std::uint32_t number);
}

namespace bare {
namespace {

constexpr std::uint32_t kMagic = 0x7AC7C0DE;

/// Check sum of the record in memory.
std::uint32_t sum() {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&kept_fault.record);
  return tactus::serial::crc32<sizeof(FaultRecord)>(bytes, sizeof(FaultRecord));
}

/// A core with a stack limit that found no room for a frame has left the stack pointer at the
/// limit.
bool above(const std::uint32_t& limit, std::uint32_t address, const std::uint32_t& top) {
  return address > reinterpret_cast<std::uintptr_t>(&limit) &&
         address < reinterpret_cast<std::uintptr_t>(&top);
}

}  // namespace

const FaultRecord& fault_record() {
  if (kept_fault.magic != kMagic || kept_fault.sum != sum()) {
    kept_fault.magic = kMagic;
    kept_fault.record = FaultRecord();
    kept_fault.sum = sum();
  }
  return kept_fault.record;
}

void forget_fault() {
  const std::uint32_t count = fault_record().count;
  kept_fault.record = FaultRecord();
  kept_fault.record.count = count;
  kept_fault.sum = sum();
}

void end_with(const FaultRecord& record) {
  asm volatile("cpsid i");
  const std::uint32_t count = fault_record().count + 1;
  kept_fault.record = record;
  kept_fault.record.count = count;
  kept_fault.record.cycle = cycle_number();
  kept_fault.sum = sum();
  send_disable();
  asm volatile("dsb");
  at(kAircr) = kSystemReset;
  for (;;) {
  }
}

}  // namespace bare

/// The stack of the program may be what failed: the handlers have one of their own.
extern "C" [[gnu::naked, gnu::used]] void on_fault() {
  asm volatile(
      "tst lr, #4\n ite eq\n mrseq r0, msp\n mrsne r0, psp\n mrs r1, ipsr\n"
      "ldr r2, =fault_stack_top\n mov sp, r2\n b keep_fault\n");
}

extern "C" [[gnu::used]] void keep_fault(const std::uint32_t* frame, std::uint32_t number) {
  using namespace bare;
  constexpr std::uint32_t kNmi = 2, kStackingFailed = 1U << 4, kAddressKnown = 1U << 7;
  constexpr std::uint32_t kMpuViolation = 1U << 1;
  constexpr std::uint32_t kBelowLimit = 1U << 20;  // of a stack, from Armv8-M on
  FaultRecord record;
  record.cfsr = at(kCfsr);
  record.hfsr = at(kHfsr);
  record.address = at((record.cfsr & kAddressKnown) != 0 ? kMmfar : kBfar);
  record.sp = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(frame));
  const bool stacked = above(cycle_stack_limit, record.sp, cycle_stack_top) ||
                       above(work_stack_limit, record.sp, work_stack_top);
  const bool full = (record.cfsr & (kStackingFailed | kMpuViolation | kBelowLimit)) != 0;
  if (stacked && (record.cfsr & kStackingFailed) == 0) {
    record.lr = frame[5];
    record.pc = frame[6];
  }
  record.cause = number == kNmi ? FaultCause::kWatchdog
                 : full         ? FaultCause::kStack
                                : FaultCause::kFault;
  end_with(record);
}

extern "C" [[noreturn]] void abort() {
  bare::FaultRecord record;
  record.cause = bare::FaultCause::kAbort;
  record.pc =
      static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(__builtin_return_address(0)));
  bare::end_with(record);
}
