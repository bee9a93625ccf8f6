#pragma once

#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

namespace myotact::testing {

/// Two hosts on this machine, joined by a cable that can be pulled: network namespaces with a veth pair. The thread
/// that makes it is on the near host from then on, as are the threads that it starts. Needs root and iproute2.
class Cable {
 public:
  Cable() {
    works_ = ip("netns add " + near()) && ip("netns add " + far()) &&
             ip("link add cable0 netns " + near() + " type veth peer name cable1 netns " + far()) &&
             set_up(near(), "cable0", "1") && set_up(far(), "cable1", "2");
    before_ = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
    const int inside = open(("/var/run/netns/" + near()).c_str(), O_RDONLY | O_CLOEXEC);
    works_ = works_ && before_ >= 0 && inside >= 0 && setns(inside, CLONE_NEWNET) == 0;
    if (inside >= 0) close(inside);
  }
  ~Cable() {
    if (before_ >= 0) {
      setns(before_, CLONE_NEWNET);
      close(before_);
    }
    ip("netns del " + near());
    ip("netns del " + far());
  }
  Cable(const Cable&) = delete;
  Cable& operator=(const Cable&) = delete;

  bool works() const { return works_; }
  void pull() const { ip("-n " + far() + " link set cable1 down"); }
  void plug_in() const { ip("-n " + far() + " link set cable1 up"); }
  std::string far_host() const { return far(); }
  static std::string far_address() { return "10.77.0.2"; }

 private:
  static std::string near() { return "near" + std::to_string(getpid()); }
  static std::string far() { return "far" + std::to_string(getpid()); }
  static bool ip(const std::string& arguments) {
    return std::system(("ip " + arguments + " 2>/dev/null").c_str()) == 0;
  }
  static bool set_up(const std::string& host, const std::string& end, const std::string& number) {
    return ip("-n " + host + " addr add 10.77.0." + number + "/24 dev " + end) &&
           ip("-n " + host + " link set " + end + " up") && ip("-n " + host + " link set lo up");
  }

  bool works_ = false;
  int before_ = -1;
};

}  // namespace myotact::testing
