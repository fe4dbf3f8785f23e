#include "hal/can/sdo_client.hpp"

#include <algorithm>
#include <cassert>

#include "hal/can/protocol_canopen.hpp"
#include "hal/cia402/hex.hpp"
#include "kernel/core/loop_bound.hpp"

namespace tactus::can {
namespace {

constexpr std::size_t kIndexAt = 1, kSubAt = 3, kDataAt = 4;

std::uint8_t specifier(const CanFrame& answer) {
  return static_cast<std::uint8_t>(answer.data[0] & kSpecifier);
}
std::uint8_t unused(std::size_t room, std::size_t bytes, int shift) {
  return static_cast<std::uint8_t>((room - bytes) << shift);
}

}  // namespace

void SdoClient::begin(std::uint8_t node, std::uint16_t index, std::uint8_t sub,
                      std::int64_t now_ns) {
  assert(node >= 1 && node <= kMaxNode);
  if (progress_ == Progress::kBusy) give_up(SdoAbort::kGeneral);
  progress_ = Progress::kBusy;
  abort_ = SdoAbort::kNone;
  node_ = node;
  index_ = index;
  sub_ = sub;
  began_ns_ = heard_ns_ = now_ns;
  data_.fill(0);
  size_ = sent_ = announced_ = 0;
  size_known_ = toggle_ = heard_other_ = false;
}

CanFrame SdoClient::frame(std::uint8_t command) const {
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(kSdoRequestBase + node_);
  frame.size = kSdoSize;
  frame.data[0] = command;
  store(frame.data, kIndexAt, index_);
  frame.data[kSubAt] = sub_;
  return frame;
}

void SdoClient::ask(const CanFrame& request) {
  request_ = request;
  has_request_ = true;
}

void SdoClient::download(std::uint8_t node, std::uint16_t index, std::uint8_t sub,
                         std::uint32_t value, std::uint8_t bytes, std::int64_t now_ns) {
  assert(bytes >= 1 && bytes <= kExpeditedBytes);
  begin(node, index, sub, now_ns);
  size_ = std::min<std::size_t>(bytes, kExpeditedBytes);
  store(data_, 0, value & (~std::uint32_t{0} >> 8 * (kExpeditedBytes - size_)));
  send_expedited();
}

void SdoClient::download_bytes(std::uint8_t node, std::uint16_t index, std::uint8_t sub,
                               const std::uint8_t* bytes, std::size_t size, std::int64_t now_ns) {
  begin(node, index, sub, now_ns);
  if (size > kCapacity) return end(SdoAbort::kTooLong, Cause::kValue);  // no abort to the node
  store(data_, 0, std::uint32_t{0});
  std::copy_n(bytes, size, data_.begin());
  size_ = size;
  if (size >= 1 && size <= kExpeditedBytes) return send_expedited();
  step_ = TransferStep::kWrite;
  CanFrame request = frame(kDownload | kSizeGiven);
  store(request.data, kDataAt, static_cast<std::uint32_t>(size));
  ask(request);
}

/// Sends the whole object, of 1 to 4 bytes; those behind it are 0.
void SdoClient::send_expedited() {
  step_ = TransferStep::kWrite;
  CanFrame request =
      frame(kDownload | kSizeGiven | kExpedited | unused(kExpeditedBytes, size_, kUnusedShift));
  store(request.data, kDataAt, load<std::uint32_t>(data_, 0));
  sent_ = size_;
  ask(request);
}

void SdoClient::upload(std::uint8_t node, std::uint16_t index, std::uint8_t sub,
                       std::int64_t now_ns) {
  begin(node, index, sub, now_ns);
  step_ = TransferStep::kRead;
  ask(frame(kUpload));
}

bool SdoClient::take(CanFrame& request) {
  if (!has_abort_ && !has_request_) return false;
  request = has_abort_ ? abort_frame_ : request_;
  (has_abort_ ? has_abort_ : has_request_) = false;
  return true;
}

void SdoClient::receive(const CanFrame& answer, std::int64_t now_ns) {
  if (progress_ != Progress::kBusy || answer.id != kSdoAnswerBase + node_ || answer.remote ||
      answer.size != kSdoSize)
    return;
  if (has_request_) return;  // the answer to a request of before
  if (names_object(answer) && !is_for_object(answer)) {
    heard_other_ = true;
    other_index_ = load<std::uint16_t>(answer.data, kIndexAt);
    other_sub_ = answer.data[kSubAt];
    return;
  }
  heard_ns_ = now_ns;
  take_answer(answer);
}

void SdoClient::take_answer(const CanFrame& answer) {
  if (specifier(answer) == kAbort)
    return end(static_cast<SdoAbort>(load<std::uint32_t>(answer.data, kDataAt)), Cause::kNode);
  switch (step_) {
    case TransferStep::kNone: break;
    case TransferStep::kWrite: return take_downloaded(answer);
    case TransferStep::kWriteSegment: return take_segment_downloaded(answer);
    case TransferStep::kRead: return take_uploaded(answer);
    case TransferStep::kReadSegment: return take_segment_uploaded(answer);
  }
}

/// Every answer but a segment names its object. One on another object is late, or repeated by the
/// bus, or an answer to another client.
bool SdoClient::names_object(const CanFrame& answer) const {
  const bool segments = step_ == TransferStep::kReadSegment || step_ == TransferStep::kWriteSegment;
  const bool segment =
      specifier(answer) == kSegmentUploaded || specifier(answer) == kSegmentDownloaded;
  return !(segments && segment);
}

bool SdoClient::is_for_object(const CanFrame& answer) const {
  return load<std::uint16_t>(answer.data, kIndexAt) == index_ && answer.data[kSubAt] == sub_;
}

void SdoClient::take_downloaded(const CanFrame& answer) {
  if (specifier(answer) != kDownloaded) return give_up(SdoAbort::kCommand);
  if (sent_ == size_ && size_ > 0) return finish();
  send_segment();
}

void SdoClient::send_segment() {
  const std::size_t bytes = std::min(size_ - sent_, kSegmentBytes);
  CanFrame request;
  request.id = static_cast<std::uint16_t>(kSdoRequestBase + node_);
  request.size = kSdoSize;
  request.data[0] = static_cast<std::uint8_t>(kDownloadSegment | (toggle_ ? kToggleBit : 0) |
                                              unused(kSegmentBytes, bytes, kSegmentUnusedShift) |
                                              (sent_ + bytes == size_ ? kLastSegment : 0));
  LoopBound<7> segment;
  for (std::size_t i = 0; i < bytes; ++i) {
    segment.tick();
    request.data[1 + i] = data_[sent_ + i];
  }
  sent_ += bytes;
  step_ = TransferStep::kWriteSegment;
  ask(request);
}

void SdoClient::take_segment_downloaded(const CanFrame& answer) {
  if (specifier(answer) != kSegmentDownloaded) return give_up(SdoAbort::kCommand);
  if (((answer.data[0] & kToggleBit) != 0) != toggle_) return give_up(SdoAbort::kToggle);
  toggle_ = !toggle_;
  if (sent_ == size_) return finish();
  send_segment();
}

void SdoClient::take_uploaded(const CanFrame& answer) {
  if (specifier(answer) != kUploaded) return give_up(SdoAbort::kCommand);
  size_known_ = (answer.data[0] & kSizeGiven) != 0;
  if ((answer.data[0] & kExpedited) != 0) {
    const std::size_t rest = size_known_ ? answer.data[0] >> kUnusedShift & 3U : 0;
    size_ = kExpeditedBytes - rest;
    LoopBound<4> expedited;
    for (std::size_t i = 0; i < size_; ++i) {
      expedited.tick();
      data_[i] = answer.data[kDataAt + i];
    }
    return finish();
  }
  announced_ = size_known_ ? load<std::uint32_t>(answer.data, kDataAt) : 0;
  if (announced_ > kCapacity) return give_up(SdoAbort::kOutOfMemory);
  step_ = TransferStep::kReadSegment;
  ask_for_segment();
}

void SdoClient::ask_for_segment() {
  CanFrame request;
  request.id = static_cast<std::uint16_t>(kSdoRequestBase + node_);
  request.size = kSdoSize;
  request.data[0] = static_cast<std::uint8_t>(kUploadSegment | (toggle_ ? kToggleBit : 0));
  ask(request);
}

void SdoClient::take_segment_uploaded(const CanFrame& answer) {
  if (specifier(answer) != kSegmentUploaded) return give_up(SdoAbort::kCommand);
  if (((answer.data[0] & kToggleBit) != 0) != toggle_) return give_up(SdoAbort::kToggle);
  toggle_ = !toggle_;
  const std::size_t bytes = kSegmentBytes - (answer.data[0] >> kSegmentUnusedShift & 7U);
  if (size_known_ && size_ + bytes > announced_) return give_up(SdoAbort::kTooLong);
  if (size_ + bytes > kCapacity) return give_up(SdoAbort::kOutOfMemory);
  LoopBound<7> segment;
  for (std::size_t i = 0; i < bytes; ++i) {
    segment.tick();
    data_[size_ + i] = answer.data[1 + i];
  }
  size_ += bytes;
  if ((answer.data[0] & kLastSegment) == 0) return ask_for_segment();
  if (size_known_ && size_ < announced_) return give_up(SdoAbort::kTooShort);
  finish();
}

void SdoClient::advance(std::int64_t now_ns) {
  if (progress_ != Progress::kBusy) return;
  if (now_ns - heard_ns_ >= times_.answer_ns)
    give_up(SdoAbort::kTimeout, Cause::kSilence);
  else if (now_ns - began_ns_ >= times_.transfer_ns)
    give_up(SdoAbort::kTimeout, Cause::kTime);
}

void SdoClient::finish() {
  progress_ = Progress::kDone;
  step_ = TransferStep::kNone;
}

void SdoClient::end(SdoAbort why, Cause cause) {
  progress_ = Progress::kAborted;
  step_ = TransferStep::kNone;
  abort_ = why;
  cause_ = cause;
  has_request_ = false;
}

void SdoClient::give_up(SdoAbort why, Cause cause) {
  end(why, cause);
  abort_frame_ = frame(kAbort);
  store(abort_frame_.data, kDataAt, static_cast<std::uint32_t>(why));
  has_abort_ = true;
}

Message SdoClient::describe() const {
  Message text;
  text << "node " << int{node_} << ": object " << cia402::hex(index_) << ":" << int{sub_} << ": ";
  if (progress_ != Progress::kAborted) {
    text << name(progress_);
    return text;
  }
  const auto ms = [](std::int64_t time_ns) { return static_cast<int>(time_ns / 1'000'000); };
  switch (cause_) {
    case Cause::kNode: text << meaning(abort_); break;
    case Cause::kAnswer: text << "the answer is wrong: " << meaning(abort_); break;
    case Cause::kSilence: text << "no answer within " << ms(times_.answer_ns) << " ms"; break;
    case Cause::kTime: text << "not complete within " << ms(times_.transfer_ns) << " ms"; break;
    case Cause::kValue: text << "the value to write is " << meaning(abort_); break;
  }
  if (heard_other_ && (cause_ == Cause::kSilence || cause_ == Cause::kTime))
    text << ", but one on " << cia402::hex(other_index_) << ":" << int{other_sub_};
  text << " (" << cia402::hex(static_cast<std::uint32_t>(abort_)) << ")";
  return text;
}

}  // namespace tactus::can
