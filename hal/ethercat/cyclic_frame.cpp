#include "hal/ethercat/cyclic_frame.hpp"

#include "kernel/core/loop_bound.hpp"

namespace tactus::ethercat {
namespace {

// Places of the datagrams in the frame; that of the clock is left out where there is none.
constexpr int kImagePlace = 0, kClockPlace = 1, kAskedPlace = 2, kExtraPlace = 3;
constexpr int kPlaces = 4;
constexpr int kMostMissing = 1000;  // more are not counted
constexpr std::size_t kClockBytes = 8, kAskedBytes = 6;

}  // namespace

void CyclicFrame::start(std::size_t image_bytes, bool has_clock, const std::uint8_t* source) {
  image_bytes_ = image_bytes;
  has_clock_ = has_clock;
  std::memcpy(source_, source, sizeof source_);
  image_.fill(0);
  received_.fill(0);
  sent_ = came_ = has_reference_ = false;
  missing_ = 0;
  counts_ = {};
}

void CyclicFrame::compose(std::uint16_t asked, const Request& extra, Frame& frame) {
  FrameWriter writer(frame, source_);
  ++index_;
  std::memcpy(writer.add(Command::kLrw, index_, kImageAddress, image_bytes_), image_.data(),
              image_bytes_);
  if (has_clock_)
    writer.add(Command::kFrmw, index_, address_of(kFirstStation, kSystemTimeReg), kClockBytes);
  writer.add(Command::kFprd, index_, address_of(asked, kAlStatusReg), kAskedBytes);
  std::uint8_t* const data = writer.add(extra.command, index_, extra.address, extra.size);
  extra_bytes_ = data != nullptr ? extra.size : 0;
  if (data != nullptr) std::memcpy(data, extra.data.data(), extra.size);
  writer.pad();
  sent_ = true;
  came_ = false;
  ++counts_.frames;
}

/// Bytes of the datagram at a place, and its command, must be those that were sent.
bool CyclicFrame::take(const Datagram& datagram, int place) {
  const std::size_t sizes[kPlaces] = {image_bytes_, kClockBytes, kAskedBytes, extra_bytes_};
  if (datagram.size != sizes[place]) return false;
  switch (place) {
    case kImagePlace:
      counter_ = datagram.counter();
      std::memcpy(received_.data(), datagram.data, image_bytes_);
      return datagram.command == Command::kLrw && datagram.logical() == kImageAddress;
    case kClockPlace:
      has_reference_ = datagram.counter() > 0;
      reference_ns_ = get<std::int64_t>(datagram.data);
      return datagram.command == Command::kFrmw;
    case kAskedPlace:
      asked_status_ = get<std::uint16_t>(datagram.data);
      asked_code_ = get<std::uint16_t>(datagram.data + 4);
      asked_counter_ = datagram.counter();
      return datagram.command == Command::kFprd;
    case kExtraPlace:
      extra_counter_ = datagram.counter();
      std::memcpy(extra_.data(), datagram.data, extra_bytes_);
      return true;
    default: return false;
  }
}

/// A frame counts only as a whole: nothing of it is used before its last datagram was found.
void CyclicFrame::receive(Frame& frame) {
  FrameReader reader(frame);
  Datagram datagram;
  if (!reader.next(datagram) || datagram.command != Command::kLrw) {
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
  bool right = take(datagram, kImagePlace);
  int place = kImagePlace;
  LoopBound<static_cast<int>(kMaxDatagrams)> datagrams;
  while (right && reader.next(datagram)) {
    datagrams.tick();
    place += place == kImagePlace && !has_clock_ ? 2 : 1;
    right = place < kPlaces && datagram.index == index_ && take(datagram, place);
  }
  came_ = right && reader.whole() && place + 1 == kPlaces;
  if (!came_) ++counts_.strange;
}

CyclicFrame::Came CyclicFrame::close() {
  if (!sent_) return Came::kNothing;
  sent_ = false;
  if (!came_) {
    ++counts_.lost;
    missing_ += missing_ < kMostMissing;
    return Came::kNothing;
  }
  missing_ = 0;
  if (counter_ == kExpected && has_reference_ == has_clock_) return Came::kInputs;
  ++counts_.counter;
  return Came::kWrongCounter;
}

}  // namespace tactus::ethercat
