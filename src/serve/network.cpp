#include "serve/network.h"

#include <algorithm>
#include <cstring>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/resource.h>
#include <unistd.h>

#include "serve/text.h"

namespace mimicry::serve {

std::vector<std::string> machine_addresses() {
  std::vector<std::string> found;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return found;
  for (const ifaddrs* i = list; i; i = i->ifa_next) {
    if (!i->ifa_addr || i->ifa_addr->sa_family != AF_INET) continue;
    if (!(i->ifa_flags & IFF_UP) || (i->ifa_flags & IFF_LOOPBACK)) continue;
    char text[INET_ADDRSTRLEN] = "";
    sockaddr_in address{};
    std::memcpy(&address, i->ifa_addr, sizeof address);
    if (inet_ntop(AF_INET, &address.sin_addr, text, sizeof text)) found.emplace_back(text);
  }
  freeifaddrs(list);
  return found;
}

std::vector<std::string> machine_names() {
  char text[256] = "";
  if (gethostname(text, sizeof text - 1) != 0) return {};
  const auto name = host_of(text);
  if (!name) return {};
  return {*name, *name + ".local"};
}

std::size_t allow_files(std::size_t wanted) {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return 1024;
  const auto most = std::min<rlim_t>(wanted, limit.rlim_max);
  if (limit.rlim_cur < most) {
    const rlimit raised{most, limit.rlim_max};
    if (setrlimit(RLIMIT_NOFILE, &raised) == 0) limit.rlim_cur = most;
  }
  return static_cast<std::size_t>(limit.rlim_cur);
}

}  // namespace mimicry::serve
