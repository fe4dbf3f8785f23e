#include "hal/ur/dashboard_client.hpp"

#include <cstring>

#include "hal/net/printable.hpp"

namespace tactus::ur {
namespace {

constexpr std::string_view kGreeting = "Connected:";
/// "... please switch robot to Remote Control mode and reconnect to port 29999"
constexpr std::string_view kNotInRemoteControl = "Command is not allowed due to safety reasons";

bool begins_with(std::string_view text, std::string_view words) {
  return text.substr(0, words.size()) == words;
}

}  // namespace

Status DashboardClient::connect(const char* address, int port, const Deadline& deadline,
                                Message& why) {
  address_ = address;
  port_ = port;
  forget_connection();
  answer_ = Answer::kNone;
  if (const Status status = socket_.connect(address, port, deadline, why); status != Status::kOk) {
    why << "; the robot answers at rtde_port, so check dashboard_port; one that has no dashboard "
           "server, as PolyScope X, takes on_power_off and on_protective_stop = refuse only";
    return status;
  }
  Line greeting;
  for (std::int64_t left_ns = deadline.left_ns(); !greeted_ && left_ns > 0;
       left_ns = deadline.left_ns()) {
    if (!receive()) {
      explain_loss(why);
      return loss();
    }
    greeted_ = next_line(greeting);
    if (!greeted_ && !socket_.wait(left_ns)) break;
  }
  if (!greeted_) {
    why = Message("dashboard: no complete reply within ");
    why << deadline.whole_ms() << " ms; check the network or raise connect_ms";
    return Status::kBusTimeout;
  }
  if (begins_with(greeting, kGreeting)) return Status::kOk;
  why = Message("dashboard: unexpected greeting '");
  why << greeting << "'; check dashboard_port";
  return Status::kRefusedByRobot;
}

void DashboardClient::ask(std::string_view command, std::string_view expected) {
  command_ = command;
  expected_ = expected;
  refusal_ = Line();
  sent_ = repeated_ = false;
  answer_ = Answer::kPending;
}

DashboardClient::Answer DashboardClient::poll(Message& why) {
  if (answer_ != Answer::kPending) return answer_;
  if (!send() || !receive()) return answer_ = lose(why);
  Line reply;
  // There are at most as many lines as bytes.
  while (answer_ == Answer::kPending && next_line(reply)) {
    if (!greeted_) {
      greeted_ = true;
      if (!begins_with(reply, kGreeting)) answer_ = judge(reply, why);
      continue;
    }
    const bool ours = sent_ && unread_ == 1;
    if (unread_ > 0) --unread_;
    if (ours) answer_ = judge(reply, why);
  }
  return answer_;
}

DashboardClient::Answer DashboardClient::judge(std::string_view reply, Message& why) {
  if (begins_with(reply, expected_)) return Answer::kYes;
  refusal_ = Line(reply);
  why = Message("dashboard: the robot answered '");
  why << command_ << "' with '" << reply << "'";
  return begins_with(reply, kNotInRemoteControl) && repeat() ? Answer::kPending : Answer::kNo;
}

DashboardClient::Answer DashboardClient::lose(Message& why) {
  if (!endless_ && repeat()) return Answer::kPending;
  explain_loss(why);
  return Answer::kLost;
}

bool DashboardClient::repeat() {
  if (repeated_) return false;
  repeated_ = true;
  sent_ = false;
  forget_connection();
  return socket_.begin(address_, port_);
}

void DashboardClient::forget_connection() {
  size_ = 0;
  unread_ = 0;
  endless_ = greeted_ = false;
}

void DashboardClient::explain_loss(Message& why) const {
  why = Message("dashboard: ");
  if (endless_)
    why << "a reply of more than " << bytes_.size()
        << " bytes without an end; check dashboard_port";
  else
    why << (repeated_ && !greeted_ ? "the connection was lost, and no other could be made"
                                   : "the connection was closed");
  if (!refusal_.empty()) why << "; before, the robot answered '" << refusal_ << "'";
}

bool DashboardClient::send() {
  if (sent_ || !greeted_) return true;
  Text<127> line(command_);
  line << "\n";
  const std::string_view text(line);
  const Socket::Sent sent =
      socket_.send(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  sent_ = sent == Socket::Sent::kAll;
  if (sent_) ++unread_;
  return sent != Socket::Sent::kLost;
}

bool DashboardClient::receive() {
  if (std::string_view(bytes_.data(), size_).find('\n') != std::string_view::npos) return true;
  const std::size_t room = bytes_.size() - size_;
  endless_ = room == 0;
  if (endless_) return false;
  const long got = socket_.receive(reinterpret_cast<std::uint8_t*>(bytes_.data()) + size_, room);
  if (got > 0) size_ += static_cast<std::size_t>(got);
  return got >= 0;
}

bool DashboardClient::next_line(Line& line) {
  const std::size_t end = std::string_view(bytes_.data(), size_).find('\n');
  if (end == std::string_view::npos) return false;
  const bool windows = end > 0 && bytes_[end - 1] == '\r';
  line = Line(printable({bytes_.data(), windows ? end - 1 : end}));
  size_ -= end + 1;
  std::memmove(bytes_.data(), bytes_.data() + end + 1, size_);
  return true;
}

}  // namespace tactus::ur
