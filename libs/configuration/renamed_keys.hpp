// Keys of earlier releases; internal to the configuration.
#pragma once

#include <optional>
#include <string>

namespace redbee::configuration {

/// The current name of a key of an earlier release; std::nullopt if no key had this name.
std::optional<std::string> renamedKey(const std::string& old_key);
/// Error message for a key that does not exist: its new name, or that it is unknown.
std::string unknownKey(const std::string& key);
/// True if any renamed key begins with `name` and a dot.
bool isRenamedSection(const std::string& name);

}  // namespace redbee::configuration
