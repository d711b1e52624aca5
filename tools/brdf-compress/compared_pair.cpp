// SPDX-License-Identifier: Apache-2.0
#include "compared_pair.h"

#include "exit_codes.h"

namespace brdf::cli {

void add_pair(CLI::App& verb, PairOptions& o, const std::string& candidate_help) {
  verb.add_option("REF", o.reference, "The reference, a measured or .brdfc file")->required();
  verb.add_option("CAND", o.candidate, candidate_help)->required();
  add_eval_level(verb, o.source.level);
  add_prefix(verb, o.source.prefix);
  add_position(verb, o.source.position);
  add_threads(verb, o.threads);
  add_reporting(verb, o.reporting);
}

ComparedPair open_pair(const PairOptions& o) {
  SourceOptions whole = o.source;
  whole.prefix.reset();
  ComparedPair pair{MaterialSource::open(o.reference, whole), MaterialSource::open(o.candidate, o.source)};
  const int expected = pair.reference.channels().count, found = pair.candidate.channels().count;
  if (found != expected)
    throw Failure(ExitCode::bad_input, o.candidate + ": has " + std::to_string(found) + " channels, the reference has " + std::to_string(expected));
  return pair;
}

}  // namespace brdf::cli
