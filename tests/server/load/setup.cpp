// SPDX-License-Identifier: Apache-2.0
#include "server/load/setup.h"

#include "shared/float_bytes.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <stdexcept>

namespace brdf::load {

std::vector<std::byte> read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + " cannot be read");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::byte> bytes(text.size());
  if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

void put_file(const fs::path& path, const std::vector<std::byte>& bytes) {
  const fs::path fresh = path.string() + ".new";
  std::ofstream(fresh, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  fs::rename(fresh, path);
}

fs::path Setup::new_folder(const std::string& name) {
  const fs::path path = folder_ / (name + std::to_string(folders_++)).c_str();
  fs::create_directory(path);
  return path;
}

const fs::path& Setup::measured() {
  if (measured_.empty()) {
    const fs::path path = folder_ / "measured.binary";
    run_program({programs_.gonio, "sample", "-o", path.string()}, log());
    measured_ = path;
  }
  return measured_;
}

std::vector<std::byte> Setup::compress(const std::vector<std::string>& flags) {
  const fs::path path = folder_ / "compressed.brdfc";
  std::vector<std::string> words{programs_.compress, "compress", measured().string(), "-o", path.string(), "-q", "-f"};
  words.insert(words.end(), flags.begin(), flags.end());
  run_program(words, log());
  return read_bytes(path);
}

const std::vector<std::byte>& Setup::default_material() {
  if (default_.empty()) default_ = compress(is_long ? std::vector<std::string>{} : std::vector<std::string>{"--preset", "fastest"});
  return default_;
}

std::vector<std::byte> Setup::compressed_to(std::uint64_t bytes) { return compress({"--preset", "fastest", "--target-size", std::to_string(bytes)}); }

std::string Setup::end_of_log() const {
  constexpr std::size_t most = 16000;
  std::ifstream in(log(), std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return text.size() <= most ? text : text.substr(text.size() - most);
}

Served Setup::serve(const std::map<std::string, std::vector<std::byte>>& materials, std::vector<std::string> flags, bool tcp) {
  const fs::path folder = new_folder("served");
  fs::create_directory(folder / "materials");
  for (const auto& [id, bytes] : materials) put_file(folder / "materials" / (id + ".brdfc"), bytes);
  if (tcp) flags.insert(flags.end(), {"--listen", "127.0.0.1:0"});
  const std::string address = "unix:" + (folder / "socket").string(), admin = "unix:" + (folder / "admin").string();
  flags.insert(flags.begin(), {programs_.daemon, "--repository", (folder / "materials").string(), "--listen", address, "--admin-listen", admin, "--log-level", "warning",
                               "--compress-program", programs_.compress, "--compress-folder", folder.string()});
  Process process(flags, log());
  const std::string line = process.wait_for_line(" ready: ");
  std::string tcp_address;
  if (const std::size_t at = line.find("127.0.0.1:"); tcp && at != std::string::npos) tcp_address = line.substr(at, line.find(' ', at) - at);
  return {folder, address, admin, tcp_address, std::move(process)};
}

Process Setup::serve_again(const fs::path& folder, const std::vector<std::string>& flags) {
  std::vector<std::string> words{programs_.daemon, "--repository", (folder / "materials").string(), "--listen", "unix:" + (folder / "socket").string(),
                                 "--admin-listen", "unix:" + (folder / "admin").string(), "--log-level", "warning",
                                 "--compress-program", programs_.compress, "--compress-folder", folder.string()};
  words.insert(words.end(), flags.begin(), flags.end());
  Process process(words, log());
  process.wait_for_line(" ready: ");
  return process;
}

Process Setup::start_echo(const std::string& address) {
  Process process({programs_.self, "--echo", address}, log());
  process.wait_for_line("echo ready");
  return process;
}

std::shared_ptr<grpc::Channel> new_channel(const std::string& address, const std::map<std::string, int>& arguments) {
  grpc::ChannelArguments a;
  a.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  a.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  a.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 5'000);
  a.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 500);
  for (const auto& [name, value] : arguments) a.SetInt(name, value);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), a);
}

std::string direction_planes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> planes(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const float x = normal(random), y = normal(random), z = normal(random) + 1, length = std::sqrt(x * x + y * y + z * z);
    planes[i] = x / length;
    planes[count + i] = y / length;
    planes[2 * count + i] = z / length;
  }
  std::string bytes(planes.size() * sizeof(float), '\0');
  service::store_floats(planes, bytes, 0);
  return bytes;
}

v1::EvaluateRequest evaluate_request(const std::string& material, std::size_t count, unsigned seed) {
  v1::EvaluateRequest r;
  r.set_material(material);
  r.set_operations(v1::OPERATION_EVALUATE);
  r.set_count(static_cast<std::uint32_t>(count));
  r.set_wi(direction_planes(count, seed));
  r.set_wo(direction_planes(count, seed + 1000));
  return r;
}

}  // namespace brdf::load
