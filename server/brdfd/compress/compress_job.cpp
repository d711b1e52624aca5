// SPDX-License-Identifier: Apache-2.0
#include "compress/compress_job.h"

#include "base/file_io.h"
#include "query/batch.h"
#include "query/field_error.h"
#include "shared/excerpt.h"
#include "shared/material_name.h"

#include <brdf/error.h>
#include <brdf/limits.h>
#include <brdf/material.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace brdf::service {
namespace {

namespace fs = std::filesystem;
constexpr std::array metrics{"log_mae", "cbrt_rms", "psnr_env", "psnr_lights", "albedo_error"};

Error refuse(const std::string& sentence) { return {ErrorCode::invalid_argument, sentence}; }

std::string shortest(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) text.replace(at, what.size(), with);
}

/// "0.25 fitting lobes".
void hand_progress(const std::string& line, const std::function<void(const std::string&, double)>& progress) {
  double done = 0;
  const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), done);
  if (error != std::errc{} || !std::isfinite(done) || rest == line.data() + line.size()) return;
  progress(std::string(rest + 1, line.data() + line.size()), std::clamp(done, 0.0, 1.0));
}

}  // namespace

void check_compress_options(const v1::CompressOptions& o) {
  const auto name = parse_material_name(o.name());
  if (!name || !name->version.empty()) throw FieldError("options.name", "is " + excerpt(o.name()) + ", wanted is materials/{material}");
  if (o.has_effort() && (o.effort() < 0 || o.effort() > 100)) throw FieldError("options.effort", "is " + std::to_string(o.effort()) + ", allowed is 0 to 100");
  if (o.has_target_size() && o.target_size() == 0) throw FieldError("options.target_size", "is 0, allowed is at least 1");
  if (o.has_target_error()) {
    if (std::find(metrics.begin(), metrics.end(), o.target_error().metric()) == metrics.end()) throw FieldError("options.target_error.metric", "is " + excerpt(o.target_error().metric()) + ", which is no metric");
    if (!std::isfinite(o.target_error().value()) || o.target_error().value() < 0) throw FieldError("options.target_error.value", "must be a number of at least 0");
  }
  (void)level_of(o.level());
}

CompressJob::CompressJob(const CompressSetup& setup, const v1::CompressOptions& options) : setup_(setup), options_(options) {
  check_compress_options(options);
  std::string pattern = (setup.folder / "brdfd-compress-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw base::io_error(setup.folder, "make a folder in", errno);
  folder_ = pattern;
  upload_ = base::FileDescriptor(::open((folder_ / "upload").c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!upload_) {
    const int error = errno;
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw base::io_error("the upload", "store", error);
  }
}

CompressJob::~CompressJob() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void CompressJob::add(std::string_view chunk) {
  bytes_ += chunk.size();
  if (bytes_ > setup_.upload_bytes) throw Error(ErrorCode::limit_exceeded, "the upload has more than " + std::to_string(setup_.upload_bytes) + " bytes, the limit of this server");
  while (!chunk.empty()) {
    const ::ssize_t n = ::write(upload_.get(), chunk.data(), chunk.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw base::io_error("the upload", "store", errno);
    chunk.remove_prefix(static_cast<std::size_t>(n));
  }
}

std::vector<std::string> CompressJob::arguments() const {
  std::vector<std::string> words{setup_.program.string(), "compress", (folder_ / "upload").string(), "-o", (folder_ / "result.brdfc").string(), "-q",
                                 "--progress-descriptor", "3", "--threads", std::to_string(setup_.threads), "--eval", to_string(level_of(options_.level()))};
  const auto add = [&words](const std::string& flag, const std::string& value) { words.insert(words.end(), {flag, value}); };
  if (options_.has_effort()) add("--effort", std::to_string(options_.effort()));
  if (options_.has_target_size()) add("--target-size", std::to_string(options_.target_size()));
  if (options_.has_target_error()) add("--target-error", options_.target_error().metric() + "=" + shortest(options_.target_error().value()));
  if (options_.position_centre()) add("--position", "centre");
  return words;
}

void CompressJob::fail(const ChildResult& result) const {
  std::string sentence = result.errors.substr(0, result.errors.find('\n'));
  replace_all(sentence, "brdf-compress: ", "");
  replace_all(sentence, (folder_ / "upload").string(), "the upload");
  replace_all(sentence, folder_.string(), "the server's folder");
  switch (result.end) {
    case ChildResult::End::stopped: throw Error(ErrorCode::cancelled, "the compression was cancelled");
    case ChildResult::End::timed_out:
      throw Error(ErrorCode::limit_exceeded, "the compression took longer than " + std::to_string(setup_.limits.time.count() / 1000) + " s, the limit of this server");
    case ChildResult::End::signalled:
      throw Error(ErrorCode::limit_exceeded, "the compression was ended by signal " + std::to_string(result.code) + (sentence.empty() ? "" : ": " + sentence));
    case ChildResult::End::exited: break;
  }
  switch (result.code) {  // of tools/program/exit_codes.h
    case 2: throw refuse(sentence);
    case 3: throw Error(ErrorCode::malformed, sentence);
    case 4: throw Error(ErrorCode::target_not_met, sentence);
    default:
      if (sentence == "out of memory") throw Error(ErrorCode::limit_exceeded, "the compression needs more memory than this server allows");
      throw Error(ErrorCode::io, sentence.empty() ? "the compression ended with exit code " + std::to_string(result.code) : sentence);
  }
}

std::vector<std::byte> CompressJob::run(const std::function<void(const std::string&, double)>& progress, const std::function<bool()>& stop) {
  if (bytes_ == 0) throw refuse("the upload is empty");
  if (!upload_.close()) throw base::io_error("the upload", "store", errno);
  const ChildResult result = run_child(arguments(), setup_.limits, [&progress](const std::string& line) { hand_progress(line, progress); }, stop);
  if (result.end != ChildResult::End::exited || result.code != 0) fail(result);
  return base::read_file(folder_ / "result.brdfc", DecodeLimits{}.max_file_bytes);
}

fs::path find_compress_program() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  std::vector<fs::path> folders;
  if (!error) folders.push_back(self.parent_path());
  if (const char* path = std::getenv("PATH")) {
    for (std::string_view rest = path; !rest.empty();) {
      const std::size_t colon = rest.find(':');
      folders.emplace_back(rest.substr(0, colon));
      rest = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
    }
  }
  for (const fs::path& folder : folders) {
    fs::path program = folder / "brdf-compress";
    if (::access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

}  // namespace brdf::service
