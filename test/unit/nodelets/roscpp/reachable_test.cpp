#include "nodelets/roscpp/reachable.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace grasp_affordances
{
namespace
{

/// A port of this machine, on which somebody may listen.
class Port
{
public:
  Port() : socket_(socket(AF_INET, SOCK_STREAM, 0))
  {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address_);
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address_), size), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address_), &size), 0);
  }
  ~Port() { close(socket_); }

  void listen() const { EXPECT_EQ(::listen(socket_, 1), 0); }
  std::string uri() const { return "http://127.0.0.1:" + std::to_string(ntohs(address_.sin_port)) + "/"; }

private:
  int socket_;
  sockaddr_in address_{};
};

TEST(IsReachableAt, AsLongAsSomebodyListens)
{
  const Port port;
  EXPECT_FALSE(isReachableAt(port.uri()));
  port.listen();
  EXPECT_TRUE(isReachableAt(port.uri()));
}

TEST(IsReachableAt, NotUnderANameThatNobodyKnows)
{
  EXPECT_FALSE(isReachableAt("http://no-such-host.invalid:11311/"));
  EXPECT_FALSE(isReachableAt("no URI"));
}

}  // namespace
}  // namespace grasp_affordances
