#include "gateway/server/parameter_texts.hpp"

#include <charconv>

namespace tactus {
namespace {

void add_number(Value& text, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value);
  text << std::string_view(digits, static_cast<std::size_t>(end.ptr - digits));
}

/// Numbers as a file may have them: those of the joints once, if they are all the same.
Value text_of(const double* values, int count, bool joints) {
  Value text;
  bool same = joints;
  for (int i = 1; i < count; ++i) same = same && values[i] == values[0];
  for (int i = 0; i < (same ? 1 : count); ++i) {
    if (i > 0) text << " ";
    add_number(text, values[i]);
  }
  return text;
}
Value text_of(double value) {
  return text_of(&value, 1, false);
}
Value text_of(int value) {
  Value text;
  text << value;
  return text;
}
Value text_of(const JointVector& value) {
  return text_of(value.data(), kDof, true);
}
Value text_of(const Vector3& value) {
  return text_of(value.data(), 3, false);
}

/// The visitor that counts the parameters of a section and writes one of them.
class ParameterWriter {
 public:
  ParameterWriter(int count, int wanted, PresentParameter& to)
      : count_(count), wanted_(wanted), to_(to) {}
  int count() const { return count_; }

  template <class Number>
  void param(const char* key, const Number& value, const Range& range, const char* unit) {
    if (takes(key, unit, false)) write(text_of(value), range);
  }
  template <class Number>
  void tunable(const char* key, const Number& value, const Range& range, const char* unit) {
    if (takes(key, unit, true)) write(text_of(value), range);
  }
  template <class Number>
  void optional(const char* key, const Number& value, const Range& range, const char* unit) {
    if (!takes(key, unit, false)) return;
    const Value text = text_of(value);
    write(std::string_view(text).substr(0, 3) == "nan" ? Value("none") : text, range);
  }
  void limit(const char* key, const JointVector& value, const char* unit) {
    if (!takes(key, unit, false)) return;
    to_.value = text_of(value);
    to_.range << "> 0, at most the robot's";
  }
  template <std::size_t N>
  void text(const char* key, const Text<N>& value, const char* /*meaning*/) {
    if (takes(key, "", false)) to_.value = Value(value);
  }
  /// The entries of a list do not fit in the text of a value: their number stands for them.
  template <class List>
  void lines(const char* key, const List& list, const char* /*meaning*/) {
    if (takes(key, "", false)) to_.value = Value("") << list.count() << " entries";
  }
  template <class Enum>
  void choice(const char* key, const Enum& value) {
    if (!takes(key, "", false)) return;
    to_.value = Value(name(value));
    for (const char* word : kNames<Enum>) to_.range << (to_.range.empty() ? "" : ", ") << word;
  }
  template <Quantity Q>
  void in(const char* /*key*/, const In<Q>& /*port*/) {}
  template <Quantity Q>
  void optional(const char* /*key*/, const In<Q>& /*port*/) {}
  template <Quantity Q>
  void out(const char* /*port*/, const Out<Q>& /*out*/) {}
  template <class Space>
  void channel(ReferenceChannel<Space>* /*channel*/) {}

 private:
  bool takes(const char* key, const char* unit, bool tunable) {
    if (count_++ != wanted_) return false;
    to_ = {{}, key, unit, {}, {}, tunable};
    return true;
  }
  void write(const Value& value, const Range& range) {
    to_.value = value;
    to_.range << range;
  }

  int count_, wanted_;
  PresentParameter& to_;
};

/// Writes parameter `wanted`; returns how many there are.
int walk(ParameterBook& book, ParameterBook::Copy which, int wanted, PresentParameter& to) {
  int count = 0;
  book.each_section(which, [&](std::string_view section, auto& described) {
    ParameterWriter writer(count, wanted, to);
    described.describe(writer);
    if (wanted >= count && wanted < writer.count()) to.section = section;
    count = writer.count();
  });
  return count;
}

}  // namespace

int count_parameters(ParameterBook& book) {
  PresentParameter none;
  return walk(book, ParameterBook::Copy::kPresent, -1, none);
}

bool parameter_at(ParameterBook& book, ParameterBook::Copy which, int index, PresentParameter& to) {
  return index >= 0 && index < walk(book, which, index, to);
}

}  // namespace tactus
