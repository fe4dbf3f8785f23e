// Messages: what a board does when the computer at the other end of its link asks for something.
// Runs in the background; the cycles go on meanwhile.
#pragma once

#include <atomic>

#include "boards/bare_metal/machine.hpp"
#include "hal/serial/board_link.hpp"

namespace bare {

class Messages {
 public:
  Messages(tactus::serial::BoardLink& link, tactus::serial::SerialHal& hal)
      : link_(link), hal_(hal) {}

  /// Executes the message that waits, if one does, and answers it. False: there was nothing to do.
  /// [background]
  bool work();

  /// The machine whose cycles run, or null. [cyclic]
  Machine* running() const { return running_.load(std::memory_order_acquire); }
  tactus::serial::Pace pace() const { return pace_; }
  /// Reports that wait, as of the last work(). [cyclic]
  std::uint8_t reports() const { return reports_; }

 private:
  static constexpr std::size_t kMaxText = std::size_t{8} << 10;

  void execute(const tactus::serial::Frame& frame);
  void execute_reference(const tactus::serial::Frame& frame);
  tactus::Status prepare();
  void hello();
  void take_text(tactus::ByteReader payload);
  void load(tactus::ByteReader payload);
  void start(tactus::ByteReader payload);
  void stop();
  void take_waypoints(tactus::ByteReader payload);
  void send_point(tactus::ByteReader payload);
  void control(tactus::ByteReader payload);
  void give_reports();
  void give_fault();
  template <class Act>
  tactus::Verdict with_references(bool poses, Act act) {
    if (!machine_->takes(poses)) return {tactus::Status::kNotOffered};
    return machine_->with_references(poses, act);
  }
  void answer(tactus::Status status) { link_.answer(status); }
  void answer(const tactus::Verdict& verdict, std::uint32_t id);
  std::string_view text() const;

  tactus::serial::BoardLink& link_;
  tactus::serial::SerialHal& hal_;
  std::atomic<Machine*> running_{nullptr};
  Machine* machine_ = nullptr;  // loaded; null: not yet
  tactus::serial::Pace pace_ = tactus::serial::Pace::kTimer;
  tactus::Published<std::uint8_t> reports_;
  std::array<char, kMaxText> text_;  // that came over the link
  std::size_t text_size_ = 0;        // 0: the embedded one is loaded
  bool poses_ = false;               // space of the trajectory that comes
};

}  // namespace bare
