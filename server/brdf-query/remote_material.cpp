// SPDX-License-Identifier: Apache-2.0
#include "remote_material.h"

#include "counter_random.h"
#include "direction_planes.h"
#include "exit_codes.h"
#include "shared/float_bytes.h"

#include <algorithm>
#include <array>

namespace brdf::query {
namespace {

constexpr std::size_t most_rows = 16384, most_answer_bytes = std::size_t{2} << 20;

std::string planes(std::span<const Vec3f> directions) {
  std::string bytes(directions.size() * 3 * sizeof(float), '\0');
  std::vector<float> plane(directions.size());
  for (glm::length_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < directions.size(); ++i) plane[i] = directions[i][k];
    service::store_floats(plane, bytes, static_cast<std::size_t>(k) * directions.size());
  }
  return bytes;
}

/// Planes of `channels` values as rows of `columns`, from column `at` on. Throws CallError for an answer of another size.
void interleave(const std::string& bytes, std::size_t n, std::size_t channels, std::span<float> rows, std::size_t columns, std::size_t at) {
  if (bytes.size() != n * channels * sizeof(float)) throw client::CallError(grpc::StatusCode::DATA_LOSS, "the answer has another size than was asked for");
  std::vector<float> plane(n);
  for (std::size_t c = 0; c < channels; ++c) {
    service::load_floats(bytes, c * n, plane);
    for (std::size_t i = 0; i < n; ++i) rows[i * columns + at + c] = plane[i];
  }
}

v1::EvalLevel message_of(EvalLevel level) noexcept {
  return level == EvalLevel::fast ? v1::EVAL_LEVEL_FAST : level == EvalLevel::exact ? v1::EVAL_LEVEL_EXACT : v1::EVAL_LEVEL_BALANCED;
}

}  // namespace

RemoteMaterial::RemoteMaterial(const Connection& connection, const MaterialOptions& options) : client_(connection.open()), options_(options) {
  const v1::Material material = client_.get(resource_name(options.name));
  version_ = material.version();
  channels_ = material.channels().count();
  if (options_.prefix && *options_.prefix < material.bytes()) {
    std::string allowed;
    bool found = false;
    for (const v1::Refinement& r : material.refinements()) {
      found = found || r.prefix_bytes() == *options_.prefix;
      allowed += (allowed.empty() ? "" : ", ") + std::to_string(r.prefix_bytes());
    }
    if (!found) throw cli::Failure(cli::ExitCode::usage, "--prefix is " + std::to_string(*options_.prefix) + ", but refinements of " + options.name + " end at " + allowed);
  }
  if (!options_.local) return;
  DecodeOptions decode;
  decode.level = options_.level;
  client::FetchOptions fetch;
  if (options_.prefix) fetch.max_bytes = *options_.prefix;
  local_ = client_.open(version_, decode, fetch);
}

std::size_t RemoteMaterial::rows_of_a_call() const noexcept {
  return std::clamp<std::size_t>(most_answer_bytes / (sizeof(float) * (static_cast<std::size_t>(channels_) + 4)), 1, most_rows);
}

v1::EvaluateRequest RemoteMaterial::request(std::uint32_t operations, std::size_t n) const {
  v1::EvaluateRequest r;
  r.set_material(version_);
  r.set_level(message_of(options_.level));
  r.set_prefix_bytes(options_.prefix.value_or(0));
  r.set_operations(operations);
  r.set_count(static_cast<std::uint32_t>(n));
  return r;
}

BatchEval RemoteMaterial::eval_rows() {
  return [this](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    const auto channels = static_cast<std::size_t>(channels_);
    for (std::size_t first = 0; first < wi.size();) {
      const std::size_t n = std::min(rows_of_a_call(), wi.size() - first);
      const std::span<float> rows = out.subspan(first * channels, n * channels);
      if (local_) {
        cli::DirectionPlanes in, view;
        in.assign(wi.subspan(first, n));
        view.assign(wo.subspan(first, n));
        std::vector<float> values(n * channels);
        local_->eval(in.span(), view.span(), {values.data(), n});
        for (std::size_t c = 0; c < channels; ++c)
          for (std::size_t i = 0; i < n; ++i) rows[i * channels + c] = values[c * n + i];
      } else {
        v1::EvaluateRequest r = request(v1::OPERATION_EVALUATE, n);
        r.set_wi(planes(wi.subspan(first, n)));
        r.set_wo(planes(wo.subspan(first, n)));
        interleave(client_.evaluate(r).values(), n, channels, rows, channels, 0);
      }
      first += n;
    }
  };
}

BatchEval RemoteMaterial::pdf_rows() {
  return [this](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    if (local_) {
      cli::DirectionPlanes in, view;
      in.assign(wi);
      view.assign(wo);
      local_->pdf(in.span(), view.span(), out.data());
      return;
    }
    v1::EvaluateRequest r = request(v1::OPERATION_PDF, wi.size());
    r.set_wi(planes(wi));
    r.set_wo(planes(wo));
    interleave(client_.evaluate(r).pdf(), wi.size(), 1, out, 1, 0);
  };
}

void RemoteMaterial::sample(const Vec3f& wo, std::uint64_t seed, std::uint64_t first, std::size_t n, std::span<float> rows) {
  const auto channels = static_cast<std::size_t>(channels_);
  const std::size_t columns = 4 + channels;
  for (std::size_t done = 0; done < n;) {
    const std::size_t part = std::min(rows_of_a_call(), n - done);
    const std::span<float> out = rows.subspan(done * columns, part * columns);
    if (local_) {
      const cli::CounterRandom random(seed);
      cli::DirectionPlanes view(part), u(part), wi(part);
      std::vector<float> pdf(part), weight(part * channels);
      for (std::size_t i = 0; i < part; ++i) {
        const std::uint64_t row = first + done + i;
        view.set(i, wo);
        u.set(i, {random.uniform(row, 0), random.uniform(row, 1), random.uniform(row, 2)});
      }
      local_->sample(view.span(), u.span(), wi.span(), pdf.data(), {weight.data(), part});
      for (std::size_t i = 0; i < part; ++i) {
        const Vec3f w = wi.get(i);
        const std::array<float, 4> head{w.x, w.y, w.z, pdf[i]};
        std::copy(head.begin(), head.end(), out.begin() + static_cast<std::ptrdiff_t>(i * columns));
        for (std::size_t c = 0; c < channels; ++c) out[i * columns + 4 + c] = weight[c * part + i];
      }
    } else {
      v1::EvaluateRequest r = request(v1::OPERATION_SAMPLE, part);
      r.set_wo(planes(std::span(&wo, 1)));
      r.mutable_seeded()->set_seed(seed);
      r.mutable_seeded()->set_first_row(first + done);
      const v1::EvaluateResponse answer = client_.evaluate(r);
      interleave(answer.sample_wi(), part, 3, out, columns, 0);
      interleave(answer.sample_pdf(), part, 1, out, columns, 3);
      interleave(answer.sample_weight(), part, channels, out, columns, 4);
    }
    done += part;
  }
}

}  // namespace brdf::query
