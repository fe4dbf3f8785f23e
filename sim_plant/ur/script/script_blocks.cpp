#include "sim_plant/ur/script/script_blocks.hpp"

#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

std::string_view ScriptBlocks::take(std::string_view line, int number) {
  if (line.empty()) return {};
  if (closed_) return "stands after the end of the program";
  const std::string_view word = leading_name(line);
  if (word == "def" || word == "sec") {
    whole_ = whole_ || number == 1;
    return open(Kind::kFunction, number);
  }
  if (word == "while") return open(Kind::kLoop, number);
  if (word == "if") return open(Kind::kIf, number);
  if (word == "end") return close();
  if ((word == "break" || word == "continue") && !in_loop()) return "stands outside of a loop";
  if (word != "else" && word != "elif") return {};
  if (depth_ == 0 || blocks_[depth_ - 1].kind == Kind::kLoop ||
      blocks_[depth_ - 1].kind == Kind::kFunction)
    return "belongs to no if";
  if (blocks_[depth_ - 1].kind == Kind::kElse) return "stands after else";
  if (word == "else") blocks_[depth_ - 1].kind = Kind::kElse;
  return {};
}

std::string_view ScriptBlocks::open(Kind kind, int number) {
  if (depth_ == blocks_.size()) return kTooDeep;
  blocks_[depth_++] = {kind, number};
  return {};
}

std::string_view ScriptBlocks::close() {
  if (depth_ == 0) return "ends no block";
  --depth_;
  closed_ = whole_ && depth_ == 0;
  return {};
}

/// True if a loop is around the line, within its function.
bool ScriptBlocks::in_loop() const {
  for (std::size_t i = depth_; i > 0 && blocks_[i - 1].kind != Kind::kFunction; --i)
    if (blocks_[i - 1].kind == Kind::kLoop) return true;
  return false;
}

}  // namespace tactus::ur
