// SPDX-License-Identifier: Apache-2.0
#include "base/byte_reader.h"
#include "container/analytic_codes.h"
#include "container/chunk_types.h"
#include "container/content.h"
#include "container/density_codes.h"
#include "container/error_codes.h"
#include "container/header.h"
#include "container/lobe_codes.h"
#include "container/lobe_quantiser.h"
#include "container/packed_lobes.h"
#include "container/residual_chunk.h"
#include "container/slice_frame_codes.h"
#include "container/varint.h"
#include "lobes/lobe_kinds.h"
#include "residual/layer_codec.h"

#include <algorithm>
#include <optional>

namespace brdf::container {
namespace {

RecordedError read_error(std::span<const std::byte>& payload, int refinement, EvalLevel level) {
  if (payload.size() < 2) throw Error(ErrorCode::malformed, "chunk: ends within its recorded errors");
  const RecordedError e{refinement, level, log_mae_of(static_cast<std::uint8_t>(payload[0])),
                        psnr_of(static_cast<std::uint8_t>(payload[1]))};
  payload = payload.subspan(2);
  return e;
}

std::string read_text(base::ByteReader& in) {
  const std::uint64_t length = read_varint(in, "provenance: text length");
  const std::span<const std::byte> raw = in.take(length, "the provenance");
  return {reinterpret_cast<const char*>(raw.data()), raw.size()};
}

void read_provenance(std::span<const std::byte> payload, Content& content) {
  base::ByteReader in(payload, "provenance chunk");
  Provenance p;
  for (std::string* text : {&p.name, &p.format, &p.description, &p.licence, &content.fitter}) *text = read_text(in);
  p.content_hash = in.read<std::uint64_t>("the content hash");
  p.file_bytes = read_varint(in, "provenance: file size");
  content.provenance = std::move(p);
}

std::string kind_name(std::uint8_t code) {
  switch (static_cast<ChunkType>(code)) {
    case ChunkType::packed_lobes:
    case ChunkType::lobes: return "lobes";
    case ChunkType::analytic: return "analytic";
    case ChunkType::residual: return "residual";
    case ChunkType::refinement: return "refinement";
    case ChunkType::provenance: return "provenance";
    case ChunkType::sampling: return "sampling";
  }
  return "type " + std::to_string(code);
}

/// Reads chunks in file order; what was learnt from one layer goes on to the next.
class ChunkReader {
 public:
  ChunkReader(Unpacked& out, const DecodeLimits& limits) : out_(out), limits_(limits) {}

  void read(std::uint8_t code, std::span<const std::byte> payload) {
    switch (static_cast<ChunkType>(code)) {
      case ChunkType::packed_lobes: return lobes(payload, read_packed_lobes);
      case ChunkType::lobes: return lobes(payload, read_lobes);
      case ChunkType::analytic: return analytic(payload);
      case ChunkType::residual: return residual(payload);
      case ChunkType::refinement: return refinement(payload);
      case ChunkType::provenance: return read_provenance(payload, out_.content);
      case ChunkType::sampling:
        if (out_.content.analytic) throw Error(ErrorCode::malformed, "chunk: sampling tables of an analytic model, which needs none");
        spend(payload.size(), "sampling tables");
        out_.content.sampling.assign(payload.begin(), payload.end());  // decoded where it is needed
        return;
    }
    if ((code & optional_bit) == 0)
      throw Error(ErrorCode::unsupported, "chunk: critical " + kind_name(code) + " is not known to this version");
  }

  bool has_lobes() const noexcept { return have_lobes_; }

 private:
  void lobes(std::span<const std::byte> payload, LobeSet (*reader)(std::span<const std::byte>, int, std::uint32_t)) {
    begin_lobes();
    spend(most_lobes * channels() * 3 * sizeof(double), "lobes");  // as read, and twice as evaluated
    out_.content.errors.push_back(read_error(payload, 0, EvalLevel::fast));
    out_.content.lobes = reader(payload, out_.content.component.channels.count, limits_.max_lobes);
  }

  /// A model in the place of the lobes.
  void analytic(std::span<const std::byte> payload) {
    begin_lobes();
    if (!out_.content.sampling.empty()) throw Error(ErrorCode::malformed, "chunk: sampling tables before an analytic model, which needs none");
    spend(channels() * 4 * sizeof(float), "analytic model");  // as read, and as it is sampled
    out_.content.lobes.channels = out_.content.component.channels.count;
    out_.content.analytic = read_analytic(payload, out_.content.component);
  }

  void begin_lobes() {
    if (have_lobes_) throw Error(ErrorCode::malformed, "chunk: a second lobes or analytic chunk");
    have_lobes_ = true;
  }

  void residual(std::span<const std::byte> payload) {
    if (out_.content.analytic) throw Error(ErrorCode::malformed, "chunk: a residual of an analytic model, which has none");
    if (!have_lobes_ || codec_) throw Error(ErrorCode::malformed, "chunk: the residual is not directly after the lobes");
    residual::ResidualCode& code = out_.content.residual;
    std::span<const std::byte> rest = payload;
    read_errors(rest, 1);
    BitReader bits(rest, "residual chunk");
    code.basis = read_basis(bits, count_);
    code.azimuth = azimuth_of(out_.content.component);
    code.channels = out_.content.component.channels.count;
    std::span<const std::byte> layers = bits.rest();
    if (out_.content.component.axes == AxesKind::slices) code.slices = read_slice_frame(layers);
    spend_codec(residual::reach_of(code.slices));
    codec_.emplace(code.basis, residual::even_only(code.azimuth), code.channels, count_, residual::reach_of(code.slices));
    layer(layers);
  }

