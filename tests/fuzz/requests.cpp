// SPDX-License-Identifier: Apache-2.0
// Any bytes as the requests of the service, as they come from the wire: refused with a sentence, or answered with as many
// numbers as were asked for, all of them finite; lists go on to their end. The first byte chooses the request.
#include "compress/compress_job.h"
#include "query/batch.h"
#include "rpc/answers.h"
#include "rpc/download.h"
#include "rpc/material_message.h"
#include "shared/float_bytes.h"
#include "shared/material_name.h"
#include "support/golden_bytes.h"

#include <brdf/error.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace {

using namespace brdf;
using namespace brdf::service;

constexpr BatchLimits limits{4096, std::uint64_t{1} << 20};

void require(bool holds) {
  if (!holds) std::abort();
}

const VersionHandle& version() {
  static const VersionHandle v = verify_version("a", test::golden_files().front().bytes);
  return v;
}

void require_numbers(const std::string& bytes, std::size_t wanted) {
  require(bytes.size() == wanted * sizeof(float));
  std::vector<float> values(wanted);
  load_floats(bytes, 0, values);
  for (const float v : values) require(std::isfinite(v));
}

void evaluate(const std::string& wire) {
  v1::EvaluateRequest request;
  if (!request.ParseFromString(wire)) return;
  (void)parse_material_name(request.material());
  const BatchPlan plan = plan_batch(request, limits);
  const std::uint64_t bytes = version()->cut_at(request.prefix_bytes());
  require(bytes > 0 && bytes <= version()->bytes.size() && version()->refinements_in(bytes) >= 0);
  static const Material material = Material::decode(version()->bytes);
  answer_bytes(plan, request.count(), material.channels(), limits);
  v1::EvaluateResponse response;
  require(answer_batch(material, plan, request, response, [] { return false; }));
  const std::size_t n = request.count(), c = static_cast<std::size_t>(material.channels());
  require_numbers(response.values(), plan.evaluate ? c * n : 0);
  require_numbers(response.pdf(), plan.pdf ? n : 0);
  require_numbers(response.sample_wi(), plan.sample ? 3 * n : 0);
  require_numbers(response.sample_pdf(), plan.sample ? n : 0);
  require_numbers(response.sample_weight(), plan.sample ? c * n : 0);
}

void albedo(const std::string& wire) {
  v1::AlbedoRequest request;
  if (!request.ParseFromString(wire)) return;
  plan_albedo(request, {9216, limits.max_message_bytes});
}

void download(const std::string& wire) {
  v1::DownloadMaterialRequest request;
  if (!request.ParseFromString(wire)) return;
  if (const auto name = parse_material_name(request.name())) require(is_material_id(name->id) && name->id.find('/') == std::string::npos);
  const std::uint64_t end = download_end(*version(), request);
  require(end > 0 && end <= version()->bytes.size());
}

void compress(const std::string& wire) {
  v1::CompressRequest request;
  if (request.ParseFromString(wire)) check_compress_options(request.options());
}

const Catalogue& catalogue() {
  static const Catalogue c = [] {
    std::vector<VersionHandle> materials;
    for (const test::GoldenFile& f : test::golden_files()) materials.push_back(verify_version(f.name, f.bytes));
    return Catalogue(std::move(materials));
  }();
  return c;
}

void list(const std::string& wire) {
  v1::ListMaterialsRequest request;
  if (!request.ParseFromString(wire)) return;
  constexpr std::uint64_t max_bytes = 2000;
  std::string last = request.page_token();
  for (std::size_t pages = 0;; ++pages) {
    check_list(request);
    v1::ListMaterialsResponse page;
    require(list_page(catalogue(), request, max_bytes, page, [] { return false; }));
    require(page.total() == catalogue().materials().size() && pages <= catalogue().materials().size());
    for (const v1::Material& m : page.materials()) {
      const std::string id = parse_material_name(m.name()).value().id;
      require(id > last && id.find(request.name_contains()) != std::string::npos);
      last = id;
    }
    if (page.next_page_token().empty()) return;
    require(page.next_page_token() == last && page.materials_size() > 0);
    request.set_page_token(page.next_page_token());
  }
}

/// The uploaded file of a question for similar materials.
void similar(const std::string& wire) {
  v1::FindSimilarRequest request;
  if (!request.ParseFromString(wire) || !request.has_file()) return;
  const auto bytes = std::as_bytes(std::span(request.file()));
  const VersionHandle upload = verify_version("upload", {bytes.begin(), bytes.end()});
  for (const float d : upload->descriptor) require(std::isfinite(d));
  v1::Material message;
  fill(message, *upload);
  require(!message.SerializeAsString().empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string wire(reinterpret_cast<const char*>(data + 1), size - 1);
  try {
    switch (data[0] % 6) {
      case 0: evaluate(wire); break;
      case 1: albedo(wire); break;
      case 2: download(wire); break;
      case 3: compress(wire); break;
      case 4: list(wire); break;
      case 5: similar(wire); break;
    }
  } catch (const Error&) {
  }
  return 0;
}
