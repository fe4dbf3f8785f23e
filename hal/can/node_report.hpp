// NodeReport: identity, state and objects that a node of a CANopen bus reports.
#pragma once

#include <array>
#include <cstdint>

#include "hal/can/protocol_canopen.hpp"
#include "hal/can/sdo_client.hpp"
#include "kernel/core/text.hpp"

namespace tactus::can {

/// Numbers of a node; those from kErrorCode on are a drive's (CiA 402).
enum class Item : std::uint8_t {
  kType,  ///< 1000h
  kVendor,
  kProduct,
  kRevision,
  kSerial,
  kRegister,  ///< 1001h
  kErrorCount,
  kHeartbeatTime,
  kErrorCode,
  kStatusword,
  kModeDisplay,
  kSupportedModes,
  kRatedTorque,
  kIncrements,
  kRevolutions,
};
inline constexpr int kItems = 15;

/// Texts of a node.
enum class Label : std::uint8_t { kName, kHardware, kFirmware };
inline constexpr int kLabels = 3;

/// A PDO as its node has it set up.
struct PdoReport {
  static constexpr int kMostEntries = 16;  ///< of the mapping that are read

  bool known = false;
  std::uint32_t id = kPdoInvalid;  ///< COB-ID with its flags
  std::uint8_t type = 0;
  int count = 0;  ///< entries reported by the node; more than kMostEntries are not in `entries`
  std::array<std::uint32_t, kMostEntries> entries{};

  bool valid() const { return known && (id & kPdoInvalid) == 0; }
};

struct NodeReport {
  static constexpr int kPdos = 4;         ///< of each direction
  static constexpr int kMostHistory = 8;  ///< entries of the error history that are read
  using Label = Text<SdoClient::kCapacity>;

  bool answers = false;  ///< to SDO requests
  bool heard = false;    ///< a heartbeat or the boot-up message arrived; `nmt` is of the last one
  bool sends_pdos = false;  ///< with its identifiers of the predefined connection set
  NmtState nmt = NmtState::kBootUp;
  std::array<std::uint32_t, kItems> items{};
  std::uint32_t known = 0;  ///< a bit for each item that was read
  std::array<Label, kLabels> labels;
  std::array<std::uint32_t, kMostHistory> history{};  ///< the newest first
  int history_count = 0;
  std::array<PdoReport, kPdos> rpdos, tpdos;
  Message trouble;  ///< why reading was given up; empty: it was not

  bool has(Item item) const { return (known >> static_cast<int>(item) & 1U) != 0; }
  std::uint32_t get(Item item) const { return items[static_cast<std::size_t>(item)]; }
  void set(Item item, std::uint32_t value) {
    items[static_cast<std::size_t>(item)] = value;
    known |= 1U << static_cast<int>(item);
  }
  const Label& label(can::Label of) const { return labels[static_cast<std::size_t>(of)]; }
  bool present() const { return answers || heard; }
  /// A stopped node does not take part in SDO. [any]
  bool may_answer() const { return answers || (heard && nmt != NmtState::kStopped); }
};

}  // namespace tactus::can
