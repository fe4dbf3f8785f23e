// CoeInformation: what an emulated drive tells of its object dictionary (SDO information,
// ETG.1000.6, 5.6.3): lists of objects, and the descriptions of an object and of an entry. Requests
// in, fragments of an answer out, each as long as a mailbox has room for.
#pragma once

#include "sim_plant/ethercat/coe_objects.hpp"

namespace tactus::segment {

class CoeInformation {
 public:
  explicit CoeInformation(const CoeObjects& objects) : objects_(objects) {}

  void reset() { size_ = sent_ = 0; }
  /// Takes a request of `size` bytes, from its opcode on; an answer that goes on is given up. [any]
  void ask(const std::uint8_t* request, std::size_t size);
  bool has_more() const { return sent_ < size_; }
  /// Writes the next fragment, of at most `room` bytes, which are 8 or more. Returns its bytes.
  /// [any]
  std::size_t take(std::uint8_t* fragment, std::size_t room);

 private:
  static constexpr std::size_t kMostAnswer = 1024;

  void list(std::uint16_t type);
  void describe(std::uint16_t index);
  void describe_entry(std::uint16_t index, std::uint8_t sub);
  void fail(can::SdoAbort abort);
  void put8(std::uint8_t value) {
    if (size_ < answer_.size()) answer_[size_++] = value;
  }
  void put16(std::uint16_t value) {
    put8(static_cast<std::uint8_t>(value));
    put8(static_cast<std::uint8_t>(value >> 8));
  }
  void put_name(std::uint16_t index);

  const CoeObjects& objects_;
  std::uint8_t opcode_ = 0;
  std::array<std::uint8_t, kMostAnswer> answer_{};  // behind the header
  std::size_t size_ = 0, sent_ = 0;
};

}  // namespace tactus::segment
