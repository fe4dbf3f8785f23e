// Startup: takes all slaves of the segment from any state to SAFEOP, with the process data of a
// cycle configured: a sequence of single datagrams. Frames in, frames out, time passed in.
//
// The line is counted and brought to INIT; then one slave after the other shows its
// EEPROM, goes to PREOP and gives its identity by SDO; nothing is written to any drive before all
// of them are those of the file. Then one after the other is set up by SDO, all get their process
// data, the clocks are set, and the slaves go to SAFEOP.
#pragma once

#include "hal/cia402/line_writer.hpp"
#include "hal/ethercat/clock_setup.hpp"
#include "hal/ethercat/slave.hpp"
#include "hal/ethercat/slave_setup.hpp"

namespace tactus::ethercat {

inline constexpr std::uint32_t kImageAddress = 0x00010000;  ///< logical, of the first output
inline constexpr std::size_t kMostImage = 1024;             ///< bytes

/// The process data of all drives in their image: the outputs first, then the inputs.
struct ImageShape {
  std::size_t outputs = 0, inputs = 0;  ///< bytes
  bool lrw = true;                      ///< all drives read and write in one datagram
  std::size_t bytes() const { return outputs + inputs; }
};

class Startup {
 public:
  /// Remedy where frames do not return.
  static constexpr const char* kCheck = "; check power, cabling and [ethercat] interface";

  Startup(Slaves& slaves, CoeClient& coe, Message& why)
      : slaves_(slaves), coe_(coe), port_(coe), why_(why) {}

  void begin(const EthercatSettings& ethercat, const cia402::Cia402Settings& drive,
             CommandMode mode, int period_us, std::int64_t now_ns);
  /// kArming until it is over. kBusTimeout, kRefusedByRobot, kTooLarge: `why` has the slave, what
  /// it did and what helps. [init]
  Status advance(std::int64_t now_ns);
  Exchange& exchange() { return exchange_; }
  /// Undoes the start-up: the next frame takes all slaves to INIT. False: no slave's state was
  /// changed, and there is no such frame. [init]
  bool give_up();
  /// kBusTimeout, and the reason: no frame returns. [init]
  Status silent();

  const ImageShape& image() const { return image_; }
  /// Values read from the drives. [init]
  const cia402::StartupFindings& findings() const { return findings_; }
  /// The clocks of the slaves. [any]
  const ClockSetup& clock() const { return clock_; }
  /// An AL status code in words, and what helps: "no valid outputs (0019h)". [init]
  Message code_text(std::uint16_t code) const;

 private:
  enum class Stage : std::uint8_t {
    kCount,
    kInit,
    kAwaitInit,
    kClear,
    kStation,
    kFeatures,
    kEeprom,
    kMailboxes,
    kPreop,
    kIdentify,
    kSetup,
    kMapping,
    kProcessData,
    kClocks,
    kSafeop,
    kDone
  };

  void enter(Stage stage);
  void next_slave(Stage again, Stage then);
  Request request();
  Request clear_request() const;
  Request state_request(AlState state) const;
  Request mailbox_request() const;
  Request process_request() const;
  Status take(const Answer& answer);
  Status count(const Answer& answer);
  Status await_init(const Answer& answer);
  Status take_features(const Answer& answer);
  Status take_eeprom(const Answer& answer);
  Status await_state(const Answer& answer, AlState state);
  Status take_process_data();
  Status place_image();
  Status take_clocks(const Answer& answer);
  Status refuse(Status status, std::string_view what);
  // startup_setup.cpp: what is read from and written to a drive by SDO
  void begin_steps(Stage stage);
  int steps_end() const;
  void leave_out();
  void ask_object(std::int64_t now_ns);
  Status take_mailbox(const Answer& answer);
  Status finish_step();
  Status judge_expected(const SetupStep& step);
  Status take_fact(const SetupStep& step);
  Status take_line();
  Status take_stored(const SetupStep& step);
  bool stores() const {
    return stage_ == Stage::kSetup && steps_.step(step_).kind == SetupStep::Kind::kStore;
  }
  bool is_left_out(const SetupStep& step) const;
  Status finish_mapping();

  Slave& at() { return line_.at(at_); }
  const Slave& at() const { return line_.at(at_); }
  int joint() const { return line_.joint(at_); }

  Slaves& slaves_;
  SlaveLine line_{slaves_};
  CoeClient& coe_;
  MailboxPort port_;
  Message& why_;
  const EthercatSettings* ethercat_ = nullptr;
  const cia402::Cia402Settings* drive_ = nullptr;
  CommandMode mode_ = CommandMode::kEffort;
  int period_us_ = 1;

  Stage stage_ = Stage::kCount;
  int at_ = 0;    // place in the line
  int step_ = 0;  // of the stage, with this slave
  int attempts_ = 0;
  std::int64_t now_ns_ = 0, since_ns_ = 0;
  Exchange exchange_;
  SlaveEeprom eeprom_;
  SlaveSetup steps_;
  cia402::DriveFacts facts_;  // of the present slave
  cia402::LineWriter lines_;
  cia402::StartupFindings findings_;
  MappingReader mapping_;
  ImageShape image_;
  ClockSetup clock_{line_, why_};
};

}  // namespace tactus::ethercat
