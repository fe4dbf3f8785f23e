#include "hal/ethercat/cyclic_frame.hpp"

#include <algorithm>

#include "kernel/core/loop_bound.hpp"

namespace tactus::ethercat {
namespace {

constexpr int kMostMissing = 1000;  // more are not counted
constexpr std::size_t kClockBytes = 8, kAskedBytes = 6;

/// Increments of the working counter: a slave adds 1 for reading and 1 for writing, 2 in LRW.
constexpr int expected(Command command) {
  return command == Command::kLrw ? 3 * kDof : kDof;
}
constexpr const char* name(Command command) {
  return command == Command::kLrw ? "LRW" : command == Command::kLrd ? "LRD" : "LWR";
}

// However large the image is, a message has room beside it.
static_assert(kMaxData - (kMostImage + 2 * (kDatagramBytes + kCounterBytes)) -
                  (kClockBytes + kAskedBytes + 2 * (kDatagramBytes + kCounterBytes)) >=
              Request::kKept);

}  // namespace

void CyclicFrame::start(const ImageShape& image, bool has_clock, const std::uint8_t* source) {
  const auto inputs = static_cast<std::uint32_t>(kImageAddress + image.outputs);
  parts_ = {};
  count_ = in_frame_ = 0;
  room_ = kMaxData;
  if (image.lrw) {
    add(PartKind::kImage, Command::kLrw, kImageAddress, image.bytes());
  } else {
    add(PartKind::kImage, Command::kLrd, inputs, image.inputs);
    add(PartKind::kImage, Command::kLwr, kImageAddress, image.outputs);
  }
  if (has_clock)
    add(PartKind::kClock, Command::kFrmw, address_of(kFirstStation, kSystemTimeReg), kClockBytes);
  add(PartKind::kAsked, Command::kFprd, 0, kAskedBytes);
  ++count_;  // the extra one
  has_clock_ = has_clock;
  std::memcpy(source_, source, sizeof source_);
  image_.fill(0);
  received_.fill(0);
  sent_ = came_ = has_reference_ = false;
  missing_ = 0;
  counts_ = {};
}

void CyclicFrame::add(PartKind kind, Command command, std::uint32_t address, std::size_t size) {
  parts_[count_++] = {kind, command, address, size, 0};
  room_ -= kDatagramBytes + size + kCounterBytes;
}

void CyclicFrame::compose(std::uint16_t asked, const Request& extra, Frame& frame) {
  FrameWriter writer(frame, source_);
  ++index_;
  LoopBound<static_cast<int>(kMostParts)> parts;
  for (in_frame_ = 0; in_frame_ + 1 < count_; ++in_frame_) {
    parts.tick();
    Part& part = parts_[in_frame_];
    if (part.kind == PartKind::kAsked) part.address = address_of(asked, kAlStatusReg);
    std::uint8_t* const data = writer.add(part.command, index_, part.address, part.size);
    if (part.kind == PartKind::kImage)
      std::memcpy(data, &image_[part.address - kImageAddress], part.size);
  }
  if (extra.add_to(writer, index_))
    parts_[in_frame_++] = {PartKind::kExtra, extra.command, extra.address, extra.size, 0};
  writer.pad();
  sent_ = true;
  came_ = false;
  extra_counter_ = 0;
  ++counts_.frames;
}

/// The datagram must be the one that was sent. The position of a datagram to a station stays as it
/// is, but that of others counts slaves.
bool CyclicFrame::take(const Datagram& datagram, Part& part) {
  const bool whole = part.kind == PartKind::kImage ? datagram.logical() == part.address
                                                   : datagram.reg() == part.address >> 16;
  if (datagram.command != part.command || datagram.size != part.size || !whole) return false;
  part.counter = datagram.counter();
  switch (part.kind) {
    case PartKind::kImage:
      std::memcpy(&received_[part.address - kImageAddress], datagram.data, part.size);
      break;
    case PartKind::kClock:
      has_reference_ = datagram.counter() > 0;
      reference_ns_ = get<std::int64_t>(datagram.data);
      break;
    case PartKind::kAsked:
      asked_status_ = get<std::uint16_t>(datagram.data);
      asked_code_ = get<std::uint16_t>(datagram.data + 4);
      asked_counter_ = datagram.counter();
      break;
    case PartKind::kExtra:
      extra_counter_ = datagram.counter();
      std::memcpy(extra_.data(), datagram.data, std::min(part.size, extra_.size()));
  }
  return true;
}

/// A frame counts only as a whole: nothing of it is used before its last datagram was found.
void CyclicFrame::receive(Frame& frame) {
  FrameReader reader(frame);
  Datagram datagram;
  if (!reader.next(datagram) || datagram.command != parts_[0].command) {
    ++counts_.strange;
    return;
  }
  if (datagram.index != index_) {
    ++counts_.late;
    return;
  }
  if (!sent_ || came_) {  // a copy
    ++counts_.strange;
    return;
  }
  bool right = take(datagram, parts_[0]);
  std::size_t place = 1;
  LoopBound<static_cast<int>(kMaxDatagrams)> datagrams;
  while (right && reader.next(datagram)) {
    datagrams.tick();
    right = place < in_frame_ && datagram.index == index_ && take(datagram, parts_[place]);
    ++place;
  }
  came_ = right && reader.whole() && place == in_frame_;
  if (!came_) ++counts_.strange;
}

bool CyclicFrame::exchanged() const {
  bool all = true;
  for (const Part& part : parts_)
    all = all && (part.kind != PartKind::kImage || part.counter == expected(part.command));
  return all;
}

Message CyclicFrame::counter_text() const {
  Message text;
  for (const Part& part : parts_) {
    if (part.kind != PartKind::kImage) continue;
    text << (text.empty() ? "the working counter of " : ", that of ") << name(part.command)
         << " is " << part.counter << ", expected " << expected(part.command);
  }
  return text;
}

CyclicFrame::Arrival CyclicFrame::close() {
  if (!sent_) return Arrival::kNothing;
  sent_ = false;
  if (!came_) {
    ++counts_.lost;
    missing_ += missing_ < kMostMissing;
    return Arrival::kNothing;
  }
  missing_ = 0;
  if (exchanged() && has_reference_ == has_clock_) return Arrival::kInputs;
  ++counts_.counter;
  return Arrival::kWrongCounter;
}

}  // namespace tactus::ethercat
