// Esc: an emulated EtherCAT slave controller: memory of registers and process data, sync managers,
// FMMUs, EEPROM, clock and watchdog. Datagrams come from the wire, process() carries them out in
// place; the other functions are for the application behind it. Time is passed in.
//
// Not modelled: ports (the segment knows the line), EEPROM writes, the pulses of SYNC0 and
// SYNC1, latch pins,
// interrupts of the frames, and the three buffers of a buffered sync manager, which are one.
#pragma once

#include <array>

#include "hal/ethercat/protocol_esc.hpp"
#include "hal/ethercat/protocol_frame.hpp"
#include "sim_plant/ethercat/esc_clock.hpp"
#include "sim_plant/ethercat/sii_image.hpp"

namespace tactus::segment {

/// A sync manager as its registers say.
struct SyncManager {
  std::uint16_t start = 0, length = 0;
  std::uint8_t control = 0, status = 0, activate = 0;

  bool enabled() const { return (activate & ethercat::kSmEnabled) != 0 && length > 0; }
  bool mailbox() const { return (control & ethercat::kSmModeBits) == ethercat::kSmMailbox; }
  bool written() const {  ///< by the master
    return (control & ethercat::kSmDirectionBits) == ethercat::kSmWritten;
  }
  bool full() const { return (status & ethercat::kSmFull) != 0; }
  bool covers(std::size_t at, std::size_t size) const {
    return at < std::size_t{start} + length && start < at + size;
  }
};

class Esc {
 public:
  static constexpr std::size_t kMemory = 0x3000;
  static constexpr std::size_t kSms = 4, kFmmus = 4;

  /// Power comes on. The image must outlive the controller. Without `lrw` it shows that it does not
  /// have this command, and lets it pass. [init]
  void power_on(const SiiImage& image, const EscClock& clock, bool lrw = true);

  /// Carries out a datagram that arrives at `now_ns`. [cyclic]
  void process(const ethercat::Datagram& datagram, std::int64_t now_ns);
  /// Notes when the frame came back, for its port times. [cyclic]
  void note_return(std::int64_t now_ns, bool last);
  /// The watchdog of the outputs. [cyclic]
  void advance(std::int64_t now_ns);

  /// The state that the master requests, once. [any]
  bool take_request(std::uint16_t& control);
  /// Shows a state and a status code. [any]
  void show(std::uint16_t status, std::uint16_t code);
  std::uint16_t status() const;

  SyncManager sm(std::size_t i) const;
  /// The bytes of a sync manager; null if they are outside of the memory. [any]
  std::uint8_t* bytes(std::size_t i);
  /// Marks a mailbox as full or empty. [any]
  void set_full(std::size_t i, bool full);
  /// True if the outputs came since the last call. [cyclic]
  bool take_outputs();
  /// True once after the outputs were missing for too long. [cyclic]
  bool take_expired();
  /// The register's value, as the application sees it. [any]
  std::uint16_t reg16(std::uint16_t reg) const;
  void set_line(bool last);
  EscClock& clock() { return clock_; }
  /// True if SYNC0 is on, and its start time had not passed when it was switched on. [any]
  bool sync0() const { return sync0_; }
  std::uint32_t reg32(std::uint16_t reg) const;

 private:
  using Datagram = ethercat::Datagram;

  void physical(const Datagram& datagram, bool reads, bool writes, bool joins);
  bool addressed(const Datagram& datagram) const;
  void logical(const Datagram& datagram, bool reads, bool writes);
  bool map(std::size_t fmmu, const Datagram& datagram, bool writes, const std::uint8_t* from);
  bool map_bits(std::size_t fmmu, const Datagram& datagram, bool writes, const std::uint8_t* from);
  // esc_memory.cpp: access to registers and memory
  bool read(std::size_t at, std::uint8_t* into, std::size_t size, bool joins);
  bool write(std::size_t at, const std::uint8_t* from, std::size_t size);
  bool allows(std::size_t at, std::size_t size, bool writes) const;
  void complete(std::size_t at, std::size_t size, bool writes);
  void write_registers(std::size_t at, const std::uint8_t* from, std::size_t size);
  void write_sm(std::size_t at, std::uint8_t value);
  void after_write(std::size_t at, std::size_t size, const std::uint8_t* from);
  void serve_eeprom();

  std::array<std::uint8_t, kMemory> memory_{};
  std::array<bool, kSms> open_{};  // mailboxes of which the master has accessed the first byte
  const SiiImage* image_ = nullptr;
  EscClock clock_;
  std::int64_t now_ns_ = 0, outputs_ns_ = -1, port_ns_ = 0;
  bool requested_ = false, outputs_ = false, expired_ = false, latched_ = false, sync0_ = false;
};

}  // namespace tactus::segment
