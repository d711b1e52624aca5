// SPDX-License-Identifier: Apache-2.0
#include "config/tokens.h"

#include <brdf/error.h>

#include "base/file_io.h"

#include <openssl/crypto.h>
#include <sys/stat.h>

#include <array>
#include <string>

namespace brdf::service {
namespace {

constexpr std::array role_names{"read", "compress", "admin"};
constexpr std::size_t shortest_token = 16;

std::optional<Role> parse_role(std::string_view text) noexcept {
  for (std::size_t i = 0; i < role_names.size(); ++i)
    if (text == role_names[i]) return static_cast<Role>(i);
  return std::nullopt;
}

std::optional<Sha256> parse_digest(std::string_view hex) noexcept {
  Sha256 digest;
  if (hex.size() != 2 * digest.size()) return std::nullopt;
  const auto value = [](char c) { return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1; };
  for (std::size_t i = 0; i < digest.size(); ++i) {
    const int high = value(hex[2 * i]), low = value(hex[2 * i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    digest[i] = static_cast<std::byte>(high * 16 + low);
  }
  return digest;
}

}  // namespace

const char* to_string(Role role) noexcept { return role_names[static_cast<std::size_t>(role)]; }

Tokens Tokens::parse(std::string_view text, const std::string& name) {
  constexpr std::string_view blanks = " \t\r", digest_mark = "sha256:";
  Tokens tokens;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    line = line.substr(0, line.find_last_not_of(blanks) + 1);
    if (line.empty() || line.front() == '#') continue;
    const auto refuse = [&](const std::string& why) {
      return Error(ErrorCode::invalid_argument, name + ":" + std::to_string(number) + ": " + why);
    };
    const std::size_t gap = line.find_first_of(blanks);
    if (gap == std::string_view::npos) throw refuse("wanted is 'ROLE TOKEN'");
    const auto role = parse_role(line.substr(0, gap));
    if (!role) throw refuse("the role must be read, compress or admin");
    std::string_view token = line.substr(line.find_first_not_of(blanks, gap));
    if (token.find_first_of(blanks) != std::string_view::npos) throw refuse("a token has no blanks");
    if (token.starts_with(digest_mark)) {
      const auto digest = parse_digest(token.substr(digest_mark.size()));
      if (!digest) throw refuse("sha256: wants 64 lower-case hexadecimal digits");
      tokens.entries_.push_back({*role, *digest});
    } else {
      if (token.size() < shortest_token) throw refuse("a token has at least " + std::to_string(shortest_token) + " characters");
      tokens.entries_.push_back({*role, sha256(std::as_bytes(std::span(token)))});
    }
  }
  return tokens;
}

Tokens Tokens::read(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0 && (status.st_mode & (S_IROTH | S_IWOTH)) != 0) {
    throw Error(ErrorCode::invalid_argument, file.string() + ": everybody may read or write it; chmod o-rw it");
  }
  const std::vector<std::byte> bytes = base::read_file(file, std::uint64_t{1} << 20);
  return parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

std::optional<Role> Tokens::role_of(std::string_view token) const {
  const Sha256 digest = sha256(std::as_bytes(std::span(token)));
  int best = -1;
  for (const Entry& e : entries_) {
    const bool same = CRYPTO_memcmp(e.digest.data(), digest.data(), digest.size()) == 0;
    best = std::max(best, same ? static_cast<int>(e.role) : -1);
  }
  if (best < 0) return std::nullopt;
  return static_cast<Role>(best);
}

}  // namespace brdf::service
