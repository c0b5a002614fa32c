// What supervisor says about its processes (XML-RPC over its Unix socket).
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace redbee {

struct SupervisedProcess {
  std::string name;
  pid_t pid = 0;
  bool is_up = false;  ///< starting or running; false while supervisor itself stops it
};

class SupervisorClient {
 public:
  explicit SupervisorClient(std::filesystem::path socket) : socket_(std::move(socket)) {}
  /// The supervisor that started this process. Throws UserError if none did.
  static SupervisorClient ofParent();

  /// All processes that have a process number; std::nullopt if supervisor does not answer within 0.3 s. Being
  /// asked also wakes supervisor 4.2, which otherwise looks after its children once a second
  /// (supervisord.py, runforever).
  std::optional<std::vector<SupervisedProcess>> processes() const;

  /// Has it "start", "stop" or "restart" a process of its configuration. Returns once it has been accepted,
  /// and the fault in words; empty: there is none.
  std::string act(const std::string& action, const std::string& process) const;

 private:
  /// The response to a method; empty where there is none.
  std::string call(const std::string& method, const std::string& parameters) const;
  std::string actOnce(const std::string& method, const std::string& process) const;

  std::filesystem::path socket_;
};

/// From the response of supervisor.getAllProcessInfo; std::nullopt if it is incomplete or a fault.
std::optional<std::vector<SupervisedProcess>> parseProcessInfo(const std::string& response);

}  // namespace redbee
