#include "redbee/bus/message_name.hpp"

#include <array>
#include <cstdio>

#include "redbee/bus/codec.hpp"
#include "redbee/message_types.hpp"

namespace redbee {
namespace {

template <typename... Messages>
std::string nameAmong(const std::vector<uint8_t>& data, TypeList<Messages...>) {
  std::string name;
  const auto look = [&](int64_t hash, const char* type) {
    if (startsWithHash(data.data(), static_cast<int>(data.size()), hash)) name = type;
  };
  (look(Messages::getHash(), Messages::getTypeName()), ...);
  return name;
}

}  // namespace

std::string messageName(const std::vector<uint8_t>& data) { return nameAmong(data, MessageTypes{}); }

std::string messageHash(const std::vector<uint8_t>& data) {
  if (data.size() < static_cast<size_t>(kHashBytes)) return "";
  uint64_t hash = 0;
  for (size_t i = 0; i < static_cast<size_t>(kHashBytes); ++i) hash = hash << 8 | data[i];
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "0x%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

}  // namespace redbee
