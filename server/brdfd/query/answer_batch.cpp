// SPDX-License-Identifier: Apache-2.0
#include "query/batch.h"

#include "counter_random.h"
#include "shared/float_bytes.h"

#include <brdf/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace brdf::service {
namespace {

/// Three planes of a block, in the first level of cache.
struct Block {
  alignas(64) std::array<float, 3 * stop_interval> data;

  float* plane(std::size_t k) noexcept { return data.data() + k * stop_interval; }
  DirectionSpan span(std::size_t n) noexcept { return {plane(0), plane(1), plane(2), n}; }
  MutableDirectionSpan writable(std::size_t n) noexcept { return {plane(0), plane(1), plane(2), n}; }

  /// Rows [first, first + n) of `bytes`, which holds planes of `count`.
  void load(std::string_view bytes, std::size_t count, std::size_t first, std::size_t n) noexcept {
    for (std::size_t k = 0; k < 3; ++k) load_floats(bytes, k * count + first, {plane(k), n});
  }
};

Error bad_query(const char* field, std::size_t query, const std::string& why) {
  return {ErrorCode::invalid_argument, std::string(field) + " of query " + std::to_string(query) + " " + why};
}

std::string text_of(Block& b, std::size_t i) {
  return "is (" + std::to_string(b.plane(0)[i]) + ", " + std::to_string(b.plane(1)[i]) + ", " + std::to_string(b.plane(2)[i]) + ")";
}

bool is_direction(float x, float y, float z) noexcept {
  const float squared = x * x + y * y + z * z;
  return std::abs(squared - 1) <= 2.01e-3F || squared == 0;  // NaN compares false
}

void require_directions(const char* field, Block& b, std::size_t first, std::size_t n) {
  const float *x = b.plane(0), *y = b.plane(1), *z = b.plane(2);
  int bad = 0;
  for (std::size_t i = 0; i < n; ++i) bad |= static_cast<int>(!is_direction(x[i], y[i], z[i]));
  if (bad == 0) return;
  std::size_t i = 0;
  while (is_direction(x[i], y[i], z[i])) ++i;
  throw bad_query(field, first + i, text_of(b, i) + ", wanted is a unit vector");
}

void require_random(Block& b, std::size_t first, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (!(b.plane(k)[i] >= 0 && b.plane(k)[i] < 1)) throw bad_query("numbers", first + i, text_of(b, i) + ", wanted are numbers in [0, 1)");
}

/// Directions of one field, block by block; one direction for every query is loaded once.
class Directions {
 public:
  Directions(const char* field, std::string_view bytes, std::size_t count) : field_(field), bytes_(bytes), count_(count), single_(count > 1 && bytes.size() == 3 * sizeof(float)) {
    if (!single_) return;
    block_.load(bytes, 1, 0, 1);
    require_directions(field, block_, 0, 1);
    for (std::size_t k = 0; k < 3; ++k) std::fill_n(block_.plane(k), stop_interval, block_.plane(k)[0]);
  }

  DirectionSpan at(std::size_t first, std::size_t n) {
    if (!single_) {
      block_.load(bytes_, count_, first, n);
      require_directions(field_, block_, first, n);
    }
    return block_.span(n);
  }

 private:
  const char* field_;
  std::string_view bytes_;
  std::size_t count_;
  bool single_;
  Block block_;
};

/// Values of a block, channel after channel.
class Values {
 public:
  explicit Values(std::size_t channels) : channels_(channels), data_(channels * stop_interval) {}
  PlanarSpan span() noexcept { return {data_.data(), stop_interval}; }
  void store(std::string& bytes, std::size_t count, std::size_t first, std::size_t n) const noexcept {
    for (std::size_t c = 0; c < channels_; ++c) store_floats({data_.data() + c * stop_interval, n}, bytes, c * count + first);
  }

 private:
  std::size_t channels_;
  std::vector<float> data_;
};

void draw_numbers(const v1::EvaluateRequest& request, std::size_t first, std::size_t n, Block& u) {
  if (request.has_numbers()) {
    u.load(request.numbers(), request.count(), first, n);
    require_random(u, first, n);
    return;
  }
  const cli::CounterRandom random(request.seeded().seed());
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) u.plane(k)[i] = random.uniform(request.seeded().first_row() + first + i, k);
}

}  // namespace

bool answer_batch(const Material& material, const BatchPlan& plan, const v1::EvaluateRequest& request, v1::EvaluateResponse& response, const Stop& stop) {
  const std::size_t count = request.count(), channels = static_cast<std::size_t>(material.channels()), plane = count * sizeof(float);
  response.set_count(request.count());
  response.set_channels(static_cast<std::uint32_t>(channels));
  if (plan.evaluate) response.mutable_values()->resize(channels * plane);
  if (plan.pdf) response.mutable_pdf()->resize(plane);
  if (plan.sample) {
    response.mutable_sample_wi()->resize(3 * plane);
    response.mutable_sample_pdf()->resize(plane);
    response.mutable_sample_weight()->resize(channels * plane);
  }
  const bool pairs = plan.evaluate || plan.pdf;
  const TransportMode mode = request.transport() == v1::TRANSPORT_MODE_IMPORTANCE ? TransportMode::importance : TransportMode::radiance;
  Directions in("wi", request.wi(), count), out("wo", request.wo(), count);
  Values values(channels);
  Block drawn, u;
  std::array<float, stop_interval> density;
  for (std::size_t first = 0; first < count; first += stop_interval) {
    if (stop()) return false;
    const std::size_t n = std::min(stop_interval, count - first);
    const DirectionSpan wo = out.at(first, n);
    const DirectionSpan wi = pairs ? in.at(first, n) : DirectionSpan{};
    if (plan.evaluate && plan.pdf) {
      material.eval_pdf(wi, wo, values.span(), density.data());
    } else if (plan.evaluate) {
      material.eval(wi, wo, values.span());
    } else if (plan.pdf) {
      material.pdf(wi, wo, density.data());
    }
    if (plan.evaluate) values.store(*response.mutable_values(), count, first, n);
    if (plan.pdf) store_floats({density.data(), n}, *response.mutable_pdf(), first);
    if (plan.sample) {
      draw_numbers(request, first, n, u);
      material.sample(wo, u.span(n), drawn.writable(n), density.data(), values.span(), mode);
      for (std::size_t k = 0; k < 3; ++k) store_floats({drawn.plane(k), n}, *response.mutable_sample_wi(), k * count + first);
      store_floats({density.data(), n}, *response.mutable_sample_pdf(), first);
      values.store(*response.mutable_sample_weight(), count, first, n);
    }
  }
  return true;
}

bool answer_albedo(const Material& material, const v1::AlbedoRequest& request, v1::AlbedoResponse& response, const Stop& stop) {
  const std::size_t count = request.count(), channels = static_cast<std::size_t>(material.channels());
  response.set_count(request.count());
  response.set_channels(static_cast<std::uint32_t>(channels));
  response.mutable_albedo()->resize(count * channels * sizeof(float));
  Block wo;
  std::vector<float> albedo(channels);
  for (std::size_t i = 0; i < count; ++i) {
    if (stop()) return false;
    wo.load(request.wo(), count, i, 1);
    require_directions("wo", wo, i, 1);
    material.albedo({wo.plane(0)[0], wo.plane(1)[0], wo.plane(2)[0]}, albedo);
    for (std::size_t c = 0; c < channels; ++c) store_floats({&albedo[c], 1}, *response.mutable_albedo(), c * count + i);
  }
  return true;
}

}  // namespace brdf::service
