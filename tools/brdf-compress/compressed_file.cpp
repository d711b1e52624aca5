// SPDX-License-Identifier: Apache-2.0
#include "compressed_file.h"

#include "exit_codes.h"

#include <algorithm>
#include <utility>

namespace brdf::cli {
namespace {

template <class Call>
auto naming(const std::string& path, Call call) {
  try {
    return call();
  } catch (const Error& e) {
    throw Error(e.code(), path + ": " + e.what());
  }
}

}  // namespace

std::vector<std::uint64_t> refinement_ends(std::span<const std::byte> bytes, const std::string& path) {
  return naming(path, [&] { return refinement_boundaries(bytes); });
}

std::vector<std::byte> cut_to_prefix(std::vector<std::byte> bytes, std::optional<std::uint64_t> prefix,
                                     const std::string& path) {
  if (!prefix || *prefix >= bytes.size()) return bytes;
  const std::vector<std::uint64_t> ends = refinement_ends(bytes, path);
  if (std::find(ends.begin(), ends.end(), *prefix) == ends.end()) {
    std::string allowed;
    for (const std::uint64_t end : ends) allowed += (allowed.empty() ? "" : ", ") + std::to_string(end);
    throw Failure(ExitCode::usage,
                  "--prefix is " + std::to_string(*prefix) + ", but refinements of " + path + " end at " + allowed);
  }
  bytes.resize(static_cast<std::size_t>(*prefix));
  return bytes;
}

Material decode_file(std::span<const std::byte> bytes, EvalLevel level, bool allow_prefix, const std::string& path,
                     bool sampling) {
  DecodeOptions options;
  options.sampling = sampling;
  options.level = level;
  options.allow_prefix = allow_prefix;
  return naming(path, [&] { return Material::decode(bytes, options); });
}

}  // namespace brdf::cli
