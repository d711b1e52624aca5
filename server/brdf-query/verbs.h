// SPDX-License-Identifier: Apache-2.0
// One function a verb: adds itself to the program and says what runs it.
#pragma once

#include "verb.h"

namespace brdf::query {

struct Connection;
using cli::Verb;

Verb add_list(CLI::App& program, const Connection& connection);
Verb add_info(CLI::App& program, const Connection& connection);
Verb add_fetch(CLI::App& program, const Connection& connection);
Verb add_eval(CLI::App& program, const Connection& connection);
Verb add_pdf(CLI::App& program, const Connection& connection);
Verb add_sample(CLI::App& program, const Connection& connection);
Verb add_similar(CLI::App& program, const Connection& connection);
Verb add_compress(CLI::App& program, const Connection& connection);
Verb add_health(CLI::App& program, const Connection& connection);

}  // namespace brdf::query
