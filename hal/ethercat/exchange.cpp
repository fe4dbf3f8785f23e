#include "hal/ethercat/exchange.hpp"

namespace tactus::ethercat {

void Exchange::ask(const Request& request, std::int64_t now_ns) {
  request_ = request;
  progress_ = Progress::kBusy;
  to_send_ = true;
  attempts_ = 1;
  sent_ns_ = now_ns;
  ++index_;
}

bool Exchange::take(Frame& frame) {
  if (!to_send_) return false;
  to_send_ = false;
  FrameWriter writer(frame, source_);
  const bool fits = request_.add_to(writer, index_);
  writer.pad();
  return fits;
}

/// The register or logical half of the address returns unchanged.
void Exchange::receive(Frame& frame) {
  if (progress_ != Progress::kBusy) return;
  FrameReader reader(frame);
  Datagram datagram;
  if (!reader.next(datagram) || datagram.index != index_ || datagram.size != request_.size ||
      datagram.command != request_.command || datagram.reg() != request_.address >> 16)
    return;
  counter_ = datagram.counter();
  std::memcpy(data_.data(), datagram.data, request_.kept());
  progress_ = Progress::kDone;
  to_send_ = false;
}

/// Sent again under a new index: a late answer to the old one must not pass for the new.
void Exchange::advance(std::int64_t now_ns) {
  if (progress_ != Progress::kBusy || now_ns - sent_ns_ < kAnswer_ns) return;
  if (attempts_ == kAttempts) {
    progress_ = Progress::kLost;
    to_send_ = false;
    return;
  }
  ++attempts_;
  ++index_;
  sent_ns_ = now_ns;
  to_send_ = true;
}

}  // namespace tactus::ethercat
