#include "hal/cia402/line_writer.hpp"

#include "hal/cia402/hex.hpp"

namespace tactus::cia402 {
namespace {

/// "2003h:1 = 5"
void append(Message& text, const ObjectLine& line) {
  text << hex(line.object.index) << ":" << int{line.object.sub} << " = ";
  line.append(text, line.bits);
}

}  // namespace

void LineWriter::begin(const ObjectLines& lines, int joint, StartupFindings& findings) {
  lines_ = &lines;
  joint_ = joint;
  findings_ = &findings;
  changed_ = false;
  next(0);
}

/// Goes to the first line of the joint from number `from` on.
void LineWriter::next(int from) {
  stage_ = Stage::kCompare;
  at_ = from;
  while (!done() && !line().is_for(joint_)) ++at_;
}

Status LineWriter::take(const TransferResult& transfer, Message& why) {
  const bool fits = !reads() || !transfer.size_known || transfer.bytes == line().object.bytes;
  if (!transfer.done || !fits) return refuse(transfer, why);
  if (stage_ == Stage::kWrite) {
    changed_ = true;
    stage_ = Stage::kReadBack;
  } else if (line().is(transfer.value)) {
    if (stage_ == Stage::kReadBack)
      findings_->written[static_cast<std::size_t>(joint_)] |= 1U << at_;
    next(at_ + 1);
  } else if (stage_ == Stage::kCompare) {
    stage_ = Stage::kWrite;
  } else {
    return refuse(transfer, why);
  }
  return Status::kOk;
}

Status LineWriter::refuse(const TransferResult& transfer, Message& why) const {
  const ObjectLine& wanted = line();
  why << "sdo at line " << wanted.line << ", ";
  append(why, wanted);
  if (!transfer.done) {
    why << ": it cannot be " << (reads() ? "read" : "written");
  } else if (transfer.size_known && transfer.bytes != wanted.object.bytes) {
    why << ": the object has " << transfer.bytes << " bytes, " << name(wanted.type) << " has "
        << int{wanted.object.bytes};
  } else {
    why << ": it keeps ";
    wanted.append(why, transfer.value);
    why << "; give a value that it keeps, see this object in the drive's manual";
  }
  return Status::kRefusedByRobot;
}

Message written_text(const ObjectLines& lines, const StartupFindings& findings, int n) {
  Message text, stored;
  std::uint32_t by_any = 0;
  for (const std::uint32_t written : findings.written) by_any |= written;
  int row = 0;
  for (; row < lines.count(); ++row)
    if ((by_any >> row & 1U) != 0 && n-- == 0) break;
  if (row == lines.count()) return text;
  append(text, lines[row]);
  const char* before = " written to the drives of joints ";
  for (int j = 0; j < kDof; ++j) {
    const auto at = static_cast<std::size_t>(j);
    if ((findings.written[at] >> row & 1U) == 0) continue;
    text << before << j + 1;
    before = ", ";
    if (findings.stored[at]) stored << (stored.empty() ? "; stored in " : ", ") << j + 1;
  }
  return text << stored;
}

}  // namespace tactus::cia402
