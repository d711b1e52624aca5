// SPDX-License-Identifier: Apache-2.0
#include "run/cut_connection.h"

#include "base/file_descriptor.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/evp.h>
#include <sys/socket.h>

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <thread>

namespace brdf::service {
namespace {

using base::FileDescriptor;
using namespace std::chrono_literals;

struct Peer {
  int family = AF_UNSPEC;
  std::string address;  ///< in base64, as channelz has it
  std::uint16_t port = 0;
  std::string name;
};

std::string base64(const void* bytes, int size) {
  std::array<unsigned char, 32> text;
  const int length = ::EVP_EncodeBlock(text.data(), static_cast<const unsigned char*>(bytes), size);
  return {reinterpret_cast<const char*>(text.data()), static_cast<std::size_t>(length)};
}

/// AF_UNSPEC for what is no connected socket.
Peer peer_of(int fd) {
  sockaddr_storage storage{};
  socklen_t size = sizeof(storage);
  Peer p;
  if (::getpeername(fd, reinterpret_cast<sockaddr*>(&storage), &size) != 0) return p;
  p.family = storage.ss_family;
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (p.family == AF_INET) {
    sockaddr_in address;
    std::memcpy(&address, &storage, sizeof(address));
    p.address = base64(&address.sin_addr, 4);
    p.port = ntohs(address.sin_port);
    p.name = ::inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
  } else if (p.family == AF_INET6) {
    sockaddr_in6 address;
    std::memcpy(&address, &storage, sizeof(address));
    const bool mapped = IN6_IS_ADDR_V4MAPPED(&address.sin6_addr);  // gRPC calls such a peer by its IPv4 address
    p.address = mapped ? base64(address.sin6_addr.s6_addr + 12, 4) : base64(&address.sin6_addr, 16);
    p.port = ntohs(address.sin6_port);
    p.name = ::inet_ntop(AF_INET6, &address.sin6_addr, text.data(), text.size());
  } else if (p.family == AF_UNIX) {
    p.name = "unix";
    ucred who{};
    socklen_t length = sizeof(who);
    if (::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &who, &length) == 0) p.name += ", process " + std::to_string(who.pid) + " of user " + std::to_string(who.uid);
  }
  if (p.port != 0) p.name += " port " + std::to_string(p.port);
  return p;
}

/// Every connected socket of this process, each as a descriptor of its own: gRPC may close its one, and the number be given to another,
/// at any moment.
template <class Wanted>
std::vector<FileDescriptor> sockets(const Wanted& wanted) {
  std::vector<FileDescriptor> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", ignored)) {
    const int fd = std::atoi(entry.path().filename().c_str());
    if (!wanted(peer_of(fd))) continue;
    FileDescriptor own(::fcntl(fd, F_DUPFD_CLOEXEC, 0));
    if (own && wanted(peer_of(own.get()))) found.push_back(std::move(own));
  }
  return found;
}

/// RST_STREAM frames (RFC 9113, section 6.4) among the bytes that wait to be read, which stay where they are.
std::size_t resets_waiting(int fd) {
  constexpr std::string_view head("\0\0\4\3\0", 5);
  std::array<char, 32768> bytes;
  const ssize_t size = ::recv(fd, bytes.data(), bytes.size(), MSG_PEEK | MSG_DONTWAIT);
  const std::string_view waiting(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  std::size_t count = 0;
  for (std::size_t at = waiting.find(head); at != std::string_view::npos; at = waiting.find(head, at + head.size())) ++count;
  return count;
}

/// The one whose peer resets the most streams at this moment; none where hardly anyone does.
const FileDescriptor* worst(const std::vector<FileDescriptor>& candidates) {
  constexpr std::size_t moments = 8, fewest = 16;
  std::vector<std::size_t> resets(candidates.size());
  for (std::size_t i = 0; i < moments; ++i) {
    for (std::size_t k = 0; k < candidates.size(); ++k) resets[k] += resets_waiting(candidates[k].get());
    std::this_thread::sleep_for(1ms);
  }
  const auto most = std::max_element(resets.begin(), resets.end());
  return most == resets.end() || *most < fewest ? nullptr : &candidates[static_cast<std::size_t>(most - resets.begin())];
}

}  // namespace

std::string cut_connection(const ConnectionFigures& connection) {
  const bool has_name = !connection.address.empty();
  const auto found = sockets([&](const Peer& p) { return has_name ? p.address == connection.address && p.port == connection.port : p.family == AF_UNIX; });
  const FileDescriptor* which = !has_name ? worst(found) : found.empty() ? nullptr : &found.front();
  if (which == nullptr) return {};
  std::string name = peer_of(which->get()).name;
  return ::shutdown(which->get(), SHUT_RDWR) == 0 ? name : std::string();
}

}  // namespace brdf::service