  void refinement(std::span<const std::byte> payload) {
    if (!codec_) throw Error(ErrorCode::malformed, "chunk: a refinement without a residual before it");
    read_errors(payload, out_.refinements_read + 1);
    layer(payload);
  }

  void read_errors(std::span<const std::byte>& payload, int refinement) {
    for (const EvalLevel level : {EvalLevel::balanced, EvalLevel::exact})
      out_.content.errors.push_back(read_error(payload, refinement, level));
  }

  void layer(std::span<const std::byte> bytes) {
    auto& layers = out_.content.residual.layers;
    const residual::Layer* before = layers.empty() ? nullptr : &layers.back();
    spend(channels() * (count_ * sizeof(std::int32_t) + sizeof(std::vector<std::int32_t>) + sizeof(std::uint32_t)), residual_name);
    layers.push_back(residual::decode_layer(*codec_, before, bytes, static_cast<std::size_t>(out_.content.residual.channels), count_));
    ++out_.refinements_read;
  }

  /// What is there once for all layers: magnitudes known so far with a border of two, two lists of frequencies, and the sum
  /// of the layers.
  void spend_codec(const residual::Extent& reach) {
    const auto box = [n = std::uint64_t{count_}](int most) { return std::min(n, static_cast<std::uint64_t>(most)) + 2; };
    spend(channels() * box(reach.k) * box(reach.l) * box(reach.m) + 2 * count_ * sizeof(residual::Frequency) +
              channels() * (count_ * sizeof(float) + sizeof(std::vector<float>)),
          residual_name);
  }

  /// Counts memory before any of it is allocated. Nothing overflows: channels, layers and counts have limits of their own.
  void spend(std::uint64_t bytes, const char* what) {
    out_.temporary_bytes += bytes;
    if (out_.temporary_bytes > limits_.max_temporary_bytes)
      throw Error(ErrorCode::limit_exceeded, std::string(what) + " need up to " + std::to_string(out_.temporary_bytes) +
                                                 " bytes while the file is read, the limit is " +
                                                 std::to_string(limits_.max_temporary_bytes));
  }

  std::uint64_t channels() const noexcept { return static_cast<std::uint64_t>(out_.content.component.channels.count); }

  static constexpr std::uint64_t most_lobes = 1U << lobe_count_bits;
  static constexpr const char* residual_name = "residual: its coefficients";

  Unpacked& out_;
  const DecodeLimits& limits_;
  bool have_lobes_ = false;
  std::uint32_t count_ = 0;
  std::optional<residual::LayerCodec> codec_;
};

bool is_lobes(std::uint8_t code) noexcept {
  const auto type = static_cast<ChunkType>(code);
  return type == ChunkType::lobes || type == ChunkType::packed_lobes || type == ChunkType::analytic;
}

bool is_layer(std::uint8_t code) noexcept {
  const auto type = static_cast<ChunkType>(code);
  return type == ChunkType::residual || type == ChunkType::refinement;
}

}  // namespace

std::vector<std::uint64_t> boundaries(std::span<const std::byte> bytes, const DecodeLimits& limits) {
  const Header header = read_header(bytes, limits);
  std::vector<std::uint64_t> ends;
  std::uint64_t at = header.header_bytes;
  for (const DirectoryEntry& e : header.directory) {
    at += e.length + checksum_bytes;
    if (is_layer(e.code) || is_lobes(e.code)) ends.push_back(at);
  }
  return ends;
}

Unpacked unpack(std::span<const std::byte> bytes, const DecodeLimits& limits, bool allow_prefix) {
  const Header header = read_header(bytes, limits);
  Unpacked out;
  out.content.component = header.component;
  out.total_bytes = header.total_bytes;
  for (const DirectoryEntry& e : header.directory) out.refinements_total += is_layer(e.code) ? 1 : 0;
  if (bytes.size() > header.total_bytes)
    throw Error(ErrorCode::malformed, ".brdfc file: " + std::to_string(bytes.size()) + " bytes, the header says " + std::to_string(header.total_bytes));
  if (bytes.size() < header.total_bytes && !allow_prefix)
    throw Error(ErrorCode::truncated, ".brdfc file: " + std::to_string(bytes.size()) + " bytes of " + std::to_string(header.total_bytes) + "; a coarser material is read only when a prefix is asked for");

  ChunkReader reader(out, limits);
  std::uint32_t checksum = header.checksum;
  std::uint64_t at = header.header_bytes;
  for (const DirectoryEntry& e : header.directory) {
    if (at == bytes.size() && at > header.header_bytes) break;  // cut exactly at a boundary
    if (bytes.size() - at < e.length + checksum_bytes)
      throw Error(ErrorCode::truncated, ".brdfc file: " + std::to_string(bytes.size()) + " bytes end within the " +
                                            kind_name(e.code) + " chunk, which ends at byte " +
                                            std::to_string(at + e.length + checksum_bytes));
    const std::span<const std::byte> payload = bytes.subspan(at, e.length);
    checksum = chain(payload, checksum);
    if (base::load_little_endian<std::uint32_t>(bytes.subspan(at + e.length, checksum_bytes)) != checksum)
      throw Error(ErrorCode::checksum, ".brdfc file: checksum of the " + kind_name(e.code) + " chunk does not match, the file is damaged");
    reader.read(e.code, payload);
    at += e.length + checksum_bytes;
  }
  if (!reader.has_lobes()) throw Error(ErrorCode::malformed, ".brdfc file: it has no lobes chunk");
  if (!out.content.sampling.empty()) check_density(out.content.sampling, lobes::has_retro_lobes(out.content.lobes));
  return out;
}

}  // namespace brdf::container
