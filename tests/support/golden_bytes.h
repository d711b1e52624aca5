// SPDX-License-Identifier: Apache-2.0
// The files of data/golden in memory.
#pragma once

#include "support/data_folders.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace brdf::test {

struct GoldenFile {
  std::string name;
  std::vector<std::byte> bytes;
};

/// All of them, in the order of their names.
inline const std::vector<GoldenFile>& golden_files() {
  static const std::vector<GoldenFile> files = [] {
    std::vector<GoldenFile> all;
    for (const auto& entry : std::filesystem::directory_iterator(source_folder() / "data" / "golden")) {
      if (entry.path().extension() != ".brdfc") continue;
      std::ifstream in(entry.path(), std::ios::binary);
      const std::vector<char> raw((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
      GoldenFile file{entry.path().stem().string(), {}};
      for (const char c : raw) file.bytes.push_back(static_cast<std::byte>(c));
      all.push_back(std::move(file));
    }
    std::sort(all.begin(), all.end(), [](const GoldenFile& a, const GoldenFile& b) { return a.name < b.name; });
    return all;
  }();
  return files;
}

}  // namespace brdf::test
