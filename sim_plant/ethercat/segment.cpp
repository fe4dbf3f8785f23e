#include "sim_plant/ethercat/segment.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::segment {

using namespace ethercat;

namespace {

constexpr std::uint8_t kPassed = 0x02;                 // of the sender's address
constexpr std::int64_t kApart_ns = 1'000'000'000'123;  // of the clocks when power comes on

bool is_logical(Command command) {
  return command == Command::kLrd || command == Command::kLwr || command == Command::kLrw;
}

}  // namespace

Status Segment::load(const SegmentSettings& settings, std::int64_t now_ns) {
  settings_ = settings;
  if (settings.slaves < 1 || settings.slaves > kDof) return Status::kBadValue;
  drives::DrivenArm::Axes axes{};
  for (int i = 0; i < settings.slaves; ++i) {
    SlaveSettings slave;
    slave.number = static_cast<std::uint8_t>(i + 1);
    slave.store_ns = settings.store_ns;
    slave.axis = drives::axis_settings(settings, static_cast<std::size_t>(i));
    slave.places = settings.places[static_cast<std::size_t>(i)];
    slave.lrw = !settings.no_lrw[static_cast<std::size_t>(i)];
    slave.sync0 = settings.sync0[static_cast<std::size_t>(i)];
    slave.clock =
        EscClock(kApart_ns * (i + 1), i % 2 == 0 ? settings.drift_ppb : -settings.drift_ppb);
    slaves_[static_cast<std::size_t>(i)].power_on(slave);
    slaves_[static_cast<std::size_t>(i)].faults().seed(settings.seed, i + 1);
    axes[static_cast<std::size_t>(i)] = &slaves_[static_cast<std::size_t>(i)].axis();
  }
  line_.seed(settings.seed);
  count_ = 0;
  holds_ = false;
  last_reached_ = 0;
  plant_ns_ = now_ns;
  frame_ns_ = now_ns - kNoFrames_ns;
  TRY(driven_.load(settings, axes));
  for (int i = 0; i < settings.slaves; ++i) slave(i).measure(driven_.sample(i));
  return Status::kOk;
}

bool Segment::add(const drives::Fault& fault) {
  bool room = true;
  for (int i = 0; i < settings_.slaves; ++i) room = slave(i).faults().add(fault) && room;
  return room;
}

bool Segment::carries_outputs(Frame& frame) const {
  FrameReader reader(frame);
  Datagram datagram;
  bool found = false;
  while (reader.next(datagram))
    found = found || datagram.command == Command::kLrw || datagram.command == Command::kLwr;
  return found;
}

void Segment::receive(const Frame& frame, std::int64_t now_ns) {
  Frame passing = frame;
  const std::int64_t periods = driven_.periods();
  const bool cyclic = carries_outputs(passing);
  if (cyclic) {
    move();
    plant_ns_ = frame_ns_ = now_ns;
  }
  if (const LineFault* fault = line_.once(LineFaultKind::kFall, periods))
    if (fault->slave >= 1 && fault->slave <= settings_.slaves)
      slave(fault->slave - 1).fall(fault->value);
  const LineFault* broken = line_.active(LineFaultKind::kBreak, periods);
  const int reached =
      broken != nullptr ? std::min(broken->slave, settings_.slaves) : settings_.slaves;
  if (reached != last_reached_)
    for (int i = 0; i < settings_.slaves; ++i) slave(i).esc().set_line(i + 1 == reached);
  last_reached_ = reached;
  pass(passing, reached, now_ns);
  for (int i = 0; i < reached; ++i) slave(i).serve(now_ns);
  if (reached == 0 || (cyclic && line_.active(LineFaultKind::kLose, periods) != nullptr)) return;
  if (holds_) {
    holds_ = false;
    send_back(held_);
  }
  if (cyclic && line_.active(LineFaultKind::kDelay, periods) != nullptr) {
    held_ = passing;
    holds_ = true;
    return;
  }
  send_back(passing);
}

void Segment::pass(Frame& frame, int reached, std::int64_t now_ns) {
  FrameReader reader(frame);
  Datagram datagram;
  const LineFault* const counter = line_.active(LineFaultKind::kCounter, driven_.periods());
  while (reader.next(datagram)) {
    for (int i = 0; i < reached; ++i) slave(i).esc().process(datagram, now_ns + i * kHop_ns);
    if (counter != nullptr && is_logical(datagram.command))
      datagram.set_counter(static_cast<std::uint16_t>(datagram.counter() + counter->value));
  }
  if (!reader.whole()) ++malformed_;
  for (int i = 0; i < reached; ++i)
    slave(i).esc().note_return(now_ns + (2 * (reached - 1) - i) * kHop_ns, i + 1 == reached);
  if (reached > 0) frame.bytes[6] |= kPassed;
}

void Segment::send_back(const Frame& frame) {
  if (count_ < kQueue) back_[(first_ + count_++) % kQueue] = frame;
}

bool Segment::take(Frame& frame) {
  if (count_ == 0) return false;
  frame = back_[first_];
  first_ = (first_ + 1) % kQueue;
  --count_;
  return true;
}

void Segment::advance(std::int64_t now_ns) {
  const auto period_ns = static_cast<std::int64_t>(std::llround(slave(0).axis().period_s() * 1e9));
  if (now_ns - frame_ns_ >= kNoFrames_ns) {
    for (int n = 0; now_ns - plant_ns_ >= period_ns; ++n) {
      plant_ns_ = n < kMostAtOnce ? plant_ns_ + period_ns : now_ns;
      move();
    }
  }
  for (int i = 0; i < settings_.slaves; ++i) slave(i).advance(now_ns, driven_.periods());
}

/// Moves the arm by one period with the commands in force.
void Segment::move() {
  const double period_s = slave(0).axis().period_s();
  for (int i = 0; i < settings_.slaves; ++i) slave(i).begin_period(driven_.sample(i), period_s);
  driven_.move(period_s);
  for (int i = 0; i < settings_.slaves; ++i) slave(i).measure(driven_.sample(i));
}

}  // namespace tactus::segment
