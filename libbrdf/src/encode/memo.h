// SPDX-License-Identifier: Apache-2.0
// Values that several threads ask for and that are made once, by the first.
#pragma once

#include <map>
#include <mutex>

namespace brdf::encode {

template <class Key, class Value>
class Memo {
 public:
  /// The value of `key`, from `make()` when nobody asked before. References stay valid.
  template <class Make>
  const Value& get(const Key& key, Make&& make) {
    Entry* entry = nullptr;
    {
      const std::lock_guard lock(mutex_);
      entry = &entries_[key];
    }
    std::call_once(entry->made, [&] { entry->value = make(); });
    return entry->value;
  }

 private:
  struct Entry {
    std::once_flag made;
    Value value;
  };
  std::mutex mutex_;
  std::map<Key, Entry> entries_;
};

}  // namespace brdf::encode
