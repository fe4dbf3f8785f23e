// Startup: a slave's EEPROM, mailboxes and process data.
#include "hal/cia402/hex.hpp"
#include "hal/ethercat/startup.hpp"

namespace tactus::ethercat {
namespace {

constexpr std::uint16_t kWords[] = {kSiiVendor,     kSiiProduct,   kSiiRevision, kSiiSerial,
                                    kSiiMailboxOut, kSiiMailboxIn, kSiiProtocols};
constexpr int kWordCount = static_cast<int>(std::size(kWords));
constexpr int kMostCategories = 64;
constexpr std::uint16_t kSmWords = 4;  // of one sync manager in its category
constexpr int kProcessSteps = 6;
constexpr const char* kEeprom =
    "; power the drive off and on; if it stays so, write its EEPROM with its maker's tool";

std::uint16_t low(std::uint32_t value) {
  return static_cast<std::uint16_t>(value);
}
std::uint16_t high(std::uint32_t value) {
  return static_cast<std::uint16_t>(value >> 16);
}

Request sm_request(std::uint16_t station, int sm, std::uint16_t start, std::size_t length,
                   std::uint8_t control) {
  const auto reg = static_cast<std::uint16_t>(kSmReg + int{kSmBytes} * sm);
  Request request(Command::kFpwr, address_of(station, reg), kSmBytes);
  put(&request.data[0], start);
  put(&request.data[2], static_cast<std::uint16_t>(length));
  request.data[4] = control;
  request.data[6] = length > 0 ? kSmEnabled : 0;
  return request;
}

Request fmmu_request(std::uint16_t station, int fmmu, std::size_t logical, std::size_t length,
                     std::uint16_t physical, std::uint8_t type) {
  const auto reg = static_cast<std::uint16_t>(kFmmuReg + int{kFmmuBytes} * fmmu);
  Request request(Command::kFpwr, address_of(station, reg), kFmmuBytes);
  put(&request.data[0], static_cast<std::uint32_t>(kImageAddress + logical));
  put(&request.data[4], static_cast<std::uint16_t>(length));
  request.data[7] = 7;  // last bit
  put(&request.data[8], physical);
  request.data[11] = type;
  request.data[12] = length > 0 ? 1 : 0;
  return request;
}

}  // namespace

Status Startup::refuse_eeprom() {
  Message what("its EEPROM cannot be read at word ");
  what << std::string_view(cia402::hex(eeprom_.word())) << ": " << eeprom_.cause() << " (0502h is "
       << std::string_view(cia402::hex(eeprom_.control())) << ")" << kEeprom;
  return refuse(Status::kRefusedByRobot, what);
}

Status Startup::take_eeprom() {
  if (eeprom_.progress() == SiiReader::Progress::kFailed) return refuse_eeprom();
  if (eeprom_.progress() == SiiReader::Progress::kBusy) return Status::kOk;
  Slave& slave = at();
  const std::uint32_t value = eeprom_.value();
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
      if ((value & kSiiCoe) == 0)
        return refuse(
            Status::kRefusedByRobot,
            "by its EEPROM (word 001Ch) it has no CoE mailbox and is no CiA 402 drive; if "
            "it is one, write its EEPROM with its maker's tool");
  }
  if (++step_ < kWordCount) {
    eeprom_.begin(slave.boxes.station, kWords[step_]);
    return Status::kOk;
  }
  stage_ = Stage::kCategories;
  category_ = kSiiCategories;
  category_end_ = 0;
  categories_ = 0;
  eeprom_.begin(slave.boxes.station, category_);
  return Status::kOk;
}

