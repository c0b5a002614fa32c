#include "processes/link/signing_key.hpp"

#include <chrono>
#include <fstream>
#include <iterator>
#include <string>

#include "redbee/files/input_file.hpp"

namespace redbee {

std::optional<mavlink::SigningKey> readSigningKey(const std::filesystem::path& file) {
  if (file.empty()) return std::nullopt;
  requireSecret(file, "key");
  std::ifstream in(file);
  if (!in) throw InputError(file, "cannot be read");
  constexpr size_t kLongest = 256;
  std::string text(kLongest, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(in.gcount()));
  const auto key = mavlink::signingKeyOf(text);
  if (!key) throw InputError(file, "is no key of 64 hexadecimal digits; openssl rand -hex 32 makes one");
  return key;
}

mavlink::SigningTime signingTimeOfDay() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return mavlink::signingTimeOf(std::chrono::duration_cast<std::chrono::microseconds>(since).count());
}

}  // namespace redbee
