#include "hal/can/node_scan.hpp"

namespace tactus::can {
namespace {

CanFrame device_type_request(int node) {
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(kSdoRequestBase + node);
  frame.size = kSdoSize;
  frame.data[0] = kUpload;
  store(frame.data, 1, kDeviceType);
  return frame;
}

/// Node of a frame that a node with such a base sends, or 0.
int node_of(const CanFrame& frame, std::uint16_t base) {
  const int node = frame.id - base;
  return node >= 1 && node <= kMaxNode ? node : 0;
}

}  // namespace

void NodeScan::begin(const ScanTimes& times, std::int64_t now_ns) {
  times_ = times;
  for (NodeReport& report : reports_) report = NodeReport();
  sdo_ = SdoClient();
  SdoTimes sdo_times;
  sdo_times.answer_ns = times.answer_ns;
  sdo_.set_times(sdo_times);
  stage_ = Stage::kAsk;
  began_ns_ = now_ns;
  asked_ns_ = now_ns - kSpacing_ns;
  node_ = 0;
  has_request_ = false;
}

bool NodeScan::take(CanFrame& request) {
  if (!has_request_) return sdo_.take(request);
  request = request_;
  has_request_ = false;
  return true;
}

void NodeScan::receive(const CanFrame& frame, std::int64_t now_ns) {
  if (frame.remote) return;
  if (const int node = node_of(frame, kHeartbeatBase); node > 0 && frame.size == 1) {
    const auto state = static_cast<NmtState>(frame.data[0]);
    if (name(state) == nullptr) return;
    NodeReport& report = reports_[static_cast<std::size_t>(node)];
    report.heard = true;
    report.nmt = state;
  }
  for (const std::uint16_t base : kTpdoBase)
    if (const int node = node_of(frame, base); node > 0)
      reports_[static_cast<std::size_t>(node)].sends_pdos = true;
  if (const int node = node_of(frame, kSdoAnswerBase); node > 0 && frame.size == kSdoSize)
    reports_[static_cast<std::size_t>(node)].answers = true;
  sdo_.receive(frame, now_ns);
}

bool NodeScan::advance(std::int64_t now_ns) {
  if (stage_ == Stage::kDetails && now_ns - began_ns_ >= times_.whole_ns) {
    current().trouble = Message("the time of the scan is over");
    stage_ = Stage::kDone;
  }
  switch (stage_) {
    case Stage::kAsk: ask_next(now_ns); break;
    case Stage::kWait:
      if (now_ns - asked_ns_ < times_.answer_ns) break;
      stage_ = Stage::kDetails;
      node_ = 0;
      if (!find_node()) stage_ = Stage::kListen;
      break;
    case Stage::kDetails: read_on(now_ns); break;
    case Stage::kListen:
      if (now_ns - began_ns_ >= times_.listen_ns) stage_ = Stage::kDone;
      break;
    case Stage::kDone: break;
  }
  return stage_ != Stage::kDone;
}

void NodeScan::ask_next(std::int64_t now_ns) {
  if (now_ns - asked_ns_ < kSpacing_ns) return;
  asked_ns_ = now_ns;
  request_ = device_type_request(++node_);
  has_request_ = true;
  if (node_ == kMaxNode) stage_ = Stage::kWait;
}

/// Moves to the next node that answers or may answer: a node can have booted after its request.
bool NodeScan::find_node() {
  do ++node_;
  while (node_ <= kMaxNode && !current().may_answer());
  part_ = Part::kNumbers;
  row_ = step_ = 0;
  return node_ <= kMaxNode;
}

void NodeScan::read_on(std::int64_t now_ns) {
  sdo_.advance(now_ns);
  switch (sdo_.progress()) {
    case Progress::kBusy: return;
    case Progress::kIdle: break;
    case Progress::kDone: keep(); break;
    case Progress::kAborted:
      if (sdo_.abort() == SdoAbort::kTimeout) {
        current().trouble = sdo_.describe();
        part_ = Part::kEnd;
      } else {
        skip();
      }
      break;
  }
  Address object;
  while (!find_object(object))
    if (!find_node()) {
      stage_ = Stage::kListen;
      return;
    }
  sdo_.upload(static_cast<std::uint8_t>(node_), object.index, object.sub, now_ns);
}

int NodeScan::count() const {
  int present = 0;
  for (const NodeReport& report : reports_) present += report.present() ? 1 : 0;
  return present;
}

}  // namespace tactus::can
