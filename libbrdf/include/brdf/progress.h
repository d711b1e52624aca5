// SPDX-License-Identifier: Apache-2.0
/// @file progress.h
/// How long work reports back. The library itself never prints.
#pragma once

#include <functional>
#include <string_view>

namespace brdf {

/// Called from the calling thread with the name of the stage and the share done, 0 to 1, of the whole work.
/// Return false to cancel: the running call throws Error(ErrorCode::cancelled).
using Progress = std::function<bool(std::string_view stage, double done)>;

}  // namespace brdf
