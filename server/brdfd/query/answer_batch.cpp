// SPDX-License-Identifier: Apache-2.0
#include "query/batch.h"

#include "counter_random.h"
#include "query/field_error.h"
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

  /// Rows [first, first + n) of `bytes`, which holds planes of `count`.
  void load(std::string_view bytes, std::size_t count, std::size_t first, std::size_t n) noexcept {
    for (std::size_t k = 0; k < 3; ++k) load_floats(bytes, k * count + first, {plane(k), n});
  }
};

FieldError bad_query(const char* field, std::size_t query, const std::string& why) {
  return {field, "of query " + std::to_string(query) + " " + why};
}

std::string text_of(const DirectionSpan& d, std::size_t i) {
  return "is (" + std::to_string(d.x[i]) + ", " + std::to_string(d.y[i]) + ", " + std::to_string(d.z[i]) + ")";
}

bool is_direction(float x, float y, float z) noexcept {
  const float squared = x * x + y * y + z * z;
  return static_cast<bool>(static_cast<int>(std::abs(squared - 1) <= 2.01e-3F) | static_cast<int>(squared == 0));  // NaN compares false
}

/// Counts those that are no directions: without a branch and by sixteen, so that compilers use vectors for it.
int bad_directions(const DirectionSpan& d) noexcept {
  constexpr std::size_t lanes = 16;
  const float *x = d.x, *y = d.y, *z = d.z;
  std::array<int, lanes> bad{};
  std::size_t i = 0;
  for (; i + lanes <= d.size; i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) bad[k] += static_cast<int>(!is_direction(x[i + k], y[i + k], z[i + k]));
  int sum = 0;
  for (const int b : bad) sum += b;
  for (; i < d.size; ++i) sum += static_cast<int>(!is_direction(x[i], y[i], z[i]));
  return sum;
}

void require_directions(const char* field, const DirectionSpan& d, std::size_t first) {
  if (bad_directions(d) == 0) return;
  std::size_t i = 0;
  while (is_direction(d.x[i], d.y[i], d.z[i])) ++i;
  throw bad_query(field, first + i, text_of(d, i) + ", wanted is a unit vector");
}

void require_random(const DirectionSpan& u, std::size_t first) {
  for (std::size_t i = 0; i < u.size; ++i)
    for (const float v : {u.x[i], u.y[i], u.z[i]})
      if (!(v >= 0 && v < 1)) throw bad_query("numbers", first + i, text_of(u, i) + ", wanted are numbers in [0, 1)");
}

/// Three planes of a message, block by block: where they lie, or in a copy where that cannot be read. One row for every query is loaded
/// once.
class Input {
 public:
  Input(std::string_view bytes, std::size_t count) : bytes_(bytes), count_(count), in_place_(floats_in_place(bytes)), single_(count > 1 && bytes.size() == 3 * sizeof(float)) {
    if (!single_) return;
    block_.load(bytes, 1, 0, 1);
    for (std::size_t k = 0; k < 3; ++k) std::fill_n(block_.plane(k), stop_interval, block_.plane(k)[0]);
  }
  bool single() const noexcept { return single_; }

  DirectionSpan at(std::size_t first, std::size_t n) noexcept {
    if (single_) return block_.span(n);
    if (in_place_ != nullptr) return {in_place_ + first, in_place_ + count_ + first, in_place_ + 2 * count_ + first, n};
    block_.load(bytes_, count_, first, n);
    return block_.span(n);
  }

 private:
  std::string_view bytes_;
  std::size_t count_;
  const float* in_place_;
  bool single_;
  Block block_;
};

/// Directions of one field.
class Directions {
 public:
  Directions(const char* field, std::string_view bytes, std::size_t count) : field_(field), input_(bytes, count) {
    if (input_.single()) require_directions(field, input_.at(0, 1), 0);
  }
  DirectionSpan at(std::size_t first, std::size_t n) {
    const DirectionSpan d = input_.at(first, n);
    if (!input_.single()) require_directions(field_, d, first);
    return d;
  }

 private:
  const char* field_;
  Input input_;
};

/// Planes of the answer, block by block: written where they belong, or to a copy that `store` brings there.
class Output {
 public:
  /// Null: not wanted.
  Output(std::string* bytes, std::size_t planes, std::size_t count) : bytes_(bytes), planes_(planes), count_(count) {
    if (bytes == nullptr) return;
    bytes->resize(planes * count * sizeof(float));
    in_place_ = floats_in_place(*bytes);
    if (in_place_ == nullptr) copy_.resize(planes * stop_interval);
  }

