// Keys that had another name; internal to the configuration.
#pragma once

#include <optional>
#include <string>

namespace redbee::configuration {

/// What a key of an earlier release is called now; nothing for a key that never had this name.
std::optional<std::string> renamedKey(const std::string& old_key);
/// What is wrong with a key that does not exist: its new name, or that it is unknown.
std::string unknownKey(const std::string& key);
/// True where renamed keys begin with `name` and a dot.
bool isRenamedSection(const std::string& name);

}  // namespace redbee::configuration
