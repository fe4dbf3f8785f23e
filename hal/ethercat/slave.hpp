// Slave: the drive of one joint on the segment, as its registers, EEPROM and mailbox show it.
#pragma once

#include "hal/cia402/drive_wire.hpp"
#include "hal/ethercat/mailbox_port.hpp"
#include "hal/ethercat/process_data.hpp"

namespace tactus::ethercat {

struct Identity {
  std::uint32_t vendor = 0, product = 0, revision = 0, serial = 0;
};

/// A sync manager of the process data, as the EEPROM says.
struct Area {
  int sm = -1;  ///< -1: there is none
  std::uint16_t start = 0;
  std::uint8_t control = 0;
};

struct Slave {
  int position = 0;  ///< in the line, from 0
  Mailboxes boxes;
  Identity identity;
  Area outputs, inputs;
  std::uint8_t mailbox_out_control = kMailboxOutControl, mailbox_in_control = kMailboxInControl;
  std::uint16_t features = 0;
  ProcessData data;

  // Of the clock, at the moment of the latch, ns.
  std::uint32_t loop_ns = 0;   ///< from the frame's arrival until it came back from behind
  std::uint64_t local_ns = 0;  ///< wraps
  std::int64_t delay_ns = 0;

  // Of the cycle.
  std::uint16_t al_status = 0, al_code = 0;
  int unanswered = 0;  ///< times in a row that it was asked for its state
  cia402::DriveFeedback feedback;

  bool has_clock() const { return (features & kHasClock) != 0; }
};
using Slaves = std::array<Slave, kDof>;  ///< by joint

/// "joint 3 (slave 3)": how messages name a drive. [any]
inline Message label(int joint, const Slave& slave) {
  Message text("joint ");
  text << joint + 1 << " (slave " << slave.position + 1 << ")";
  return text;
}

}  // namespace tactus::ethercat
