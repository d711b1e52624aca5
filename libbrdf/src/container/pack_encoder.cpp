// SPDX-License-Identifier: Apache-2.0
#include "base/byte_reader.h"
#include "container/analytic_codes.h"
#include "container/chunk_types.h"
#include "container/content.h"
#include "container/error_codes.h"
#include "container/header.h"
#include "container/lobe_codes.h"
#include "container/residual_chunk.h"
#include "container/slice_frame_codes.h"
#include "container/validate_content.h"
#include "container/varint.h"
#include "residual/layer_codec.h"

#include <algorithm>

namespace brdf::container {
namespace {

void put_errors(std::vector<std::byte>& out, const Content& content, int refinement, std::initializer_list<EvalLevel> levels) {
  for (const EvalLevel level : levels) {
    const auto found = std::find_if(content.errors.begin(), content.errors.end(), [&](const RecordedError& e) {
      return e.refinement == refinement && e.level == level;
    });
    const bool known = found != content.errors.end();
    out.push_back(static_cast<std::byte>(known ? log_mae_code(found->log_mae) : std::uint8_t{255}));
    out.push_back(static_cast<std::byte>(known ? psnr_code(found->psnr_env) : std::uint8_t{0}));
  }
}

void append(std::vector<std::byte>& out, std::span<const std::byte> more) { out.insert(out.end(), more.begin(), more.end()); }

void put_text(std::vector<std::byte>& out, const std::string& text) {
  const std::size_t length = std::min<std::size_t>(text.size(), 4096);
  put_varint(out, length);
  append(out, std::as_bytes(std::span(text.data(), length)));
}

std::vector<std::byte> provenance_payload(const Content& content) {
  const Provenance& p = *content.provenance;
  std::vector<std::byte> out;
  for (const std::string* text : {&p.name, &p.format, &p.description, &p.licence, &content.fitter}) put_text(out, *text);
  std::byte raw[8];
  base::store_little_endian(p.content_hash, std::span<std::byte>(raw));
  append(out, raw);
  put_varint(out, p.file_bytes);
  return out;
}

}  // namespace

std::vector<std::byte> pack(const Content& content) {
  validate(content);
  std::vector<std::vector<std::byte>> payloads;
  std::vector<DirectoryEntry> directory;
  const auto add = [&](std::uint8_t code, std::vector<std::byte> payload) {
    directory.push_back({code, payload.size()});
    payloads.push_back(std::move(payload));
  };

  if (content.analytic) {
    add(static_cast<std::uint8_t>(ChunkType::analytic), write_analytic(*content.analytic));
  } else {
    std::vector<std::byte> lobes;
    put_errors(lobes, content, 0, {EvalLevel::fast});
    append(lobes, write_lobes(content.lobes));
    add(static_cast<std::uint8_t>(ChunkType::lobes), std::move(lobes));
  }

  const residual::ResidualCode& code = content.residual;
  if (!code.empty()) {
    std::uint32_t count = 0;
    for (const residual::Layer& layer : code.layers)
      for (const std::uint32_t e : layer.end) count = std::max(count, e);
    residual::LayerCodec codec(code.basis, residual::even_only(code.azimuth), code.channels, count, residual::reach_of(code.slices));
    const residual::Layer* before = nullptr;
    for (std::size_t i = 0; i < code.layers.size(); ++i) {
      std::vector<std::byte> payload;
      put_errors(payload, content, static_cast<int>(i) + 1, {EvalLevel::balanced, EvalLevel::exact});
      if (i == 0) {
        BitWriter basis;
        write_basis(basis, code.basis, count);
        append(payload, basis.bytes());
        if (!code.slices.empty()) append(payload, write_slice_frame(code.slices));
      }
      append(payload, residual::encode_layer(codec, before, code.layers[i]));
      add(static_cast<std::uint8_t>(i == 0 ? ChunkType::residual : ChunkType::refinement), std::move(payload));
      before = &code.layers[i];
    }
  }
  if (!content.sampling.empty()) add(static_cast<std::uint8_t>(ChunkType::sampling), content.sampling);
  if (content.provenance) add(static_cast<std::uint8_t>(ChunkType::provenance), provenance_payload(content));

  Component component = content.component;
  component.axes = code.empty() || code.slices.empty() ? AxesKind::half_difference : AxesKind::slices;
  std::vector<std::byte> out = write_header(component, directory);
  // the chain starts with the checksum of the header and goes on from chunk to chunk
  std::uint32_t checksum = base::load_little_endian<std::uint32_t>(std::span(out).last(checksum_bytes));
  for (const std::vector<std::byte>& payload : payloads) {
    append(out, payload);
    checksum = chain(payload, checksum);
    std::byte raw[checksum_bytes];
    base::store_little_endian(checksum, std::span<std::byte>(raw));
    append(out, raw);
  }
  return out;
}

}  // namespace brdf::container
