// EthercatMaster: what it asks the drives while their brakes open, and what it says of a fault.
#include "hal/cia402/hex.hpp"
#include "hal/ethercat/ethercat_master.hpp"

namespace tactus::ethercat {

/// While the brakes open, every drive is asked for the mode that it is in.
void EthercatMaster::check_modes() {
  if (drives_.phase() < cia402::Phase::kReleasing || drives_.phase() > cia402::Phase::kArmed) {
    checked_ = 0;
    asks_ = false;
    return;
  }
  if (checked_ == kDof) return;
  const Slave& slave = slaves_[static_cast<std::size_t>(checked_)];
  const cia402::Object& display = cia402::kModeDisplay;
  if (!asks_) {
    asks_ = true;
    boxed_ = checked_;
    port_.reset();
    coe_.upload(slave.boxes.out_bytes, display.index, display.sub, now_ns_);
    return;
  }
  if (coe_.progress() == CoeClient::Progress::kBusy) return;
  const auto mode = static_cast<cia402::Mode>(coe_.value());
  constexpr const char* kWhat = "its display of the mode of operation (6061h) ";
  if (coe_.progress() != CoeClient::Progress::kDone)
    drives_.fail(checked_, Status::kBusTimeout, 0, kWhat,
                 "cannot be read: ", can::meaning(coe_.abort()));
  else if (mode != cia402::mode_of(mode_))
    drives_.fail(checked_, Status::kDriveFault, 0, kWhat, "is not that of the commands, but ",
                 cia402::name(mode));
  ++checked_;
  asks_ = false;
}

Message EthercatMaster::trouble() const {
  if (!why_.empty()) return why_;
  Message text = drives_.why();
  int first = kDof;  // of the line, that does not answer
  for (const Slave& slave : slaves_)
    if (slave.unanswered > 0 && slave.position < first) first = slave.position;
  if (first < kDof)
    text << "; slave " << first + 1 << " does not answer: check its power and the cable to it";
  for (int j = 0; j < kDof; ++j) {
    const Slave& slave = slaves_[static_cast<std::size_t>(j)];
    if (slave.feedback.lost == Status::kOk || slave.al_code == 0) continue;
    text << "; slave " << slave.position + 1 << " is in "
         << name(static_cast<AlState>(slave.al_status & kAlStateBits)) << ": "
         << al_code_text(slave.al_code) << " (" << cia402::hex(slave.al_code).c_str() << ")";
    break;
  }
  return text;
}

}  // namespace tactus::ethercat