/// Walks from category to category until that of the sync managers, and reads it.
Status Startup::take_category() {
  if (eeprom_.progress() == SiiReader::Progress::kFailed) return refuse_eeprom();
  if (eeprom_.progress() == SiiReader::Progress::kBusy) return Status::kOk;
  Slave& slave = at();
  const std::uint32_t value = eeprom_.value();
  if (category_end_ == 0) {  // a head: type and words
    const std::uint16_t type = low(value), words = high(value);
    if (type == kSiiEnd) return judge_eeprom();
    if (++categories_ > kMostCategories || category_ + words > 0xFFF0)
      return refuse(Status::kRefusedByRobot,
                    "the list of categories in its EEPROM has no end (FFFFh); is it empty?");
    category_ = static_cast<std::uint16_t>(category_ + 2);
    if (type == kSiiSms && words >= kSmWords) {
      category_end_ = static_cast<std::uint16_t>(category_ + words);
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
    if (category_ + kSmWords > category_end_ || sm_ == static_cast<int>(kMostSms))
      return judge_eeprom();
  }
  eeprom_.begin(slave.boxes.station, category_);
  return Status::kOk;
}

Status Startup::judge_eeprom() {
  const Slave& slave = at();
  if (slave.outputs.sm < 0 || slave.inputs.sm < 0)
    return refuse(Status::kRefusedByRobot,
                  "its EEPROM names no sync managers of outputs and inputs; if it is empty, write "
                  "it with the drive's maker's tool");
  TRY(judge_mailbox("requests", kSiiMailboxOut + 1, slave.boxes.out_bytes));
  TRY(judge_mailbox("answers", kSiiMailboxIn + 1, slave.boxes.in_bytes));
  stage_ = Stage::kMailboxes;
  step_ = 0;
  return Status::kOk;
}

/// `word`: where the EEPROM has its length.
Status Startup::judge_mailbox(const char* of, std::uint16_t word, std::uint16_t bytes) {
  if (bytes >= Mailboxes::kLeast && bytes <= Mailboxes::kMost) return Status::kOk;
  Message what("its mailbox of ");
  what << of << " has " << int{bytes} << " bytes by its EEPROM (word "
       << std::string_view(cia402::hex(word)) << "), expected " << Mailboxes::kLeast << " to "
       << Mailboxes::kMost << ": ";
  what << (bytes < Mailboxes::kLeast ? "a shorter one has no room for an SDO message"
                                     : "a longer one does not fit into a frame");
  return refuse(Status::kRefusedByRobot, what);
}

Request Startup::area_request() const {
  const Slave& slave = at();
  const Mailboxes& boxes = slave.boxes;
  if (step_ == 0)
    return sm_request(boxes.station, 0, boxes.out, boxes.out_bytes, slave.mailbox_out_control);
  return sm_request(boxes.station, 1, boxes.in, boxes.in_bytes, slave.mailbox_in_control);
}

/// The watchdog runs over the outputs, whatever the EEPROM says.
Request Startup::process_request() const {
  const Slave& slave = at();
  const std::uint16_t station = slave.boxes.station;
  const ProcessData& data = slave.data;
  const auto outputs = static_cast<std::uint8_t>(slave.outputs.control | kSmWatchdog);
  const int units = 10 * ethercat_->timeout_ms(period_us_);  // of 100 us
  switch (step_) {
    case 0:
      return sm_request(station, slave.outputs.sm, slave.outputs.start, data.outputs.bytes(),
                        outputs);
    case 1:
      return sm_request(station, slave.inputs.sm, slave.inputs.start, data.inputs.bytes(),
                        slave.inputs.control);
    case 2:
      return fmmu_request(station, 0, data.out_at, data.outputs.bytes(), slave.outputs.start,
                          kFmmuWrite);
    case 3:
      return fmmu_request(station, 1, data.in_at, data.inputs.bytes(), slave.inputs.start,
                          kFmmuRead);
    case 4:
      return Request::number(Command::kFpwr, address_of(station, kWatchdogDividerReg),
                             kDivider100us);
    default:
      return Request::number(Command::kFpwr, address_of(station, kDataWatchdogReg),
                             static_cast<std::uint16_t>(units));
  }
}

Status Startup::take_process_data() {
  if (exchange_.answer().counter != 1)
    return refuse(Status::kRefusedByRobot, "does not take its sync managers, FMMUs and watchdog");
  if (++step_ < kProcessSteps) return Status::kOk;
  next_slave(Stage::kProcessData, has_clocks_ ? Stage::kLatch : Stage::kSafeop);
  return Status::kOk;
}

/// Outputs of all joints, then inputs of all.
Status Startup::place_image() {
  image_.outputs = image_.inputs = 0;
  for (Slave& slave : slaves_) {
    slave.data.out_at = image_.outputs;
    image_.outputs += slave.data.outputs.bytes();
  }
  for (Slave& slave : slaves_) {
    slave.data.in_at = image_.bytes();
    image_.inputs += slave.data.inputs.bytes();
  }
  if (image_.bytes() <= kMostImage) return Status::kOk;
  why_ = Message("the process data of all drives have ");
  why_ << image_.bytes() << " bytes, at most " << kMostImage;
  return Status::kTooLarge;
}

}  // namespace tactus::ethercat
