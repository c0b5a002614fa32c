// pidfd_open(2) and its like: a process that cannot be mistaken for a later one of its number.
#pragma once

#include <poll.h>
extern "C" {
#include <sys/pidfd.h>  // glibc 2.36 declares these without C linkage
}
#include <sys/types.h>

namespace redbee::pidfd {

/// -1 if there is no such process.
inline int open(pid_t pid) { return pidfd_open(pid, 0); }
inline bool send(int fd, int signal) { return pidfd_send_signal(fd, signal, nullptr, 0) == 0; }
inline bool hasEnded(int fd) {
  pollfd entry{fd, POLLIN, 0};
  return poll(&entry, 1, 0) > 0;
}

}  // namespace redbee::pidfd
