// SPDX-License-Identifier: Apache-2.0
// A reference and a candidate: what the verbs that measure one file against another have in common.
#pragma once

#include "material_source.h"
#include "verb_options.h"

#include <string>

namespace brdf::cli {

struct PairOptions {
  std::string reference, candidate;
  SourceOptions source;
  int threads = 0;
  Reporting reporting;
};

void add_pair(CLI::App& verb, PairOptions& o, const std::string& candidate_help);

struct ComparedPair {
  MaterialSource reference, candidate;
};

/// Opens both; it is the candidate that is cut at a prefix. Throws Failure(bad_input) when their channels differ in number.
ComparedPair open_pair(const PairOptions& o);

}  // namespace brdf::cli
