// SPDX-License-Identifier: Apache-2.0
// What every row of the load test starts from: the programs, a folder, materials, a daemon.
#pragma once

#include "server/load/process.h"
#include "server/load/report.h"
#include "support/temporary_folder.h"

#include "brdf/v1/brdf_service.grpc.pb.h"

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace brdf::load {

namespace fs = std::filesystem;

struct Programs {
  std::string daemon, compress, gonio, self;
};

/// A daemon over a folder of its own.
struct Served {
  fs::path folder;
  std::string address;        ///< unix socket
  std::string admin_address;  ///< unix socket
  std::string tcp_address;    ///< empty unless asked for
  Process process;

  fs::path file_of(const std::string& id) const { return folder / "materials" / (id + ".brdfc"); }
};

class Setup {
 public:
  Setup(Programs programs, bool long_form) : is_long(long_form), programs_(std::move(programs)) {}

  const bool is_long;         ///< the whole figure rather than what a regular run has time for
  bool is_sanitized = false;  ///< the daemon was built with sanitizers
  double soak_seconds = 0;    ///< 0: what the form has

  const Programs& programs() const noexcept { return programs_; }
  fs::path log() const { return folder_ / "log"; }
  std::string end_of_log() const;
  /// A new folder below the one that goes at the end.
  fs::path new_folder(const std::string& name);

  /// A measured table of the simulated instrument.
  const fs::path& measured();
  /// It, compressed: the default preset where `is_long`, the fastest otherwise; or to a size.
  const std::vector<std::byte>& default_material();
  std::vector<std::byte> compressed_to(std::uint64_t bytes);

  /// Starts a daemon over a folder with these files.
  Served serve(const std::map<std::string, std::vector<std::byte>>& materials, std::vector<std::string> flags = {}, bool tcp = false);
  /// Starts a daemon over the folder of one that ended.
  Process serve_again(const fs::path& folder, const std::vector<std::string>& flags);
  Process start_echo(const std::string& address);

 private:
  std::vector<std::byte> compress(const std::vector<std::string>& flags);

  Programs programs_;
  test::TemporaryFolder folder_;
  int folders_ = 0;
  fs::path measured_;
  std::vector<std::byte> default_;
};

std::vector<std::byte> read_bytes(const fs::path& path);
/// In place of the file, by rename.
void put_file(const fs::path& path, const std::vector<std::byte>& bytes);

/// A channel that shares no connection with another. `arguments` are integers of gRPC.
std::shared_ptr<grpc::Channel> new_channel(const std::string& address, const std::map<std::string, int>& arguments = {});

/// A context with a deadline, which every call has.
struct Context : grpc::ClientContext {
  explicit Context(std::chrono::milliseconds deadline = std::chrono::seconds(20)) { set_deadline(std::chrono::system_clock::now() + deadline); }
};

/// Unit vectors in three planes, some of them below the horizon; and a request that evaluates them.
std::string direction_planes(std::size_t count, unsigned seed);
v1::EvaluateRequest evaluate_request(const std::string& material, std::size_t count, unsigned seed = 1);

}  // namespace brdf::load
