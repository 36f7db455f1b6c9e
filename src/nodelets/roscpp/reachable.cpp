#include "nodelets/roscpp/reachable.h"

#include <netdb.h>
#include <poll.h>
#include <ros/network.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <memory>

namespace grasp_affordances
{
namespace
{

constexpr int kPatience = 500;  // ms; within a robot's network an answer takes a few

/// Whether a connection to an address can be made.
bool accepts(const addrinfo& address)
{
  const int connection = socket(address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (connection < 0) {
    return false;
  }
  connect(connection, address.ai_addr, address.ai_addrlen);  // how it went is told by the following
  pollfd event{connection, POLLOUT, 0};
  int error = 0;
  socklen_t size = sizeof(error);
  const bool accepted = poll(&event, 1, kPatience) == 1 &&
                        getsockopt(connection, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0 &&
                        (event.revents & POLLHUP) == 0;
  close(connection);
  return accepted;
}

}  // namespace

bool isReachableAt(const std::string& uri)
{
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) {
    return false;
  }
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) {
    return false;
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> addresses(found, freeaddrinfo);
  return accepts(*addresses);
}

}  // namespace grasp_affordances
