// Slave: the drive of one joint on the segment, as its registers, EEPROM and mailbox show it; and
// the reader of its EEPROM.
#pragma once

#include "hal/cia402/drive_wire.hpp"
#include "hal/ethercat/coe_client.hpp"
#include "hal/ethercat/exchange.hpp"
#include "hal/ethercat/process_data.hpp"
#include "hal/ethercat/protocol_esc.hpp"

namespace tactus::ethercat {

inline constexpr std::uint16_t kFirstStation = 0x1001;  ///< address of the first slave

struct Identity {
  std::uint32_t vendor = 0, product = 0, revision = 0, serial = 0;
};

/// A sync manager of the process data, from the EEPROM.
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

  // The clock, at the moment of the latch, ns.
  std::uint32_t loop_ns = 0;   ///< from the frame's arrival until it returned from behind
  std::uint64_t local_ns = 0;  ///< wraps
  std::int64_t delay_ns = 0;

  // The cycle.
  std::uint16_t al_status = 0, al_code = 0;
  int unanswered = 0;  ///< consecutive state requests without an answer
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

/// The slaves in the order of the line.
class SlaveLine {
 public:
  explicit SlaveLine(Slaves& slaves) : slaves_(slaves) {}
  /// Says which joint, from 0, the slave at a place of the line, from 0, moves. [init]
  void set(int place, int joint) { joints_[static_cast<std::size_t>(place)] = joint; }
  int joint(int place) const { return joints_[static_cast<std::size_t>(place)]; }
  Slave& at(int place) { return slaves_[static_cast<std::size_t>(joint(place))]; }
  const Slave& at(int place) const { return slaves_[static_cast<std::size_t>(joint(place))]; }

 private:
  Slaves& slaves_;
  std::array<int, kDof> joints_{};
};

/// Reads two words of a slave's EEPROM at a time through its registers.
class SiiReader {
 public:
  static constexpr int kPolls = 1000;  ///< of a busy EEPROM

  enum class Progress : std::uint8_t { kBusy, kDone, kFailed };

  void begin(std::uint16_t station, std::uint16_t word) {
    station_ = station;
    by_position_ = false;
    word_ = word;
    asked_ = false;
    polls_ = 0;
    progress_ = Progress::kBusy;
  }
  /// As begin(), for a slave without a station address, by its place in the line, from 0.
  void begin_at(int position, std::uint16_t word) {
    begin(position_field(position), word);
    by_position_ = true;
  }
  Request next() const {
    const std::uint32_t control = address_of(station_, kEepromControlReg);
    if (asked_) return Request(by_position_ ? Command::kAprd : Command::kFprd, control, 10);
    Request request(by_position_ ? Command::kApwr : Command::kFpwr, control, 6);
    put(request.data.data(), kEepromRead);
    put(request.data.data() + 2, std::uint32_t{word_});
    return request;
  }
  void take(const Answer& answer) {
    if (!asked_) {
      asked_ = answer.counter == 1;
      if (!asked_) fail("the slave does not answer");
      return;
    }
    const std::uint16_t control = answer.word();
    const bool failed = answer.counter != 1 || (control & kEepromErrorBits) != 0;
    const bool busy = (control & kEepromBusy) != 0;
    control_ = answer.counter == 1 ? control : std::uint16_t{0};
    if (failed) fail(cause_of(answer.counter, control));
    if (!failed && busy && ++polls_ == kPolls) fail("it stays busy");
    if (failed || busy) return;
    value_ = get<std::uint32_t>(answer.data + 6);
    progress_ = Progress::kDone;
  }
  /// Why it failed; the word, and what its control register (0502h) shows. [any]
  const char* cause() const { return cause_; }
  std::uint16_t word() const { return word_; }
  std::uint16_t control() const { return control_; }
  Progress progress() const { return progress_; }
  /// The word at the lower address is the lower half. [any]
  std::uint32_t value() const { return value_; }

 private:
  static const char* cause_of(int counter, std::uint16_t control) {
    if (counter != 1) return "the slave does not answer";
    if ((control & kEepromError) != 0) return "it does not acknowledge (NACK)";
    return "writing to it is not enabled";
  }
  void fail(const char* cause) {
    cause_ = cause;
    progress_ = Progress::kFailed;
  }

  std::uint16_t station_ = 0, word_ = 0, control_ = 0;
  const char* cause_ = "";
  bool asked_ = false, by_position_ = false;
  int polls_ = 0;
  std::uint32_t value_ = 0;
  Progress progress_ = Progress::kDone;
};

/// Reads from the EEPROM of a slave what the start-up needs: identity, mailboxes and the sync
/// managers of its process data. Single datagrams; frames in, frames out.
class SlaveEeprom {
 public:
  /// Begins to read the EEPROM of a slave that has its station address. [init]
  void begin(Slave& slave);
  Request next() const { return reader_.next(); }
  /// Takes the answer to next(). kArming: there is more to read. kRefusedByRobot: `what` is the
  /// reason. [init]
  Status take(const Answer& answer, Message& what);

 private:
  Status take_word(Message& what);
  Status take_category(Message& what);
  Status judge(Message& what) const;
  Status judge_mailbox(const char* of, std::uint16_t word, std::uint16_t bytes,
                       Message& what) const;

  Slave* slave_ = nullptr;
  SiiReader reader_;
  bool walks_ = false;          // from category to category
  int step_ = 0;                // number of the word, or half of a sync manager
  std::uint16_t category_ = 0;  // word that is read next
  std::uint16_t end_ = 0;       // of the category of the sync managers; 0: not found yet
  int categories_ = 0, sm_ = 0;
  std::uint32_t sm_half_ = 0;  // start and length of the present sync manager
};

}  // namespace tactus::ethercat
