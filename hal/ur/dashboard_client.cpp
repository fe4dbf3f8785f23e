#include "hal/ur/dashboard_client.hpp"

#include <cstring>

#include "hal/net/printable.hpp"

namespace tactus::ur {

Status DashboardClient::connect(const char* address, int port, const Deadline& deadline,
                                Message& why) {
  size_ = 0;
  unread_ = 0;
  endless_ = false;
  answer_ = Answer::kNone;
  if (const Status status = socket_.connect(address, port, deadline, why); status != Status::kOk) {
    why << "; the robot answers at rtde_port, so check dashboard_port; one that has no dashboard "
           "server, as PolyScope X, takes on_power_off and on_protective_stop = refuse only";
    return status;
  }
  Line greeting;
  bool greeted = false;
  for (std::int64_t left_ns = deadline.left_ns(); !greeted && left_ns > 0;
       left_ns = deadline.left_ns()) {
    if (!receive()) {
      explain_loss(why);
      return loss();
    }
    greeted = next_line(greeting);
    if (!greeted && !socket_.wait(left_ns)) break;
  }
  if (!greeted) {
    why = Message("dashboard: no complete reply within ");
    why << deadline.whole_ms() << " ms; check the network or raise connect_ms";
    return Status::kBusTimeout;
  }
  if (std::string_view(greeting).substr(0, 10) == "Connected:") return Status::kOk;
  why = Message("dashboard: unexpected greeting '");
  why << greeting << "'; check dashboard_port";
  return Status::kRefusedByRobot;
}

void DashboardClient::ask(std::string_view command, std::string_view expected) {
  command_ = command;
  expected_ = expected;
  sent_ = false;
  answer_ = Answer::kPending;
}

DashboardClient::Answer DashboardClient::poll(Message& why) {
  if (answer_ != Answer::kPending) return answer_;
  if (!send() || !receive()) {
    explain_loss(why);
    return answer_ = Answer::kLost;
  }
  Line reply;
  // There are at most as many lines as bytes.
  while (answer_ == Answer::kPending && next_line(reply)) {
    const bool ours = sent_ && unread_ == 1;
    if (unread_ > 0) --unread_;
    if (ours) answer_ = judge(reply, why);
  }
  return answer_;
}

DashboardClient::Answer DashboardClient::judge(std::string_view reply, Message& why) {
  if (reply.substr(0, expected_.size()) == expected_) return Answer::kYes;
  why = Message("dashboard: the robot answered '");
  why << command_ << "' with '" << reply << "'";
  return Answer::kNo;
}

void DashboardClient::explain_loss(Message& why) const {
  why = Message("dashboard: ");
  if (endless_)
    why << "a reply of more than " << bytes_.size()
        << " bytes without an end; check dashboard_port";
  else
    why << "the connection was closed";
}

bool DashboardClient::send() {
  if (sent_) return true;
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
