#include "hal/ur/servo_program.hpp"

#include <charconv>
#include <cmath>
#include <cstring>

namespace tactus::ur {
namespace {

// Names between @ are replaced. A CB3 cannot add lists, so the joints are written out.
constexpr std::string_view kText =
    R"(def tactus_servo():
@tcp@@payload@  @zero@
  seen = read_input_integer_register(24)
  write_output_integer_register(24, seen)
  led = get_target_joint_positions()
  last = led
  step = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
  off = step
  left = 0
  pace = 1.0
  moving = False
  going = True
  late = 0
  waits = 0
  while going:
    if left > 0:
      left = left - 1
    end
    x = left / @blend@
    part = x * x * (3.0 - 2.0 * x)
    count = read_input_integer_register(24)
    if count < 0:
      going = False
    elif count != seen:
      q = [read_input_float_register(24), read_input_float_register(25), read_input_float_register(26), read_input_float_register(27), read_input_float_register(28), read_input_float_register(29)]
      jump = norm(q[0] - last[0]) + norm(q[1] - last[1]) + norm(q[2] - last[2]) + norm(q[3] - last[3]) + norm(q[4] - last[4]) + norm(q[5] - last[5])
      steps = count - seen
      if late > 0 or steps > 1.75 * pace:
        fade = 1.0 - (late + 1) * (late + 1) / @patience@
        off = [led[0] + fade * step[0] + part * off[0] - q[0], led[1] + fade * step[1] + part * off[1] - q[1], led[2] + fade * step[2] + part * off[2] - q[2], led[3] + fade * step[3] + part * off[3] - q[3], led[4] + fade * step[4] + part * off[4] - q[4], led[5] + fade * step[5] + part * off[5] - q[5]]
        left = @blend@
        part = 1.0
      end
      if not moving:
        going = jump <= @first_step@
      elif steps > 0:
        if late == 0:
          pace = pace + (steps - pace) / 16.0
        end
        step = [(q[0] - last[0]) / steps, (q[1] - last[1]) / steps, (q[2] - last[2]) / steps, (q[3] - last[3]) / steps, (q[4] - last[4]) / steps, (q[5] - last[5]) / steps]
      end
      moving = going
      led = q
      last = q
      seen = count
      late = 0
    elif moving:
      late = late + 1
      fade = 1.0 - late * late / @patience@
      led = [led[0] + fade * step[0], led[1] + fade * step[1], led[2] + fade * step[2], led[3] + fade * step[3], led[4] + fade * step[4], led[5] + fade * step[5]]
      going = fade > 0.0
    end
    if moving and going:
      write_output_integer_register(24, seen)
      q = [led[0] + part * off[0], led[1] + part * off[1], led[2] + part * off[2], led[3] + part * off[3], led[4] + part * off[4], led[5] + part * off[5]]
      servoj(q, t=@period@, lookahead_time=@lookahead@, gain=@gain@)
    elif going:
      waits = waits + 1
      going = waits < @first@
      sync()
    end
  end
  stopj(@deceleration@)
  write_output_integer_register(24, -1)
end
)";

/// Builds the text; a value that is out of range leaves it empty.
class Writer {
 public:
  explicit Writer(ServoProgramText& text) : text_(text) {}

  void add(std::string_view characters) {
    good_ = good_ && characters.size() <= text_.size() - size_;
    if (!good_) return;
    std::memcpy(text_.data() + size_, characters.data(), characters.size());
    size_ += characters.size();
  }
  void add(double value) {
    // With a point, so that the controller does not take it for an integer.
    std::array<char, 32> digits;
    good_ = good_ && std::abs(value) < 1e6;
    const auto [end, code] = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                           std::chars_format::fixed, 9);
    good_ = good_ && code == std::errc();
    if (good_) add({digits.data(), static_cast<std::size_t>(end - digits.data())});
  }
  template <class Vector>
  void add_list(const Vector& values) {
    for (int i = 0; i < values.size(); ++i) {
      if (i > 0) add(", ");
      add(values[i]);
    }
  }
  void add_tcp(const Vector6& tcp) {
    add("  set_tcp(p[");
    add_list(tcp);
    add("])\n");
  }
  void add_payload(double kg, const Vector3& com) {
    add("  set_payload(");
    add(kg);
    add(", [");
    add_list(com);
    add("])\n");
  }
  std::string_view text() const { return {text_.data(), good_ ? size_ : 0}; }

 private:
  ServoProgramText& text_;
  std::size_t size_ = 0;
  bool good_ = true;
};

void write(std::string_view name, const ServoProgram& script, Writer& writer) {
  if (name == "tcp" && script.sets_tcp) writer.add_tcp(script.tcp);
  if (name == "payload" && script.sets_payload)
    writer.add_payload(script.payload_kg, script.payload_com);
  if (name == "zero") writer.add(script.zero_force ? "zero_ftsensor()" : "sync()");
  if (name == "first") writer.add(kFirstSetPoint_s / script.period_s);
  if (name == "first_step") writer.add(script.first_step);
  if (name == "patience") writer.add((script.patience + 1.0) * (script.patience + 1.0));
  if (name == "blend") writer.add(kServoBlend);
  if (name == "period") writer.add(script.period_s);
  if (name == "lookahead") writer.add(script.lookahead_s);
  if (name == "gain") writer.add(script.gain);
  if (name == "deceleration") writer.add(script.deceleration);
}

bool within(double value, double low, double high) {
  return value >= low && value <= high;
}

bool good(const ServoProgram& script) {
  return script.tcp.allFinite() && script.payload_com.allFinite() &&
         within(script.payload_kg, 0.0, 100.0) && within(script.period_s, 0.001, 0.1) &&
         within(script.lookahead_s, 0.03, 0.2) && within(script.gain, 100.0, 2000.0) &&
         within(script.patience, 1, 125) && within(script.first_step, 0.0, 1.0) &&
         within(script.deceleration, 0.1, 100.0);
}

}  // namespace

std::string_view write_servo_program(const ServoProgram& script, ServoProgramText& text) {
  if (!good(script)) return {};
  Writer writer(text);
  std::string_view rest = kText;
  while (!rest.empty()) {
    const std::size_t begin = rest.find('@');
    writer.add({rest.data(), begin < rest.size() ? begin : rest.size()});
    if (begin >= rest.size()) break;
    rest.remove_prefix(begin + 1);
    const std::size_t end = rest.find('@');
    write({rest.data(), end}, script, writer);
    rest.remove_prefix(end + 1);
  }
  return writer.text();
}

}  // namespace tactus::ur
