#include "hal/ethercat/coe_client.hpp"

#include <algorithm>

#include "hal/cia402/hex.hpp"

namespace tactus::ethercat {

using can::SdoAbort;

namespace {

constexpr std::size_t kSdoHead = 4, kSdoBody = 8;  // command, index, sub-index; and four bytes
constexpr std::size_t kLeastSegment = 7;
constexpr const char* kOther = "it names another object";
constexpr int kMostWrong = 9999;  // more are not counted

}  // namespace

void CoeClient::begin(TransferStep step, std::size_t out_bytes, std::uint16_t index,
                      std::uint8_t sub, std::int64_t now_ns) {
  step_ = step;
  progress_ = Progress::kBusy;
  abort_ = SdoAbort::kNone;
  room_ = out_bytes > kCoeBody ? out_bytes - kCoeBody : 0;
  index_ = index;
  sub_ = sub;
  heard_ns_ = now_ns;
  to_send_ = true;
  toggle_ = silent_ = too_large_ = false;
  refused_ = 0;
  wrong_ = 0;
  done_ = 0;
  if (room_ < kSdoBody) fail(SdoAbort::kOutOfMemory);
}

void CoeClient::upload(std::size_t out_bytes, std::uint16_t index, std::uint8_t sub,
                       std::int64_t now_ns) {
  data_.fill(0);
  size_ = 0;
  begin(TransferStep::kRead, out_bytes, index, sub, now_ns);
}

void CoeClient::download(std::size_t out_bytes, std::uint16_t index, std::uint8_t sub,
                         std::uint32_t value, std::size_t bytes, std::int64_t now_ns) {
  std::uint8_t given[4];
  put(given, value);
  download_bytes(out_bytes, index, sub, given, std::min(bytes, sizeof given), now_ns);
}

void CoeClient::download_bytes(std::size_t out_bytes, std::uint16_t index, std::uint8_t sub,
                               const std::uint8_t* bytes, std::size_t size, std::int64_t now_ns) {
  data_.fill(0);
  size_ = std::min(size, kCapacity);
  std::memcpy(data_.data(), bytes, size_);
  begin(TransferStep::kWrite, out_bytes, index, sub, now_ns);
  if (size > kCapacity) fail(SdoAbort::kTooLong);
}

void CoeClient::end(Progress progress, SdoAbort abort) {
  progress_ = progress;
  abort_ = abort;
  step_ = TransferStep::kNone;
  to_send_ = false;
}

bool CoeClient::take(std::uint8_t* mailbox, std::size_t size, std::uint8_t& counter) {
  if (!to_send_) return false;
  to_send_ = false;
  std::memset(mailbox, 0, size);
  const std::size_t body = write_body(mailbox + kCoeBody);
  counter = static_cast<std::uint8_t>(counter % 7 + 1);
  put(mailbox, static_cast<std::uint16_t>(kCoeBytes + body));
  mailbox[5] = static_cast<std::uint8_t>(kMailboxCoe | counter << kMailboxCounterShift);
  put(mailbox + kMailboxBytes, static_cast<std::uint16_t>(kCoeSdoRequest << kCoeServiceShift));
  return true;
}

/// Returns the bytes of the request.
std::size_t CoeClient::write_body(std::uint8_t* body) {
  const std::size_t left = size_ - done_;
  const auto toggled = static_cast<unsigned>(toggle_ ? can::kToggleBit : 0);
  put(body + 1, index_);
  body[3] = sub_;
  switch (step_) {
    case TransferStep::kNone: break;
    case TransferStep::kRead: body[0] = can::kUpload; break;
    case TransferStep::kReadSegment: put<std::uint32_t>(body, can::kUploadSegment | toggled); break;
    case TransferStep::kWrite: {
      if (size_ <= can::kExpeditedBytes) {
        const auto unused = static_cast<unsigned>(can::kExpeditedBytes - size_);
        body[0] = static_cast<std::uint8_t>(can::kDownload | can::kExpedited | can::kSizeGiven |
                                            unused << can::kUnusedShift);
        std::memcpy(body + kSdoHead, data_.data(), size_);
        done_ = size_;
        break;
      }
      body[0] = can::kDownload | can::kSizeGiven;
      put(body + kSdoHead, static_cast<std::uint32_t>(size_));
      done_ = std::min(size_, room_ - kSdoBody);
      std::memcpy(body + kSdoBody, data_.data(), done_);
      return kSdoBody + done_;
    }
    case TransferStep::kWriteSegment: {
      const std::size_t size = std::min(left, room_ - 1);
      const auto unused = static_cast<unsigned>(size < kLeastSegment ? kLeastSegment - size : 0);
      const unsigned last = size == left ? can::kLastSegment : 0U;
      put<std::uint32_t>(
          body, can::kDownloadSegment | toggled | unused << can::kSegmentUnusedShift | last);
      std::memcpy(body + 1, data_.data() + done_, size);
      done_ += size;
      return 1 + std::max(size, kLeastSegment);
    }
  }
  return kSdoBody;
}

void CoeClient::ignore(const char* why) {
  wrong_ += wrong_ < kMostWrong;
  wrong_why_ = why;
}

bool CoeClient::receive(const std::uint8_t* mailbox, std::size_t size, can::Emergency& emergency,
                        std::int64_t now_ns) {
  if (size < kCoeBody) return false;
  const std::size_t length = get<std::uint16_t>(mailbox);
  const std::uint8_t type = mailbox[5] & kMailboxTypeBits;
  if (length < kCoeBytes || length > size - kMailboxBytes) {
    ignore("its length does not fit into the mailbox");
    return false;
  }
  if (type == kMailboxError && progress_ == Progress::kBusy) {
    fail(SdoAbort::kGeneral);
    if (length >= kMailboxErrorBytes) refused_ = get<std::uint16_t>(mailbox + kMailboxBytes + 2);
    return false;
  }
  if (type != kMailboxCoe) {
    ignore("it is not of CoE");
    return false;
  }
  const int service = get<std::uint16_t>(mailbox + kMailboxBytes) >> kCoeServiceShift;
  const std::size_t body = length - kCoeBytes;
  if (service == kCoeEmergency && body >= can::kEmergencySize) {
    emergency = {get<std::uint16_t>(mailbox + kCoeBody), mailbox[kCoeBody + 2]};
    return true;
  }
  // Some slaves send an abort under the service of requests.
  const bool aborts = service == kCoeSdoRequest && body > 0 && mailbox[kCoeBody] == can::kAbort;
  if (service != kCoeSdoAnswer && !aborts) ignore("its service is not that of SDO answers");
  if (progress_ != Progress::kBusy || (service != kCoeSdoAnswer && !aborts)) return false;
  heard_ns_ = now_ns;
  take_answer(mailbox + kCoeBody, body);
  return false;
}

void CoeClient::take_answer(const std::uint8_t* body, std::size_t size) {
  if (size < kSdoBody) return fail(SdoAbort::kCommand);
  const bool names = get<std::uint16_t>(body + 1) == index_ && body[3] == sub_;
  const std::uint8_t command = body[0], specifier = command & can::kSpecifier;
  if (command == can::kAbort) {
    if (!names) return ignore(kOther);
    return fail(static_cast<SdoAbort>(get<std::uint32_t>(body + kSdoHead)));
  }
  switch (step_) {
    case TransferStep::kNone: return;
    case TransferStep::kRead:
      if (!names) return ignore(kOther);
      return specifier == can::kUploaded ? take_upload(body, size) : fail(SdoAbort::kCommand);
    case TransferStep::kReadSegment:
      return specifier == can::kSegmentUploaded ? take_segment(body, size)
                                                : fail(SdoAbort::kCommand);
    case TransferStep::kWrite:
      if (!names) return ignore(kOther);
      if (specifier != can::kDownloaded) return fail(SdoAbort::kCommand);
      break;
    case TransferStep::kWriteSegment:
      if (specifier != can::kSegmentDownloaded) return fail(SdoAbort::kCommand);
      if (((command & can::kToggleBit) != 0) != toggle_) return fail(SdoAbort::kToggle);
      toggle_ = !toggle_;
  }
  if (done_ == size_) return end(Progress::kDone, SdoAbort::kNone);
  step_ = TransferStep::kWriteSegment;
  to_send_ = true;
}

void CoeClient::take_upload(const std::uint8_t* body, std::size_t size) {
  const std::uint8_t command = body[0];
  size_known_ = (command & (can::kExpedited | can::kSizeGiven)) != can::kExpedited;
  if ((command & can::kExpedited) != 0) {
    size_ = can::kExpeditedBytes - (size_known_ ? command >> can::kUnusedShift & 3U : 0U);
    std::memcpy(data_.data(), body + kSdoHead, size_);
    return end(Progress::kDone, SdoAbort::kNone);
  }
  size_ = get<std::uint32_t>(body + kSdoHead);
  too_large_ = size_ > kCapacity;
  if (too_large_) return fail(SdoAbort::kOutOfMemory);
  done_ = std::min(size - kSdoBody, size_);
  std::memcpy(data_.data(), body + kSdoBody, done_);
  if (done_ == size_) return end(Progress::kDone, SdoAbort::kNone);
  step_ = TransferStep::kReadSegment;
  to_send_ = true;
}

void CoeClient::take_segment(const std::uint8_t* body, std::size_t size) {
  if (((body[0] & can::kToggleBit) != 0) != toggle_) return fail(SdoAbort::kToggle);
  std::size_t bytes = size - 1;
  if (bytes == kLeastSegment) bytes -= body[0] >> can::kSegmentUnusedShift & 7U;
  if (done_ + bytes > size_) return fail(SdoAbort::kTooLong);
  std::memcpy(data_.data() + done_, body + 1, bytes);
  done_ += bytes;
  toggle_ = !toggle_;
  const bool last = (body[0] & can::kLastSegment) != 0;
  if (last && done_ != size_) return fail(SdoAbort::kTooShort);
  if (!last && bytes == 0) return fail(SdoAbort::kTooShort);
  if (last) return end(Progress::kDone, SdoAbort::kNone);
  to_send_ = true;
}

void CoeClient::advance(std::int64_t now_ns) {
  if (progress_ != Progress::kBusy || now_ns - heard_ns_ <= answer_ns_) return;
  fail(SdoAbort::kTimeout);
  silent_ = true;
}

Message CoeClient::describe() const {
  Message text("object ");
  text << cia402::hex(index_) << ":" << int{sub_} << ": ";
  if (too_large_) {
    text << "it has " << size_ << " bytes, and this program takes at most " << kCapacity;
    return text;
  }
  if (refused_ != 0) {
    text << "the slave's mailbox refuses the request: " << mailbox_error_text(refused_)
         << " (error " << cia402::hex(refused_) << " of ETG.1000.4)";
    return text;
  }
  if (silent_) text << "no answer within " << static_cast<int>(answer_ns_ / 1'000'000) << " ms";
  if (silent_ && wrong_ > 0)
    text << ", but " << wrong_ << " messages that are none; of the last, " << wrong_why_;
  if (!silent_) text << can::meaning(abort_);
  text << " (" << cia402::hex(static_cast<std::uint32_t>(abort_)) << ")";
  return text;
}

}  // namespace tactus::ethercat
