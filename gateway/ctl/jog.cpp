// jog: velocities of joints by keys or a joystick. Each velocity holds for --hold-ms at most, so
// that the arm stops when a key is released, and when a key's release, this program or the network
// is lost.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "gateway/ctl/input_devices.hpp"
#include "gateway/ctl/interrupt.hpp"
#include "gateway/ctl/verbs.hpp"

namespace tactus::ctl {
namespace {

constexpr int kRepeat_ms = 50;  // between two velocities of a joystick
constexpr int kIdle_ms = 200;
constexpr const char* kJogKeys =
    "1..9 choose a joint; + and - (or arrows) move it while held; [ and ] change the speed; "
    "space stops; q ends";

class Jogger {
 public:
  explicit Jogger(Session& session) : s_(session), speed_(session.options.speed) {}

  bool run();

 private:
  bool by_keys();
  bool by_joystick();
  bool press(const std::string& keys);
  bool take_key(char key);
  bool move(const std::vector<double>& shares);
  ToServer velocity_of(const std::vector<double>& shares) const;
  void take(const ToClient& message);
  void show();
  std::size_t joints() const { return static_cast<std::size_t>(s_.client.welcome().joints_size()); }

  Session& s_;
  double speed_;
  std::size_t joint_ = 0;
  bool ends_ = false, refused_ = false;
  State state_;
};

void Jogger::take(const ToClient& message) {
  if (message.has_state()) {
    state_ = message.state();
    s_.output.object("state", state_);
    show();
  }
  const bool late = message.has_report() && message.report().outcome() == Report::REFUSED;
  const bool answered = message.has_answer() && message.answer().status() != 0;
  if (refused_ || (!late && !answered)) return;
  refused_ = true;
  s_.client.refuse(late ? message.report().text() : message.answer().text());
}

void Jogger::show() {
  const auto joint = static_cast<int>(joint_);
  if (joint >= state_.q_size()) return;
  s_.output.progress("joint " + std::to_string(joint + 1) + " " +
                     printed(s_.client.welcome().joints(joint).name()) +
                     formatted("  %.4f ", state_.q(joint)) +
                     (s_.client.welcome().joints(joint).prismatic() ? "m" : "rad") +
                     formatted("  speed %.3g %%  ", speed_ * 100.0) + phase_name(state_.phase()));
}

/// Sends velocities, given as shares of the chosen speed.
bool Jogger::move(const std::vector<double>& shares) {
  ToServer request = velocity_of(shares);
  return s_.client.post(request) != 0;
}

ToServer Jogger::velocity_of(const std::vector<double>& shares) const {
  ToServer request;
  request.add_requires(FEATURE_VELOCITIES);
  Velocity& velocity = *request.mutable_velocity();
  velocity.set_timeout_ms(static_cast<std::uint32_t>(s_.options.hold_ms));
  for (std::size_t i = 0; i < joints(); ++i) {
    const double limit = s_.client.welcome().joints(static_cast<int>(i)).velocity();
    velocity.add_dq(i < shares.size() ? shares[i] * speed_ * limit : 0.0);
  }
  return request;
}

bool Jogger::take_key(char key) {
  if (key >= '1' && key <= '9')
    joint_ = std::min(joints() - 1, static_cast<std::size_t>(key - '1'));
  if (key == '[') speed_ = std::max(speed_ / 1.25, 0.001);
  if (key == ']') speed_ = std::min(speed_ * 1.25, 1.0);
  ends_ |= key == 'q';
  if (key == ' ') return move({});
  if (key != '+' && key != '-' && key != '=') return true;
  std::vector<double> shares(joints(), 0.0);
  shares[joint_] = key == '-' ? -1.0 : 1.0;
  return move(shares);
}

bool Jogger::press(const std::string& keys) {
  for (std::size_t i = 0; i < keys.size() && !ends_; ++i) {
    char key = keys[i];
    if (keys.compare(i, 2, "\x1b[") == 0 && i + 2 < keys.size()) {  // an arrow
      key = keys[i + 2] == 'A' || keys[i + 2] == 'C' ? '+' : '-';
      i += 2;
    }
    if (!take_key(key)) return false;
  }
  return true;
}

bool Jogger::by_keys() {
  const RawTerminal raw;
  s_.output.say(kJogKeys);
  std::string keys;
  while (!ends_ && !refused_ && interrupts() == 0) {
    if (!s_.client.wait(kIdle_ms, STDIN_FILENO)) return false;
    ends_ |= !take_keys(keys);
    if (!press(keys)) return false;
  }
  return true;
}

bool Jogger::by_joystick() {
  Joystick joystick;
  if (!joystick.open(s_.options.joystick))
    return s_.client.refuse(s_.options.joystick + ": " + std::strerror(errno) +
                            "; give a joystick, /dev/input/js0");
  s_.output.say("axis 1 moves joint 1, and so on; Ctrl-C ends");
  bool moved = false;
  while (!refused_ && interrupts() == 0) {
    if (!s_.client.wait(kRepeat_ms)) return false;
    if (!joystick.read()) return s_.client.refuse(s_.options.joystick + ": the joystick is gone");
    const std::vector<double>& axes = joystick.axes();
    const bool moves = std::any_of(axes.begin(), axes.end(), [](double x) { return x != 0.0; });
    if ((moves || moved) && !move(axes)) return false;
    moved = moves;
  }
  return true;
}

bool Jogger::run() {
  if (!offers(s_.client.welcome(), FEATURE_VELOCITIES))
    return s_.client.refuse("the server takes no velocities; use point or stream");
  ToServer subscription;
  subscription.mutable_subscribe()->set_state_ms(100);
  if (!s_.client.ask(subscription) || !s_.client.take_lease()) return false;
  count_interrupts();
  s_.client.on_message = [this](const ToClient& message) { take(message); };
  const bool ended = s_.options.joystick.empty() ? by_keys() : by_joystick();
  ToServer rest = velocity_of({});
  if (ended && !refused_) s_.client.ask(rest);  // and receive the answers to the others
  s_.output.end_progress();
  s_.client.release_lease();
  return ended && !refused_;
}

}  // namespace

int jog(Session& session) {
  Jogger(session).run();
  return session.client.exit_code();
}

}  // namespace tactus::ctl
