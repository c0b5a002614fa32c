// Whether the stack has a network of its own, or one that every user of the host can send to.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

#include "processes/redbee/vehicle/finding.hpp"

namespace redbee {

enum class NetworkOwner {
  kStack,    ///< a network namespace of its own
  kHost,     ///< open to every user of the host
  kUnknown,  ///< only root can tell
};

struct StackNetwork {
  std::optional<pid_t> supervisor;  ///< std::nullopt: the stack is not up
  bool is_ours = true;              ///< this process is in the same network
  NetworkOwner owner = NetworkOwner::kUnknown;
  std::optional<std::string> only_sender{};  ///< see sender_rule.hpp
};

/// Of the stack whose supervisor wrote `pid_file`; of this process where there is none.
StackNetwork stackNetwork(const std::filesystem::path& pid_file);
/// Where scripts/fly or the systemd unit keeps it: REDBEE_RUN, /run/redbee, the user's runtime folder,
/// out/redbee.
std::filesystem::path supervisorPidFile();

/// Moves this process into the network of that one. Returns false without the right to.
bool enterNetworkOf(pid_t pid);

/// What it means for the user. `is_inside`: this process is in the network that was examined, or has entered
/// it.
Finding findNetwork(const StackNetwork& network, bool is_inside);

}  // namespace redbee
