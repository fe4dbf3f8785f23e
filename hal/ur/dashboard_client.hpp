// DashboardClient: power, brakes and protective stops, by the text commands of port 29999. A
// command is sent in one cycle, and its reply is taken in a later one. An e-Series refuses commands
// that are not sent in remote control over a connection made in it, and may close one when the
// pendant is switched: a command for which that happens is repeated once, over a new connection.
#pragma once

#include "hal/net/socket.hpp"

namespace tactus::ur {

class DashboardClient {
 public:
  enum class Answer : std::uint8_t {
    kNone,     ///< no command was given
    kPending,  ///< the reply has not arrived
    kYes,      ///< the reply is the expected one
    kNo,       ///< it is another one
    kLost,     ///< the connection is lost
  };

  /// Connects and waits for the greeting; the address must outlive the use. kConnectionLost,
  /// kBusTimeout, kRefusedByRobot. [init]
  Status connect(const char* address, int port, const Deadline& deadline, Message& why);
  /// Gives a command whose reply begins with `expected`; both texts must be constants. If the reply
  /// to the command before has not arrived, it is skipped. [cyclic]
  void ask(std::string_view command, std::string_view expected);
  /// Sends the command if it was not sent, and takes what has arrived of the reply. Returns the
  /// answer from then on; `why` explains the first kNo or kLost. [cyclic]
  Answer poll(Message& why);
  /// The Status of kLost: kConnectionLost, or kWireFormat for a reply without an end. [cyclic]
  Status loss() const { return endless_ ? Status::kWireFormat : Status::kConnectionLost; }
  /// The robot's last reply to the command if it was unexpected, else empty.
  std::string_view refusal() const { return refusal_; }
  void close() { socket_.close(); }

 private:
  using Line = Text<255>;

  /// False: the connection is lost.
  bool send();
  /// Takes bytes unless there is a whole line. False: the connection is lost, or a line has no end.
  bool receive();
  /// Takes a whole line off the bytes that have arrived.
  bool next_line(Line& line);
  Answer judge(std::string_view reply, Message& why);
  Answer lose(Message& why);
  /// Begins a new connection for the command, which is sent again. False: it had one, or cannot.
  bool repeat();
  void forget_connection();
  void explain_loss(Message& why) const;

  Socket socket_;
  std::array<char, Line::capacity() + 1> bytes_;
  std::size_t size_ = 0;
  std::string_view command_, expected_;
  const char* address_ = "";
  int port_ = 0;
  Line refusal_;
  bool greeted_ = false;
  bool repeated_ = false;  // the command is
  bool sent_ = false;
  int unread_ = 0;        // replies that have not arrived
  bool endless_ = false;  // a line is longer than any reply
  Answer answer_ = Answer::kNone;
};

}  // namespace tactus::ur
