// SPDX-License-Identifier: Apache-2.0
#include "server/load/latency.h"
#include "server/load/rows.h"
#include "shared/content_hash.h"
#include "shared/float_bytes.h"
#include "shared/material_name.h"

#include "brdf/v1/admin_service.grpc.pb.h"

#include <brdf/encode.h>

#include <atomic>
#include <stdexcept>
#include <thread>

namespace brdf::load {
namespace {

constexpr std::size_t pairs = 512;
constexpr std::uint64_t table_budget = std::uint64_t{32} << 20;

struct Version {
  std::vector<std::byte> bytes;
  std::string name;    ///< materials/a/versions/...
  std::string values;  ///< what it answers to the request
};

/// The answer of the library itself; batches of the daemon are the same bits on the same instruction set.
std::string values_of(const std::vector<std::byte>& bytes, const v1::EvaluateRequest& request) {
  const Material material = Material::decode(bytes);
  std::vector<float> wi(3 * pairs), wo(3 * pairs), f(3 * pairs);
  service::load_floats(request.wi(), 0, wi);
  service::load_floats(request.wo(), 0, wo);
  const auto span = [](const std::vector<float>& v) { return DirectionSpan{v.data(), v.data() + pairs, v.data() + 2 * pairs, pairs}; };
  material.eval(span(wi), span(wo), {f.data(), pairs});
  std::string out(f.size() * sizeof(float), '\0');
  service::store_floats(f, out, 0);
  return out;
}

/// As many versions as there are swaps, each with values of its own; every fourth is a measured material of another size.
std::vector<Version> make_versions(Setup& setup, std::size_t count, const v1::EvaluateRequest& request) {
  std::vector<std::vector<std::byte>> measured;
  for (const std::uint64_t size : {200, 400, 600, 800, 1000, 1200}) measured.push_back(setup.compressed_to(size));
  std::vector<Version> versions(count);
  for (std::size_t i = 0; i < count; ++i) {
    Version& v = versions[i];
    const float albedo = 0.9F * static_cast<float>(i + 1) / static_cast<float>(count);
    v.bytes = i % 4 == 3 ? measured[i / 4 % measured.size()] : pack_analytic(Lambert{{albedo, albedo / 2, albedo / 3}});
    v.name = service::version_name("a", service::version_of(v.bytes));
    v.values = values_of(v.bytes, request);
  }
  return versions;
}

struct Watched {
  std::atomic<std::uint64_t> answers{0}, failed{0}, mixed{0}, unknown{0};
};

void call_and_check(const Served& served, const v1::EvaluateRequest& request, const std::map<std::string, const std::string*>& expected, const std::atomic<bool>& end, Watched& watched) {
  const auto stub = v1::BrdfService::NewStub(new_channel(served.address));
  while (!end) {
    Context context;
    v1::EvaluateResponse response;
    if (!stub->Evaluate(&context, request, &response).ok()) {
      ++watched.failed;
      continue;
    }
    ++watched.answers;
    const auto found = expected.find(response.version());
    if (found == expected.end()) ++watched.unknown;
    else if (*found->second != response.values()) ++watched.mixed;
  }
}

}  // namespace

std::vector<Row> measure_swaps(Setup& setup) {
  const std::size_t swaps = 1000;
  const v1::EvaluateRequest request = evaluate_request("materials/a", pairs);
  const std::vector<Version> versions = make_versions(setup, swaps + 1, request);
  std::map<std::string, const std::string*> expected;
  for (const Version& v : versions) expected[v.name] = &v.values;
  Served served = setup.serve({{"a", versions[0].bytes}}, {"--poll-interval-seconds", "3600", "--table-budget-bytes", std::to_string(table_budget)});
  const auto admin = v1::AdminService::NewStub(new_channel(served.admin_address));
  Watched watched;
  std::atomic<bool> end{false};
  std::vector<std::thread> callers;
  for (int i = 0; i < 3; ++i) callers.emplace_back([&] { call_and_check(served, request, expected, end, watched); });

  std::uint64_t not_swapped = 0;
  double early = 0;
  const auto start = Clock::now();
  for (std::size_t i = 1; i <= swaps; ++i) {
    put_file(served.file_of("a"), versions[i].bytes);
    Context context;
    v1::ReloadRepositoryResponse response;
    const grpc::Status status = admin->ReloadRepository(&context, {}, &response);
    if (!status.ok() || response.replaced() != 1) ++not_swapped;
    if (i == swaps / 4) early = static_cast<double>(served.process.resident_bytes());
  }
  const double took = seconds_since(start), late = static_cast<double>(served.process.resident_bytes());
  end = true;
  for (std::thread& t : callers) t.join();

  Row row;
  row.name = "1,000 hot swaps under load";
  row.asked = "0 errors, no answer mixes two versions, memory flat";
  row.reached = std::to_string(watched.failed + not_swapped + watched.unknown) + " errors and " + std::to_string(watched.mixed) + " mixed of " + std::to_string(watched.answers) + " answers; " +
                number(late / 1e6) + " MB after all, " + number(early / 1e6) + " MB after a quarter of them";
  row.ran = "3 callers of " + std::to_string(pairs) + " pairs; every answer compared bit by bit with its version's values; " + std::to_string(swaps) + " renames and ReloadRepository in " + duration(took);
  row.sound = watched.failed == 0 && watched.mixed == 0 && watched.unknown == 0 && not_swapped == 0 && watched.answers > swaps / 2;
  row.met = row.sound && late - early < 8e6;
  row.figures = {{"errors", static_cast<double>(watched.failed + not_swapped + watched.unknown)}, {"mixed", static_cast<double>(watched.mixed)}, {"answers", static_cast<double>(watched.answers)}, {"early_bytes", early}, {"late_bytes", late}, {"seconds", took}};
  return {row};
}

}  // namespace brdf::load
