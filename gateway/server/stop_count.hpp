// StopCount: numbers whatever stops the arm or slows it down, so that a request to make it move
// again can be judged by what its client had been told: what was on its way when another stopped
// the arm must not undo that.
#pragma once

#include <cstdint>

namespace tactus {

class StopCount {
 public:
  /// By no client, as a fault.
  static constexpr std::uint64_t kNobody = 0;

  /// The arm was stopped or slowed down by the client of a session.
  void add(std::uint64_t by) {
    if (by != newest_by_) others_ = newest_;
    newest_by_ = by;
    ++newest_;
  }
  /// Number of the newest; it begins with 1, which is none.
  std::uint32_t newest() const { return newest_; }
  /// True if a client can have been told this number.
  bool told(std::uint32_t number) const { return number >= 1 && number <= newest_; }
  /// True if a client that was told this number knows of all but its own.
  bool known(std::uint32_t number, std::uint64_t session) const {
    return told(number) && number >= (newest_by_ == session ? others_ : newest_);
  }

 private:
  std::uint32_t newest_ = 1, others_ = 1;  // others_: of the newest by another than newest_by_
  std::uint64_t newest_by_ = kNobody;
};

}  // namespace tactus
