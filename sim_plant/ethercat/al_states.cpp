// DriveSlave: the states of the application layer (ETG.1000.6, EtherCAT state machine).
#include <cmath>

#include "sim_plant/ethercat/drive_slave.hpp"

namespace tactus::segment {

using namespace ethercat;

namespace {

constexpr std::uint16_t kNoBoot = 0x0013;

bool is_state(unsigned code) {
  return code == 1 || code == 2 || code == 3 || code == 4 || code == 8;
}
AlState below(AlState state) {
  switch (state) {
    case AlState::kOp: return AlState::kSafeop;
    case AlState::kSafeop: return AlState::kPreop;
    default: return AlState::kInit;
  }
}

}  // namespace

/// While an error is shown only an acknowledgement is heard.
void DriveSlave::request(std::uint16_t control, std::int64_t now_ns) {
  const bool acknowledges = (control & kAlErrorBit) != 0;
  if (error_ && !acknowledges) return;
  error_ = false;
  awaits_outputs_ = false;
  const unsigned code = control & kAlStateBits;
  if (!is_state(code)) return refuse(kAlUnknownState);
  const auto to = static_cast<AlState>(code);
  if (to == AlState::kBoot) return refuse(kNoBoot);
  if (to <= state_) return enter(to);
  if (below(to) != state_) return refuse(kAlInvalidChange);
  if (const std::uint16_t wrong = judge(to)) return refuse(wrong);
  if (to != AlState::kOp || has_outputs_) return enter(to);
  awaits_outputs_ = true;
  requested_ns_ = now_ns;
  esc_.show(static_cast<std::uint16_t>(state_), 0);
}

/// Returns why the state above cannot be entered, 0: it can.
std::uint16_t DriveSlave::judge(AlState to) const {
  const SmPlaces& places = settings_.places;
  switch (to) {
    case AlState::kPreop: {
      const bool fits = places_fit(0, places.mailbox_out, places.mailbox_out_bytes, true) &&
                        places_fit(1, places.mailbox_in, places.mailbox_in_bytes, false);
      return fits ? std::uint16_t{0} : kAlMailboxSetup;
    }
    case AlState::kSafeop: {
      const std::size_t out = objects_.process_data(true).bytes;
      const std::size_t in = objects_.process_data(false).bytes;
      if (!places_fit(2, places.outputs, out, true)) return kAlOutputSetup;
      return places_fit(3, places.inputs, in, false) ? judge_sync0() : kAlInputSetup;
    }
    default: return 0;
  }
}

std::uint16_t DriveSlave::judge_sync0() const {
  if (!settings_.sync0) return 0;
  if (!esc_.sync0()) return kAlSyncSetup;
  const bool in_period = esc_.reg32(kSyncCycleReg) == std::llround(axis_.period_s() * 1e9);
  return in_period ? std::uint16_t{0} : kAlSync0Cycle;
}

/// True if a sync manager is where the drive has it. Without bytes it is off.
bool DriveSlave::places_fit(std::size_t sm, std::uint16_t start, std::size_t length,
                            bool written) const {
  const SyncManager manager = esc_.sm(sm);
  if (length == 0) return !manager.enabled();
  const bool mailbox = sm < 2;
  return manager.enabled() && manager.start == start && manager.length == length &&
         manager.written() == written && manager.mailbox() == mailbox;
}

void DriveSlave::enter(AlState state) {
  if (state_ == AlState::kOp && state != AlState::kOp) leave_operation();
  if (state == AlState::kPreop && state_ == AlState::kInit)
    server_.reset(settings_.places.mailbox_in_bytes);
  if (state == AlState::kSafeop && state_ == AlState::kPreop) {
    outputs_ = objects_.process_data(true);
    inputs_ = objects_.process_data(false);
    has_outputs_ = false;
    static_cast<void>(esc_.take_outputs());
  }
  if (state == AlState::kOp) clear(drives::kCommunicationLost);
  state_ = state;
  esc_.show(static_cast<std::uint16_t>(state_), 0);
}

void DriveSlave::refuse(std::uint16_t code) {
  error_ = true;
  esc_.show(static_cast<std::uint16_t>(static_cast<unsigned>(state_) | kAlErrorBit), code);
}

void DriveSlave::fall(std::uint16_t code) {
  if (state_ == AlState::kOp) {
    leave_operation();
    state_ = AlState::kSafeop;
  }
  awaits_outputs_ = false;
  refuse(code);
}

/// The master has gone, or has taken the drive out of operation: reaction of 6007h.
void DriveSlave::leave_operation() {
  has_outputs_ = false;
  if (axis_.powered() && axis_.abort_connection()) raise(drives::kCommunicationLost);
  show_state();
}

}  // namespace tactus::segment
