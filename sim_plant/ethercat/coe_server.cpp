#include "sim_plant/ethercat/coe_server.hpp"

#include <algorithm>
#include <cstring>

#include "hal/ethercat/protocol_frame.hpp"

namespace tactus::segment {

using namespace ethercat;
using can::SdoAbort;

namespace {

constexpr std::size_t kSdoHead = 4, kSdoBody = 8;  // command, index, sub-index; and four bytes
constexpr std::size_t kLeastSegment = 7;

}  // namespace

void CoeServer::reset(std::size_t bytes) {
  room_ = std::min(bytes, kMostMailbox);
  count_ = 0;
  counter_ = seen_ = 0;
  transfer_ = Transfer::kNone;
  information_.reset();
}

bool CoeServer::take(MailboxMessage& message) {
  if (count_ == 0 && information_.has_more()) post_information();
  if (count_ == 0) return false;
  message = queue_[first_];
  first_ = (first_ + 1) % kQueue;
  --count_;
  return true;
}

/// Begins a CoE message with `body` bytes of zeros, and returns them; null if there is no room.
std::uint8_t* CoeServer::begin(std::uint16_t service, std::size_t body) {
  if (count_ == kQueue || kCoeBody + body > room_) return nullptr;
  MailboxMessage& message = queue_[(first_ + count_++) % kQueue];
  message.bytes.fill(0);
  message.size = kCoeBody + body;
  counter_ = static_cast<std::uint8_t>(counter_ % 7 + 1);
  put(message.bytes.data(), static_cast<std::uint16_t>(kCoeBytes + body));
  message.bytes[5] = static_cast<std::uint8_t>(kMailboxCoe | counter_ << kMailboxCounterShift);
  put(message.bytes.data() + kMailboxBytes,
      static_cast<std::uint16_t>(service << kCoeServiceShift));
  return message.bytes.data() + kCoeBody;
}

/// The next fragment of an answer, once those before it have gone.
void CoeServer::post_information() {
  std::array<std::uint8_t, kMostMailbox> fragment;
  const std::size_t size = information_.take(fragment.data(), room_ - kCoeBody);
  if (std::uint8_t* const body = begin(kCoeInformation, size))
    std::memcpy(body, fragment.data(), size);
}

std::uint8_t* CoeServer::begin_sdo(std::uint8_t command, std::size_t body) {
  std::uint8_t* const at = begin(kCoeSdoAnswer, body);
  if (at == nullptr) return nullptr;
  at[0] = command;
  put(at + 1, index_);
  at[3] = sub_;
  return at;
}

/// The answer of the mailbox itself to what is no message of a protocol that it has.
void CoeServer::error(std::uint16_t code) {
  if (begin(0, 2) == nullptr) return;
  MailboxMessage& message = queue_[(first_ + count_ - 1) % kQueue];
  message.size = kMailboxBytes + 4;
  put<std::uint16_t>(message.bytes.data(), 4);
  message.bytes[5] = static_cast<std::uint8_t>(kMailboxError | counter_ << kMailboxCounterShift);
  put<std::uint16_t>(message.bytes.data() + kMailboxBytes, 1);
  put(message.bytes.data() + kMailboxBytes + 2, code);
}

void CoeServer::emergency(const can::Emergency& emergency) {
  std::uint8_t* const body = begin(kCoeEmergency, can::kEmergencySize);
  if (body == nullptr) return;
  put(body, emergency.code);
  body[2] = emergency.error_register;
}

CoeResult CoeServer::receive(const std::uint8_t* message, std::size_t size, bool preop,
                             bool powered) {
  CoeResult result;
  preop_ = preop;
  powered_ = powered;
  if (size < kMailboxBytes) return result;
  // A message with the counter of the one before is that message again; 0 is none (ETG.1000.4).
  const int number = message[5] >> kMailboxCounterShift & 7;
  if (number != 0 && number == seen_) return result;
  seen_ = static_cast<std::uint8_t>(number);
  const std::size_t length = get<std::uint16_t>(message);
  if ((message[5] & kMailboxTypeBits) != kMailboxCoe) {
    error(kMailboxUnsupported);
  } else if (length > size - kMailboxBytes) {
    error(kMailboxWrongSize);
  } else if (length < kCoeBytes) {
    error(kMailboxTooShort);
  } else {
    const int service = get<std::uint16_t>(message + kMailboxBytes) >> kCoeServiceShift;
    if (service == kCoeSdoRequest)
      answer_sdo(message + kCoeBody, length - kCoeBytes, result);
    else if (service == kCoeInformation && room_ >= kCoeBody + kSdoBody)
      information_.ask(message + kCoeBody, length - kCoeBytes);
    else
      error(service == 0 || service > kCoeInformation ? kMailboxBadHeader : kMailboxNoService);
  }
  return result;
}

void CoeServer::abort(SdoAbort code) {
  transfer_ = Transfer::kNone;
  if (std::uint8_t* const body = begin_sdo(can::kAbort, kSdoBody))
    put(body + kSdoHead, static_cast<std::uint32_t>(code));
}

void CoeServer::answer_sdo(const std::uint8_t* body, std::size_t size, CoeResult& result) {
  if (size == 0) return error(kMailboxTooShort);
  const std::uint8_t command = body[0], specifier = command & can::kSpecifier;
  if (specifier == can::kDownloadSegment) return take_segment(body, size, result);
  if (specifier == can::kUploadSegment) return give_segment(command);
  if (size < kSdoBody) return error(kMailboxTooShort);
  transfer_ = Transfer::kNone;
  if (specifier == can::kAbort) return;
  index_ = get<std::uint16_t>(body + 1);
  sub_ = body[3];
  if (refusal_ != SdoAbort::kNone && (refused_ == 0 || refused_ == index_)) return abort(refusal_);
  if (specifier != can::kUpload && specifier != can::kDownload) return abort(SdoAbort::kCommand);
  if ((command & kCompleteAccess) != 0) return abort(SdoAbort::kAccess);
  if (specifier == can::kUpload) return begin_upload();
  begin_download(body, size, result);
}

void CoeServer::begin_upload() {
  const SdoAbort code = objects_.read(index_, sub_, data_);
  if (code != SdoAbort::kNone) return abort(code);
  if (data_.size <= can::kExpeditedBytes) {
    const std::size_t unused = can::kExpeditedBytes - data_.size;
    const auto command = static_cast<std::uint8_t>(can::kUploaded | can::kSizeGiven |
                                                   can::kExpedited | unused << can::kUnusedShift);
    if (std::uint8_t* const body = begin_sdo(command, kSdoBody))
      std::memcpy(body + kSdoHead, data_.data.data(), data_.size);
    return;
  }
  done_ = std::min(data_.size, room_ - kCoeBody - kSdoBody);
  std::uint8_t* const body = begin_sdo(can::kUploaded | can::kSizeGiven, kSdoBody + done_);
  if (body == nullptr) return;
  put(body + kSdoHead, static_cast<std::uint32_t>(data_.size));
  std::memcpy(body + kSdoBody, data_.data.data(), done_);
  if (done_ == data_.size) return;
  transfer_ = Transfer::kUpload;
  toggle_ = false;
}

void CoeServer::give_segment(std::uint8_t command) {
  if (transfer_ != Transfer::kUpload) return abort(SdoAbort::kCommand);
  if (((command & can::kToggleBit) != 0) != toggle_) return abort(SdoAbort::kToggle);
  const std::size_t size = std::min(data_.size - done_, room_ - kCoeBody - 1);
  const std::size_t unused = size < kLeastSegment ? kLeastSegment - size : 0;
  std::uint8_t* const body = begin(kCoeSdoAnswer, 1 + std::max(size, kLeastSegment));
  if (body == nullptr) return;
  const bool last = done_ + size == data_.size;
  body[0] = static_cast<std::uint8_t>(can::kSegmentUploaded | (toggle_ ? can::kToggleBit : 0) |
                                      unused << can::kSegmentUnusedShift |
                                      (last ? can::kLastSegment : 0));
  std::memcpy(body + 1, data_.data.data() + done_, size);
  done_ += size;
  toggle_ = !toggle_;
  if (last) transfer_ = Transfer::kNone;
}

void CoeServer::begin_download(const std::uint8_t* body, std::size_t size, CoeResult& result) {
  const std::uint8_t command = body[0];
  if ((command & can::kExpedited) != 0) {
    const bool given = (command & can::kSizeGiven) != 0;
    data_.size = can::kExpeditedBytes - (given ? command >> can::kUnusedShift & 3U : 0U);
    const drives::Found found = drives::find(index_, sub_);
    if (!given && found.row != nullptr && drives::size_of(found.row->type) > 0)
      data_.size = drives::size_of(found.row->type);
    std::memcpy(data_.data.data(), body + kSdoHead, data_.size);
    return finish_download(result, false);
  }
  whole_ = get<std::uint32_t>(body + kSdoHead);
  done_ = std::min(size - kSdoBody, whole_);
  if (whole_ > data_.data.size()) return abort(SdoAbort::kTooLong);
  if (!objects_.has(index_)) return abort(SdoAbort::kNoObject);
  std::memcpy(data_.data.data(), body + kSdoBody, done_);
  if (done_ == whole_) {
    data_.size = whole_;
    return finish_download(result, false);
  }
  transfer_ = Transfer::kDownload;
  toggle_ = false;
  begin_sdo(can::kDownloaded, kSdoBody);
}

void CoeServer::take_segment(const std::uint8_t* body, std::size_t size, CoeResult& result) {
  if (transfer_ != Transfer::kDownload) return abort(SdoAbort::kCommand);
  if (((body[0] & can::kToggleBit) != 0) != toggle_) return abort(SdoAbort::kToggle);
  std::size_t bytes = size - 1;
  if (bytes == kLeastSegment) bytes -= body[0] >> can::kSegmentUnusedShift & 7U;
  if (done_ + bytes > whole_) return abort(SdoAbort::kTooLong);
  std::memcpy(data_.data.data() + done_, body + 1, bytes);
  done_ += bytes;
  if ((body[0] & can::kLastSegment) != 0) {
    transfer_ = Transfer::kNone;
    if (done_ != whole_) return abort(SdoAbort::kTooShort);
    data_.size = whole_;
    return finish_download(result, true);
  }
  if (std::uint8_t* const answer = begin(kCoeSdoAnswer, kSdoBody))
    answer[0] =
        static_cast<std::uint8_t>(can::kSegmentDownloaded | (toggle_ ? can::kToggleBit : 0));
  toggle_ = !toggle_;
}

void CoeServer::finish_download(CoeResult& result, bool segment) {
  const SdoAbort code =
      objects_.write(index_, sub_, data_.data.data(), data_.size, preop_, powered_);
  if (code != SdoAbort::kNone) return abort(code);
  result = {true, index_, sub_};
  if (!segment) {
    begin_sdo(can::kDownloaded, kSdoBody);
    return;
  }
  if (std::uint8_t* const answer = begin(kCoeSdoAnswer, kSdoBody))
    answer[0] =
        static_cast<std::uint8_t>(can::kSegmentDownloaded | (toggle_ ? can::kToggleBit : 0));
}

}  // namespace tactus::segment