  float* plane(std::size_t k, std::size_t first) noexcept { return in_place_ != nullptr ? in_place_ + k * count_ + first : copy_.data() + k * stop_interval; }
  PlanarSpan values(std::size_t first) noexcept { return {plane(0, first), in_place_ != nullptr ? count_ : stop_interval}; }
  MutableDirectionSpan directions(std::size_t first, std::size_t n) noexcept { return {plane(0, first), plane(1, first), plane(2, first), n}; }

  void store(std::size_t first, std::size_t n) noexcept {
    if (in_place_ != nullptr) return;
    for (std::size_t k = 0; k < planes_; ++k) store_floats({plane(k, first), n}, *bytes_, k * count_ + first);
  }

 private:
  std::string* bytes_;
  std::size_t planes_, count_;
  float* in_place_ = nullptr;
  std::vector<float> copy_;
};

/// Random numbers of the rows from `first` on: the client's, or those that its seed makes.
class Numbers {
 public:
  explicit Numbers(const v1::EvaluateRequest& request) : request_(request), input_(request.numbers(), request.count()) {}

  DirectionSpan at(std::size_t first, std::size_t n) {
    if (request_.has_numbers()) {
      const DirectionSpan u = input_.at(first, n);
      require_random(u, first);
      return u;
    }
    const cli::CounterRandom random(request_.seeded().seed());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < 3; ++k) made_.plane(k)[i] = random.uniform(request_.seeded().first_row() + first + i, k);
    return made_.span(n);
  }

 private:
  const v1::EvaluateRequest& request_;
  Input input_;
  Block made_;
};

}  // namespace

bool answer_batch(const Material& material, const BatchPlan& plan, const v1::EvaluateRequest& request, v1::EvaluateResponse& response, const Stop& stop) {
  const std::size_t count = request.count(), channels = static_cast<std::size_t>(material.channels());
  response.set_count(request.count());
  response.set_channels(static_cast<std::uint32_t>(channels));
  Output values(plan.evaluate ? response.mutable_values() : nullptr, channels, count), densities(plan.pdf ? response.mutable_pdf() : nullptr, 1, count);
  Output drawn(plan.sample ? response.mutable_sample_wi() : nullptr, 3, count), drawn_densities(plan.sample ? response.mutable_sample_pdf() : nullptr, 1, count);
  Output weights(plan.sample ? response.mutable_sample_weight() : nullptr, channels, count);
  const bool pairs = plan.evaluate || plan.pdf;
  const TransportMode mode = request.transport() == v1::TRANSPORT_MODE_IMPORTANCE ? TransportMode::importance : TransportMode::radiance;
  Directions in("wi", request.wi(), count), out("wo", request.wo(), count);
  Numbers numbers(request);
  for (std::size_t first = 0; first < count; first += stop_interval) {
    if (stop()) return false;
    const std::size_t n = std::min(stop_interval, count - first);
    const DirectionSpan wo = out.at(first, n);
    const DirectionSpan wi = pairs ? in.at(first, n) : DirectionSpan{};
    if (plan.evaluate && plan.pdf) {
      material.eval_pdf(wi, wo, values.values(first), densities.plane(0, first));
    } else if (plan.evaluate) {
      material.eval(wi, wo, values.values(first));
    } else if (plan.pdf) {
      material.pdf(wi, wo, densities.plane(0, first));
    }
    if (plan.evaluate) values.store(first, n);
    if (plan.pdf) densities.store(first, n);
    if (!plan.sample) continue;
    material.sample(wo, numbers.at(first, n), drawn.directions(first, n), drawn_densities.plane(0, first), weights.values(first), mode);
    for (Output* o : {&drawn, &drawn_densities, &weights}) o->store(first, n);
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
    const DirectionSpan one = wo.span(1);
    if (bad_directions(one) != 0) throw bad_query("wo", i, text_of(one, 0) + ", wanted is a unit vector");
    material.albedo({wo.plane(0)[0], wo.plane(1)[0], wo.plane(2)[0]}, albedo);
    for (std::size_t c = 0; c < channels; ++c) store_floats({&albedo[c], 1}, *response.mutable_albedo(), c * count + i);
  }
  return true;
}

}  // namespace brdf::service
