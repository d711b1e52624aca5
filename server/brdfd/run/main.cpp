// SPDX-License-Identifier: Apache-2.0
// brdfd: the daemon that renderers ask.
#include "run/command.h"

int main(int argc, char** argv) { return brdf::service::run_command(argc, argv); }
