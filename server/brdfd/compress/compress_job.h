// SPDX-License-Identifier: Apache-2.0
// One compression: an uploaded file in a folder of its own, brdf-compress in a child process, bytes back.
#pragma once

#include "base/file_descriptor.h"
#include "brdf/v1/brdf_service.pb.h"
#include "compress/child_process.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace brdf::service {

struct CompressSetup {
  std::filesystem::path program, folder;
  std::uint64_t upload_bytes = 0, threads = 1;
  ChildLimits limits;
};

/// Reads a whole number of the options. Throws Error(invalid_argument).
void check_compress_options(const v1::CompressOptions& options);

/// Not thread-safe. The folder goes with the object.
class CompressJob {
 public:
  /// Throws Error: invalid_argument, io.
  CompressJob(const CompressSetup& setup, const v1::CompressOptions& options);
  ~CompressJob();
  CompressJob(const CompressJob&) = delete;
  CompressJob& operator=(const CompressJob&) = delete;

  /// Adds to the upload. Throws Error: limit_exceeded, io.
  void add(std::string_view chunk);

  /// Compresses what was uploaded. Throws Error as brdf-compress ended; limit_exceeded where a limit ended it, cancelled
  /// where `stop` did.
  std::vector<std::byte> run(const std::function<void(const std::string& stage, double done)>& progress, const std::function<bool()>& stop);

 private:
  std::vector<std::string> arguments() const;
  [[noreturn]] void fail(const ChildResult& result) const;

  const CompressSetup& setup_;
  const v1::CompressOptions options_;
  std::filesystem::path folder_;
  base::FileDescriptor upload_;
  std::uint64_t bytes_ = 0;
};

/// brdf-compress beside this program, or in PATH; empty where there is none.
std::filesystem::path find_compress_program();

}  // namespace brdf::service
