// Registers of an EtherCAT slave controller, ESC (IEC 61158-4-12), AL states and status codes,
// FMMUs and sync managers. Both ends share them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus::ethercat {

// Registers, by their address.
inline constexpr std::uint16_t kTypeReg = 0x0000;  // type, revision, build; FMMUs, SMs, RAM, ports
inline constexpr std::uint16_t kFeaturesReg = 0x0008;  // u16
inline constexpr std::uint16_t kStationReg = 0x0010;   // u16
inline constexpr std::uint16_t kAliasReg = 0x0012;     // u16
inline constexpr std::uint16_t kDlControlReg = 0x0100, kDlStatusReg = 0x0110;
inline constexpr std::uint16_t kAlControlReg = 0x0120, kAlStatusReg = 0x0130, kAlCodeReg = 0x0134;
inline constexpr std::uint16_t kPdiControlReg = 0x0140;
inline constexpr std::uint16_t kEventMaskReg = 0x0200, kEventRequestReg = 0x0210,
                               kAlEventReg = 0x0220;
inline constexpr std::uint16_t kErrorCountersReg = 0x0300;  // 20 bytes
inline constexpr std::size_t kErrorCounters = 0x14;
inline constexpr std::uint16_t kWatchdogDividerReg = 0x0400, kPdiWatchdogReg = 0x0410,
                               kDataWatchdogReg = 0x0420, kWatchdogStatusReg = 0x0440,
                               kWatchdogCounterReg = 0x0442;
inline constexpr std::uint16_t kEepromOwnerReg = 0x0500, kEepromControlReg = 0x0502,
                               kEepromAddressReg = 0x0504, kEepromDataReg = 0x0508;
inline constexpr std::uint16_t kFmmuReg = 0x0600;  // 16 bytes each
inline constexpr std::uint16_t kSmReg = 0x0800;    // 8 bytes each
inline constexpr std::uint16_t kPortTimesReg = 0x0900, kSystemTimeReg = 0x0910,
                               kUnitTimeReg = 0x0918, kTimeOffsetReg = 0x0920,
                               kTimeDelayReg = 0x0928, kTimeDifferenceReg = 0x092C,
                               kTimeSpeedReg = 0x0930;
inline constexpr std::uint16_t kDcControlReg = 0x0980, kSyncStartReg = 0x0990,
                               kSyncCycleReg = 0x09A0;
inline constexpr std::uint16_t kRam = 0x1000;

/// kDcControlReg: the cyclic unit runs, and gives SYNC0.
inline constexpr std::uint16_t kSync0On = 0x0300;

// Features, kFeaturesReg.
inline constexpr std::uint16_t kHasClock = 0x0004, kHasLongClock = 0x0008, kNoLrw = 0x0200;

/// Watchdog: units of (divider + 2) * 40 ns; this divider makes it 100 us.
inline constexpr std::uint16_t kDivider100us = 2498;

/// States of the application layer, AL. In the control and the status register, bit 4 is
/// "acknowledge" and "error".
enum class AlState : std::uint8_t {
  kNone = 0,
  kInit = 1,
  kPreop = 2,
  kBoot = 3,
  kSafeop = 4,
  kOp = 8
};
inline constexpr std::uint16_t kAlStateBits = 0x000F, kAlErrorBit = 0x0010;

/// Returns the name of a state, never null. [any]
constexpr const char* name(AlState state) {
  switch (state) {
    case AlState::kInit: return "INIT";
    case AlState::kPreop: return "PREOP";
    case AlState::kBoot: return "BOOT";
    case AlState::kSafeop: return "SAFEOP";
    case AlState::kOp: return "OP";
    case AlState::kNone: break;
  }
  return "no state";
}

struct AlCodeText {
  std::uint16_t code;
  const char* text;
};
inline constexpr std::uint16_t kAlInvalidChange = 0x0011, kAlUnknownState = 0x0012,
                               kAlMailboxSetup = 0x0016, kAlSmSetup = 0x0017, kAlNoOutputs = 0x0019,
                               kAlWatchdog = 0x001B, kAlOutputSetup = 0x001D,
                               kAlInputSetup = 0x001E, kAlNoSync = 0x002D, kAlSyncSetup = 0x0030,
                               kAlSyncCycle = 0x0035, kAlSync0Cycle = 0x0036;

