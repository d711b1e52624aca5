// SPDX-License-Identifier: Apache-2.0
#include "query/field_error.h"
#include "rpc/answers.h"
#include "rpc/material_message.h"
#include "shared/material_name.h"

#include <algorithm>
#include <span>

namespace brdf::service {
namespace {

constexpr std::int32_t usual_page = 100, largest_page = 1000;
constexpr std::int32_t usual_neighbours = 10, most_neighbours = 100;

bool passes_filters(const v1::ListMaterialsRequest& r, const MaterialVersion& m) {
  if (!r.name_contains().empty() && m.id.find(r.name_contains()) == std::string::npos) return false;
  if (r.channel_model() != v1::CHANNEL_MODEL_UNSPECIFIED && r.channel_model() != message_of(m.info.channels.model)) return false;
  if (r.max_bytes() != 0 && m.bytes.size() > r.max_bytes()) return false;
  return r.min_fitness() == v1::FITNESS_UNSPECIFIED || fitness_of(m) >= r.min_fitness();
}

}  // namespace

void check_list(const v1::ListMaterialsRequest& request) {
  if (request.page_size() < 0) throw FieldError("page_size", "is " + std::to_string(request.page_size()) + ", wanted is at least 0");
  if (!request.page_token().empty() && !is_material_id(request.page_token())) throw FieldError("page_token", "is none that this server gave");
}

bool list_page(const Catalogue& catalogue, const v1::ListMaterialsRequest& request, std::uint64_t max_bytes, v1::ListMaterialsResponse& response, const Stop& stop) {
  const std::int32_t page = request.page_size() == 0 ? usual_page : std::min(request.page_size(), largest_page);
  const auto& all = catalogue.materials();
  response.set_total(static_cast<std::uint32_t>(all.size()));
  const MaterialVersion* last = nullptr;
  std::uint64_t bytes = 0;
  for (std::size_t i = request.page_token().empty() ? 0 : catalogue.after(request.page_token()); i < all.size(); ++i) {
    if (i % stop_interval == 0 && stop()) return false;
    if (!passes_filters(request, *all[i])) continue;
    if (response.materials_size() == page || bytes > max_bytes) {
      response.set_next_page_token(last->id);
      break;
    }
    last = all[i].get();
    v1::Material& material = *response.add_materials();
    fill(material, *last);
    bytes += material.ByteSizeLong();
  }
  return true;
}

PlannedCall plan_list(Serving& serving, const v1::ListMaterialsRequest& request, v1::ListMaterialsResponse& response) {
  check_list(request);
  CatalogueHandle catalogue = serving.repository.catalogue();
  // Half a message: texts of strangers' files may be long, and a page that is no message would end the list for ever.
  const std::uint64_t max_bytes = serving.limits.max_message_bytes / 2;
  return {100 + catalogue->materials().size() / 8, [&request, &response, max_bytes, catalogue](const Call& call) {
            return list_page(*catalogue, request, max_bytes, response, [&call] { return call.is_over(); });
          }};
}

PlannedCall plan_get(Serving& serving, const v1::GetMaterialRequest& request, v1::GetMaterialResponse& response) {
  VersionHandle version = find_version(*serving.repository.catalogue(), "name", request.name());
  return {10, [&response, version = std::move(version)](const Call&) {
            fill(*response.mutable_material(), *version);
            return true;
          }, true};
}

PlannedCall plan_similar(Serving& serving, const v1::FindSimilarRequest& request, v1::FindSimilarResponse& response) {
  if (request.count() < 0 || request.count() > most_neighbours) throw FieldError("count", "is " + std::to_string(request.count()) + ", allowed is 0 to " + std::to_string(most_neighbours));
  const std::int32_t count = request.count() == 0 ? usual_neighbours : request.count();
  CatalogueHandle catalogue = serving.repository.catalogue();
  VersionHandle like;
  if (request.has_material()) {
    like = find_version(*catalogue, "material", request.material());
  } else if (!request.has_file()) {
    throw FieldError("like", "is missing: material or file must be set");
  }
  // An uploaded file is decoded first, about as much work as ten queries for every byte.
  const std::uint64_t cost = 1000 + std::min(10 * std::uint64_t{request.file().size()}, serving.workers.capacity() / 4);
  return {cost, [&serving, &request, &response, count, catalogue, like](const Call& call) {
            const Descriptor wanted = like ? like->descriptor : verify_version("upload", [&request] {
              const auto bytes = std::as_bytes(std::span(request.file()));
              return std::vector<std::byte>(bytes.begin(), bytes.end());
            }())->descriptor;
            if (call.is_over()) return false;
            const auto indexed = serving.similar.get(catalogue);
            for (const Neighbour& n : indexed->index.nearest(wanted, static_cast<std::size_t>(count) + 1)) {
              const MaterialVersion& m = *catalogue->materials()[n.index];
              if (&m == like.get() || response.materials_size() == count) continue;
              v1::SimilarMaterial* s = response.add_materials();
              s->set_version(version_name(m.id, m.version));
              s->set_distance(n.distance);
            }
            return true;
          }};
}

}  // namespace brdf::service
