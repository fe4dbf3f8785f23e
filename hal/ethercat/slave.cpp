#include "hal/ethercat/slave.hpp"

#include <iterator>

#include "hal/cia402/hex.hpp"

namespace tactus::ethercat {
namespace {

constexpr std::uint16_t kWords[] = {kSiiVendor,     kSiiProduct,   kSiiRevision, kSiiSerial,
                                    kSiiMailboxOut, kSiiMailboxIn, kSiiProtocols};
constexpr int kWordCount = static_cast<int>(std::size(kWords));
constexpr int kMostCategories = 64;
constexpr std::uint16_t kSmWords = 4;  // of one sync manager in its category
constexpr const char* kRemedy =
    "; power the drive off and on; if it stays so, write its EEPROM with its maker's tool";

std::uint16_t low(std::uint32_t value) {
  return static_cast<std::uint16_t>(value);
}
std::uint16_t high(std::uint32_t value) {
  return static_cast<std::uint16_t>(value >> 16);
}

}  // namespace

void SlaveEeprom::begin(Slave& slave) {
  slave_ = &slave;
  walks_ = false;
  step_ = 0;
  reader_.begin(slave.boxes.station, kWords[0]);
}

Status SlaveEeprom::take(const Answer& answer, Message& what) {
  reader_.take(answer);
  if (reader_.progress() == SiiReader::Progress::kBusy) return Status::kArming;
  if (reader_.progress() == SiiReader::Progress::kDone)
    return walks_ ? take_category(what) : take_word(what);
  what << "its EEPROM cannot be read at word " << std::string_view(cia402::hex(reader_.word()))
       << ": " << reader_.cause() << " (0502h is "
       << std::string_view(cia402::hex(reader_.control())) << ")" << kRemedy;
  return Status::kRefusedByRobot;
}

Status SlaveEeprom::take_word(Message& what) {
  Slave& slave = *slave_;
  const std::uint32_t value = reader_.value();
  switch (kWords[step_]) {
    case kSiiVendor: slave.identity.vendor = value; break;
    case kSiiProduct: slave.identity.product = value; break;
    case kSiiRevision: slave.identity.revision = value; break;
    case kSiiSerial: slave.identity.serial = value; break;
    case kSiiMailboxOut:
      slave.boxes.out = low(value);
      slave.boxes.out_bytes = high(value);
      break;
    case kSiiMailboxIn:
      slave.boxes.in = low(value);
      slave.boxes.in_bytes = high(value);
      break;
    default:
      if ((value & kSiiCoe) == 0) {
        what << "by its EEPROM (word 001Ch) it has no CoE mailbox and is no CiA 402 drive; if it "
                "is one, write its EEPROM with its maker's tool";
        return Status::kRefusedByRobot;
      }
  }
  if (++step_ < kWordCount) {
    reader_.begin(slave.boxes.station, kWords[step_]);
    return Status::kArming;
  }
  walks_ = true;
  category_ = kSiiCategories;
  end_ = 0;
  categories_ = 0;
  reader_.begin(slave.boxes.station, category_);
  return Status::kArming;
}

/// Walks from category to category until that of the sync managers, and reads it.
Status SlaveEeprom::take_category(Message& what) {
  Slave& slave = *slave_;
  const std::uint32_t value = reader_.value();
  if (end_ == 0) {  // a head: type and words
    const std::uint16_t type = low(value), words = high(value);
    if (type == kSiiEnd) return judge(what);
    if (++categories_ > kMostCategories || category_ + words > 0xFFF0) {
      what << "the list of categories in its EEPROM has no end (FFFFh); is it empty?";
      return Status::kRefusedByRobot;
    }
    category_ = static_cast<std::uint16_t>(category_ + 2);
    if (type == kSiiSms && words >= kSmWords) {
      end_ = static_cast<std::uint16_t>(category_ + words);
      sm_ = step_ = 0;
    } else {
      category_ = static_cast<std::uint16_t>(category_ + words);
    }
  } else if (step_ == 0) {  // start and length
    sm_half_ = value;
    step_ = 1;
    category_ = static_cast<std::uint16_t>(category_ + 2);
  } else {  // control, status, activate, use
    const auto control = static_cast<std::uint8_t>(value);
    const Area area = {sm_, low(sm_half_), control};
    switch (static_cast<std::uint8_t>(value >> 24)) {
      case kSiiMailboxOutSm: slave.mailbox_out_control = control; break;
      case kSiiMailboxInSm: slave.mailbox_in_control = control; break;
      case kSiiOutputsSm: slave.outputs = area; break;
      case kSiiInputsSm: slave.inputs = area; break;
      default: break;
    }
    ++sm_;
    step_ = 0;
    category_ = static_cast<std::uint16_t>(category_ + 2);
    if (category_ + kSmWords > end_ || sm_ == static_cast<int>(kMostSms)) return judge(what);
  }
  reader_.begin(slave.boxes.station, category_);
  return Status::kArming;
}

Status SlaveEeprom::judge(Message& what) const {
  if (slave_->outputs.sm < 0 || slave_->inputs.sm < 0) {
    what
        << "its EEPROM names no sync managers of outputs and inputs; if it is empty, write it with "
           "the drive's maker's tool";
    return Status::kRefusedByRobot;
  }
  TRY(judge_mailbox("requests", kSiiMailboxOut + 1, slave_->boxes.out_bytes, what));
  return judge_mailbox("answers", kSiiMailboxIn + 1, slave_->boxes.in_bytes, what);
}

/// `word`: the word of the EEPROM that has its length.
Status SlaveEeprom::judge_mailbox(const char* of, std::uint16_t word, std::uint16_t bytes,
                                  Message& what) const {
  if (bytes >= Mailboxes::kLeast && bytes <= Mailboxes::kMost) return Status::kOk;
  what << "its mailbox of " << of << " has " << int{bytes} << " bytes by its EEPROM (word "
       << std::string_view(cia402::hex(word)) << "), expected " << Mailboxes::kLeast << " to "
       << Mailboxes::kMost << ": ";
  what << (bytes < Mailboxes::kLeast ? "a shorter one has no room for an SDO message"
                                     : "a longer one does not fit into a frame");
  return Status::kRefusedByRobot;
}

}  // namespace tactus::ethercat
