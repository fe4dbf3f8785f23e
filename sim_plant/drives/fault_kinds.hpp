// The kinds of fault that can be injected into an emulated drive, and their names.
#pragma once

#include <array>
#include <cstdint>

namespace tactus::drives {

enum class FaultKind : std::uint8_t {
  kDropTpdo,          ///< TPDOs are not sent
  kDuplicateTpdo,     ///< each is sent twice
  kDelayTpdo,         ///< each is sent at the next SYNC
  kTruncateTpdo,      ///< the last byte is missing
  kStopHeartbeat,     ///< no heartbeat
  kEmergency,         ///< EMCY with code `value`, and fault; once
  kSwitchOnDisabled,  ///< drops into "switch on disabled"; once
  kWrongMode,         ///< 6061h shows `value`
  kBrakeStuck,        ///< the brake does not open: after 500 ms fault 7121h
  kSdoAbort,          ///< requests for index `value` are aborted with `abort`; 0: all requests
  kSdoSilence,        ///< requests for index `value` are not answered; 0: all requests
  kWrongIdentity,     ///< 1018h:2 reads `value`
  kWrongMapping,      ///< the first entry of every mapping reads `value`
  kNonsenseStatus,    ///< the statusword has the bits `value` in addition
  kSaturatedTorque,   ///< 6077h shows 32767
  kReboot,            ///< resets itself and sends boot-up; once
  kWarning,           ///< statusword bit 7; 603Fh shows `value`, 0: what it did
  kHomingFails,       ///< `value` 1: does not end; 2, 3: an error at rest, or while it moves
};

/// Names of the kinds in their order, as the program's option has them.
inline constexpr std::array<const char*, 18> kFaultNames = {
    "drop_tpdo",      "duplicate_tpdo",  "delay_tpdo",         "truncate_tpdo",
    "stop_heartbeat", "emergency",       "switch_on_disabled", "wrong_mode",
    "brake_stuck",    "sdo_abort",       "sdo_silence",        "wrong_identity",
    "wrong_mapping",  "nonsense_status", "saturated_torque",   "reboot",
    "warning",        "homing_fails"};

}  // namespace tactus::drives
