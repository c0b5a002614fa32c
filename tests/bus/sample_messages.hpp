// Sample messages of every type, filled by the generated visitor.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "redbee/message_types.hpp"

namespace redbee::test {

/// Values that differ from zero and from each other, two or three elements in each array.
class SampleVisitor {
 public:
  template <typename Number>
  void value(Number& number) {
    number = static_cast<Number>(next());
  }
  void value(std::string& text) { text = "text " + std::to_string(next()); }
  void count(int32_t& n) { n = 2 + next() % 2; }
  template <typename Array>
  void resize(Array& array, int32_t n) {
    array.resize(static_cast<size_t>(n));
  }

 private:
  int next() { return last_ = last_ % 100 + 1; }

  int last_ = 0;
};

template <typename Message>
Message sample() {
  Message message{};
  SampleVisitor visitor;
  WireShape<Message>::visit(message, visitor);
  return message;
}

/// Offsets of every length in an encoded message: of strings and of arrays.
class LengthVisitor {
 public:
  template <typename Number>
  void value(const Number&) {
    offset_ += sizeof(Number);
  }
  void value(const std::string& text) {
    at_.push_back(offset_);
    offset_ += 4 + text.size() + 1;
  }
  void count(const int32_t&) {
    at_.push_back(offset_);
    offset_ += 4;
  }
  template <typename Array>
  void resize(const Array&, int32_t) {}

  const std::vector<size_t>& offsets() const { return at_; }

 private:
  size_t offset_ = 8;  // behind the hash
  std::vector<size_t> at_;
};

template <typename Message>
std::vector<size_t> lengthOffsets(const Message& message) {
  LengthVisitor visitor;
  WireShape<Message>::visit(message, visitor);
  return visitor.offsets();
}

}  // namespace redbee::test