inline constexpr AlCodeText kAlCodes[] = {
    {0x0000, "no error"},
    {0x0001, "unspecified error"},
    {0x0002, "no memory"},
    {0x0011, "invalid requested state change"},
    {0x0012, "unknown requested state"},
    {0x0013, "bootstrap not supported"},
    {0x0014, "no valid firmware"},
    {0x0015, "invalid mailbox configuration for BOOT"},
    {0x0016, "invalid mailbox configuration"},
    {0x0017, "invalid sync manager configuration"},
    {0x0018, "no valid inputs"},
    {0x0019, "no valid outputs"},
    {0x001A, "synchronization error"},
    {0x001B, "sync manager watchdog"},
    {0x001C, "invalid sync manager types"},
    {0x001D, "invalid output configuration"},
    {0x001E, "invalid input configuration"},
    {0x001F, "invalid watchdog configuration"},
    {0x0020, "needs a cold start"},
    {0x0021, "needs INIT"},
    {0x0022, "needs PREOP"},
    {0x0023, "needs SAFEOP"},
    {0x0024, "invalid input mapping"},
    {0x0025, "invalid output mapping"},
    {0x0026, "inconsistent settings"},
    {0x0027, "free run not supported"},
    {0x0028, "synchronization not supported"},
    {0x0029, "free run needs three buffers"},
    {0x002A, "background watchdog"},
    {0x002B, "no valid inputs and outputs"},
    {0x002C, "fatal synchronization error"},
    {0x002D, "no synchronization pulse"},
    {0x0030, "invalid clock synchronization configuration"},
    {0x0031, "invalid clock latch configuration"},
    {0x0032, "PLL error"},
    {0x0033, "clock synchronization: input or output error"},
    {0x0034, "clock synchronization time-out"},
    {0x0035, "invalid clock cycle time"},
    {0x0036, "invalid SYNC0 cycle time"},
    {0x0037, "invalid SYNC1 cycle time"},
    {0x0041, "mailbox AoE"},
    {0x0042, "mailbox EoE"},
    {0x0043, "mailbox CoE"},
    {0x0044, "mailbox FoE"},
    {0x0045, "mailbox SoE"},
    {0x004F, "mailbox VoE"},
    {0x0050, "EEPROM not accessible"},
    {0x0051, "EEPROM error"},
    {0x0060, "slave restarted"},
};

/// Returns what an AL status code means, never null. [any]
constexpr const char* al_code_text(std::uint16_t code) {
  for (const AlCodeText& row : kAlCodes)
    if (row.code == code) return row.text;
  return "unknown";
}

/// True if this code of a drive means that SYNC0 is missing, or does not have its period. [any]
constexpr bool concerns_sync0(std::uint16_t code) {
  return code == kAlNoSync || code == kAlSyncSetup || code == kAlSyncCycle || code == kAlSync0Cycle;
}

// A sync manager: start u16, length u16, control, status, activate, PDI control.
inline constexpr std::size_t kSmBytes = 8, kMostSms = 16;
inline constexpr std::uint8_t kSmModeBits = 0x03, kSmMailbox = 0x02, kSmDirectionBits = 0x0C,
                              kSmWritten = 0x04, kSmWatchdog = 0x40;
inline constexpr std::uint8_t kSmFull = 0x08;     // of its status
inline constexpr std::uint8_t kSmEnabled = 0x01;  // of its activate
inline constexpr std::uint8_t kMailboxOutControl = 0x26, kMailboxInControl = 0x22,
                              kOutputsControl = 0x64, kInputsControl = 0x20;

// An FMMU: logical u32, length u16, first bit, last bit, physical u16, its bit, type, activate.
inline constexpr std::size_t kFmmuBytes = 16, kMostFmmus = 16;
inline constexpr std::uint8_t kFmmuRead = 0x01, kFmmuWrite = 0x02;

// Control of the EEPROM.
inline constexpr std::uint16_t kEepromRead = 0x0100, kEepromCommandBits = 0x0700,
                               kEepromReads8 = 0x0040, kEepromError = 0x2000, kEepromBusy = 0x8000,
                               kEepromErrorBits = 0x6000;

// SII, the slave information in the EEPROM of a slave (ETG.1000.6): words and categories.
// Addresses of 16-bit words.
inline constexpr std::uint16_t kSiiChecksum = 0x07, kSiiVendor = 0x08, kSiiProduct = 0x0A,
                               kSiiRevision = 0x0C, kSiiSerial = 0x0E, kSiiMailboxOut = 0x18,
                               kSiiMailboxIn = 0x1A, kSiiProtocols = 0x1C, kSiiSize = 0x3E,
                               kSiiVersion = 0x3F, kSiiCategories = 0x40;
inline constexpr std::uint16_t kSiiCoe = 0x0004;  ///< of the protocols

// Types of categories; each begins with its type and the number of its words.
inline constexpr std::uint16_t kSiiStrings = 10, kSiiGeneral = 30, kSiiFmmus = 40, kSiiSms = 41,
                               kSiiTxPdos = 50, kSiiRxPdos = 51, kSiiEnd = 0xFFFF;
// Use of a sync manager, the last byte of its 8 in the category.
inline constexpr std::uint8_t kSiiMailboxOutSm = 1, kSiiMailboxInSm = 2, kSiiOutputsSm = 3,
                              kSiiInputsSm = 4;

}  // namespace tactus::ethercat
