#include "gateway/server/drive_text.hpp"

#include "gateway/verdict_text.hpp"

namespace tactus {

Message describe_code(const Hal& hal, std::uint32_t code) {
  Message text;
  if (code == 0) return text;
  const Message its = hal.code_text(code);
  if (its.empty()) return text << ", the drive's code " << std::size_t{code};
  return text << ", " << std::string_view(its);
}

Message describe_drive(const Hal& hal, const Event& event) {
  Message text;
  const bool warns = event.cause == Cause::kWarning, old = event.cause == Cause::kOldFault;
  if (event.joint < 0 || !(warns || old || event.cause == Cause::kDrive)) return text;
  text << "joint " << event.joint + 1
       << (warns ? " warns"
           : old ? " stood in fault, which arming clears: "
                 : ": ");
  if (!warns) text << describe(event.status).c_str();
  return text << describe_code(hal, event.code).c_str();
}

}  // namespace tactus
