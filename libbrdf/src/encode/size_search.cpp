// SPDX-License-Identifier: Apache-2.0
#include "encode/size_search.h"

#include "fit/parallel_jobs.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace brdf::encode {
namespace {

constexpr std::uint64_t least_residual = 18;  // bytes: directory, checksum, errors, basis, an empty layer
constexpr double as_good = 0.002;  // dB of merit: less than what the queries resolve

constexpr double much_smaller = 0.8;           // of the bytes: from here on a file that is as good is worth having
constexpr std::size_t most_measured = 4;       // files of the chosen recipe

/// `e` with the balanced table that was chosen for `chosen`.
Encoded with_basis_of(const Encoded& chosen, Encoded e) {
  e.content.residual.basis = chosen.content.residual.basis;
  e.bytes = container::pack(e.content);
  return e;
}

/// Bases of one kind share their error model, and are told apart by it; kinds, and tables, by measurement.
struct Group {
  std::size_t first, last;
};

std::vector<Group> groups(const std::vector<Recipe>& recipes) {
  std::vector<Group> out;
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    const bool joins = i > 0 && !recipes[i].slices && recipes[i].azimuth == recipes[i - 1].azimuth;
    if (joins)
      out.back().last = i + 1;
    else
      out.push_back({i, i + 1});
  }
  return out;
}

}  // namespace

Found encode_to_size(const SourceData& source, const Search& search, std::uint64_t bytes, const std::function<void(double share)>& done) {
  Found found;
  found.file = lobes_only(source.frame);
  found.report = search.verification.score(found.file.bytes, search.level);
  found.merit = merit(found.report);
  if (search.level == EvalLevel::fast) return found;  // which reads nothing else

  if (bytes < found.file.bytes.size() + least_residual) return found;

  const std::vector<Recipe> ways = recipes(source, search.bases, search.azimuths, bytes);
  std::vector<std::vector<Encoded>> tried(ways.size());
  std::mutex mutex;
  std::size_t ended = 0;
  fit::run_jobs(ways.size(), search.threads, [&](std::size_t i, bool) {
    if (const std::optional<Candidate> candidate = make_candidate(source, ways[i])) {
      tried[i] = candidate->encode_to_size(bytes);
      std::erase_if(tried[i], [](const Encoded& e) { return e.content.residual.empty(); });
    }
    const std::lock_guard lock(mutex);
    done(static_cast<double>(++ended) / static_cast<double>(ways.size()));
  });

  std::vector<Encoded>* smaller = nullptr;
  for (const Group& group : groups(ways)) {
    std::size_t best = group.last;
    for (std::size_t i = group.first; i < group.last; ++i)
      if (!tried[i].empty() && (best == group.last || tried[i].front().error < tried[best].front().error)) best = i;
    if (best == group.last) continue;
    // rivals are the files that use the bytes up, as promised; when there is none, what comes nearest to it
    std::vector<Encoded>& files = tried[best];
    const auto rivals = std::stable_partition(files.begin(), files.end(), [&](const Encoded& e) { return e.bytes.size() >= least_size(bytes); });
    const std::size_t measured = std::clamp<std::size_t>(static_cast<std::size_t>(rivals - files.begin()), 1, most_measured);
    Encoded e = files.front();
    ErrorReport report = ways[best].slices ? choose_table(e, source.effort.table_variants, search.level, search.verification)
                                           : search.verification.score(e.bytes, search.level);
    for (std::size_t i = 1; i < measured; ++i) {
      Encoded other = with_basis_of(e, files[i]);
      const ErrorReport r = search.verification.score(other.bytes, search.level);
      if (merit(r) <= merit(report)) continue;
      report = r;
      e = std::move(other);
    }
    const double worth = merit(report);
    double& of_azimuth = found.of_azimuth[static_cast<std::size_t>(ways[best].azimuth)];
    of_azimuth = std::max(of_azimuth, worth);
    if (worth <= found.merit + as_good) continue;
    found.merit = worth;
    found.report = report;
    found.file = std::move(e);
    smaller = &tried[best];
  }
  if (smaller == nullptr) return found;

  // past the point where the table or the lobes' reach limits the error, bytes buy nothing
  std::stable_sort(smaller->begin(), smaller->end(), [](const Encoded& a, const Encoded& b) { return a.bytes.size() > b.bytes.size(); });
  for (const Encoded& candidate : *smaller) {
    if (static_cast<double>(candidate.bytes.size()) > much_smaller * static_cast<double>(found.file.bytes.size())) continue;
    Encoded e = with_basis_of(found.file, candidate);
    const ErrorReport report = search.verification.score(e.bytes, search.level);
    if (merit(report) < found.merit - as_good) break;
    found.merit = std::max(found.merit, merit(report));
    found.report = report;
    found.file = std::move(e);
  }
  return found;
}

}  // namespace brdf::encode
