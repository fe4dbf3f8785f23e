#include "sim_plant/drives/sdo_server.hpp"

#include <algorithm>
#include <cstring>

namespace tactus::drives {
namespace {

using can::CanFrame;
using can::SdoAbort;

CanFrame answer_frame(std::uint8_t node, std::uint8_t command, std::uint16_t index,
                      std::uint8_t sub) {
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(can::kSdoAnswerBase + node);
  frame.size = can::kSdoSize;
  frame.data[0] = command;
  can::store(frame.data, 1, index);
  frame.data[3] = sub;
  return frame;
}

}  // namespace

CanFrame SdoServer::abort_frame(std::uint8_t node, std::uint16_t index, std::uint8_t sub,
                                SdoAbort code) {
  CanFrame frame = answer_frame(node, can::kAbort, index, sub);
  can::store(frame.data, 4, static_cast<std::uint32_t>(code));
  return frame;
}

SdoAnswer SdoServer::receive(const CanFrame& request, std::int64_t now_ns, std::uint8_t node,
                             Dictionary& dictionary, const DeviceState& state) {
  SdoAnswer answer;
  if (request.size < can::kSdoSize) return answer;
  Context context{dictionary, state, answer, node};
  switch (request.data[0] & can::kSpecifier) {
    case can::kDownloadSegment: take_segment(request, context); break;
    case can::kDownload: begin_download(request, context); break;
    case can::kUpload: begin_upload(request, context); break;
    case can::kUploadSegment: give_segment(request, context); break;
    case can::kAbort: reset(); break;
    default:  // block transfers among others
      index_ = can::load<std::uint16_t>(request.data, 1);
      sub_ = request.data[3];
      abort(context, SdoAbort::kCommand);
  }
  deadline_ns_ = now_ns + kTimeout_ns;
  return answer;
}

SdoAnswer SdoServer::advance(std::int64_t now_ns, std::uint8_t node) {
  SdoAnswer answer;
  if (transfer_ == Transfer::kNone || now_ns < deadline_ns_) return answer;
  answer.sent = true;
  answer.frame = abort_frame(node, index_, sub_, SdoAbort::kTimeout);
  reset();
  return answer;
}

void SdoServer::abort(Context& context, SdoAbort code) {
  context.answer.sent = true;
  context.answer.frame = abort_frame(context.node, index_, sub_, code);
  reset();
}

void SdoServer::begin_download(const CanFrame& request, Context& context) {
  reset();
  index_ = can::load<std::uint16_t>(request.data, 1);
  sub_ = request.data[3];
  const std::uint8_t command = request.data[0];
  const bool given = (command & can::kSizeGiven) != 0;
  if ((command & can::kExpedited) != 0) {
    const std::size_t unused = command >> can::kUnusedShift & 3U;
    std::size_t size = can::kExpeditedBytes - unused;
    const Found found = find(index_, sub_);
    if (!given && found.row != nullptr) size = size_of(found.row->type);
    return finish_download(request.data.data() + 4, size, context);
  }
  const std::size_t size = given ? can::load<std::uint32_t>(request.data, 4) : 0;
  SdoAbort code = judge_access(index_, sub_, size);
  if (code == SdoAbort::kNone && given && size == 0) code = SdoAbort::kTooShort;
  if (code != SdoAbort::kNone) return abort(context, code);
  transfer_ = Transfer::kDownload;
  toggle_ = false;
  done_ = 0;
  context.answer.sent = true;
  context.answer.frame = answer_frame(context.node, can::kDownloaded, index_, sub_);
}

void SdoServer::finish_download(const std::uint8_t* data, std::size_t size, Context& context) {
  const SdoAbort code = write_object(context.dictionary, context.state, index_, sub_, data, size);
  if (code != SdoAbort::kNone) return abort(context, code);
  SdoAnswer& answer = context.answer;
  answer.written = true;
  answer.index = index_;
  answer.sub = sub_;
  answer.sent = true;
  answer.frame = answer_frame(context.node, can::kDownloaded, index_, sub_);
}

/// True if the segment belongs to the transfer; else aborts it.
bool SdoServer::follows(const CanFrame& request, Transfer transfer, Context& context) {
  if (transfer_ != transfer) {
    if (transfer_ == Transfer::kNone) {
      index_ = 0;
      sub_ = 0;
    }
    abort(context, SdoAbort::kCommand);
    return false;
  }
  const bool toggle = (request.data[0] & can::kToggleBit) != 0;
  if (toggle != toggle_) abort(context, SdoAbort::kToggle);
  return toggle == toggle_;
}

void SdoServer::take_segment(const CanFrame& request, Context& context) {
  if (!follows(request, Transfer::kDownload, context)) return;
  const std::uint8_t command = request.data[0];
  const std::size_t size = can::kSegmentBytes - (command >> can::kSegmentUnusedShift & 7U);
  if (done_ + size > bytes_.data.size()) return abort(context, SdoAbort::kTooLong);
  std::memcpy(bytes_.data.data() + done_, request.data.data() + 1, size);
  done_ += size;
  if ((command & can::kLastSegment) != 0) {
    transfer_ = Transfer::kNone;
    finish_download(bytes_.data.data(), done_, context);
    if (!context.answer.written) return;
  }
  const auto toggled = static_cast<std::uint8_t>(toggle_ ? can::kToggleBit : 0);
  CanFrame frame = answer_frame(context.node, can::kSegmentDownloaded | toggled, 0, 0);
  toggle_ = !toggle_;
  context.answer.sent = true;
  context.answer.frame = frame;
}

void SdoServer::begin_upload(const CanFrame& request, Context& context) {
  reset();
  index_ = can::load<std::uint16_t>(request.data, 1);
  sub_ = request.data[3];
  const SdoAbort code = read_object(context.dictionary, index_, sub_, bytes_);
  if (code != SdoAbort::kNone) return abort(context, code);
  SdoAnswer& answer = context.answer;
  answer.sent = true;
  const bool expedited = bytes_.size <= can::kExpeditedBytes;
  std::uint8_t command = can::kUploaded | can::kSizeGiven;
  if (expedited) {
    const std::size_t unused = can::kExpeditedBytes - bytes_.size;
    command = static_cast<std::uint8_t>(command | can::kExpedited | unused << can::kUnusedShift);
  }
  answer.frame = answer_frame(context.node, command, index_, sub_);
  if (expedited) {
    std::memcpy(answer.frame.data.data() + 4, bytes_.data.data(), bytes_.size);
    return;
  }
  can::store(answer.frame.data, 4, static_cast<std::uint32_t>(bytes_.size));
  transfer_ = Transfer::kUpload;
  toggle_ = false;
  done_ = 0;
}

void SdoServer::give_segment(const CanFrame& request, Context& context) {
  if (!follows(request, Transfer::kUpload, context)) return;
  const std::size_t size = std::min(can::kSegmentBytes, bytes_.size - done_);
  const std::size_t unused = can::kSegmentBytes - size;
  CanFrame frame = answer_frame(context.node, 0, 0, 0);
  unsigned command = can::kSegmentUploaded | (toggle_ ? can::kToggleBit : 0U);
  command |= static_cast<unsigned>(unused) << can::kSegmentUnusedShift;
  std::memcpy(frame.data.data() + 1, bytes_.data.data() + done_, size);
  done_ += size;
  if (done_ == bytes_.size) {
    command |= can::kLastSegment;
    transfer_ = Transfer::kNone;
  }
  frame.data[0] = static_cast<std::uint8_t>(command);
  toggle_ = !toggle_;
  context.answer.sent = true;
  context.answer.frame = frame;
}

}  // namespace tactus::drives
