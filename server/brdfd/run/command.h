// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brdf::service {

/// `brdfd`, from its arguments to its exit code: 0 ok, 1 failed, 2 usage or settings.
int run_command(int argc, char** argv);

}  // namespace brdf::service
