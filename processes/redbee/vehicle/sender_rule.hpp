// The rule of nftables that keeps the host's other users from sending to the stack (SECURITY.md).
#pragma once

#include <optional>
#include <string>

namespace redbee {

/// Of an LCM URL udpm://GROUP:PORT; std::nullopt of another.
std::optional<int> portOf(const std::string& url);

/// The user whom alone the rules allow to send to this UDP port, name or number; std::nullopt where every
/// user may. `ruleset`: what `nft -j list ruleset` prints. The rule has to be on an output hook and say
/// nothing but `udp dport PORT meta skuid != USER drop`.
std::optional<std::string> onlySender(const std::string& ruleset, int port);

/// The host's rules now, which root alone can read; empty for others, and without nftables.
std::string readRuleset();

}  // namespace redbee
