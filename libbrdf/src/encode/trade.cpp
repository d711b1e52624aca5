// SPDX-License-Identifier: Apache-2.0
#include "container/content.h"

#include <brdf/error.h>
#include <brdf/trade.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <tuple>

namespace brdf {
namespace {

using File = std::shared_ptr<const std::vector<std::byte>>;

BatchEval rows_of(const Material& material) {
  return [&material, n = static_cast<std::size_t>(material.channels())](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    for (std::size_t i = 0; i < wi.size(); ++i) material.eval(wi[i], wo[i], out.subspan(i * n, n));
  };
}

Representation representation_of(const container::Content& content) noexcept {
  if (!content.residual.empty()) return content.residual.slices.empty() ? Representation::half_difference : Representation::slices;
  return content.lobes.lobes.size() <= 1 ? Representation::single_lobe : Representation::lobes;
}

/// Measures points; times what evaluates alike only once.
class Measure {
 public:
  Measure(const Measurement& m, const TradeOptions& options)
      : options_(options), reference_(m), comparison_(reference_rows(m), m.channels.count, *options.encode.profile) {}

  void add(const File& file, std::vector<TradePoint>& points) {
    const container::Content whole = container::unpack(*file, {}, false).content;
    for (const std::uint64_t end : refinement_boundaries(*file)) {
      container::Content content = container::unpack(std::span(*file).first(end), {}, true).content;
      content.purpose = whole.purpose;
      for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
        if ((level == EvalLevel::fast) != content.residual.empty()) continue;  // lobes alone are the same at every level
        points.push_back(point(content, level));
      }
    }
  }

 private:
  BatchEval reference_rows(const Measurement& m) {
    return [this, n = static_cast<std::size_t>(m.channels.count)](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
      std::vector<double> f(n);
      for (std::size_t i = 0; i < wi.size(); ++i) {
        if (!reference_.eval(Vec3d(wi[i]), Vec3d(wo[i]), f)) std::fill(f.begin(), f.end(), std::numeric_limits<double>::quiet_NaN());
        std::transform(f.begin(), f.end(), out.begin() + static_cast<std::ptrdiff_t>(i * n), [](double v) { return static_cast<float>(v); });
      }
    };
  }

  TradePoint point(container::Content content, EvalLevel level) {
    DecodeOptions decode;
    decode.level = level;
    decode.sampling = false;
    const Material material = Material::decode(container::pack(content), decode);
    TradePoint p;
    p.level = level;
    p.representation = representation_of(content);
    p.lobes = static_cast<int>(content.lobes.lobes.size());
    p.refinements = static_cast<int>(content.residual.layers.size());
    p.error = comparison_.score(rows_of(material));
    if (content.purpose) {
      content.purpose->level = level;
      content.purpose->rms = p.error.rms;
      content.purpose->log_error = p.error.log_error;
    }
    p.file = std::make_shared<const std::vector<std::byte>>(container::pack(content));
    p.bytes = p.file->size();
    p.resident_bytes = material.resident_bytes();
    const auto [known, fresh] = times_.try_emplace({level, p.representation, p.lobes, p.resident_bytes}, std::numeric_limits<double>::quiet_NaN());
    if (fresh && options_.nanoseconds) known->second = options_.nanoseconds(material);
    p.nanoseconds = known->second;
    return p;
  }

  const TradeOptions& options_;
  MeasurementInterpolator reference_;
  ProfileComparison comparison_;
  std::map<std::tuple<EvalLevel, Representation, int, std::uint64_t>, double> times_;
};

/// Whether `a` is at least as good in everything; equal points are told apart by their order.
bool beats(const TradePoint& a, const TradePoint& b) noexcept {
  const bool slower = a.nanoseconds > b.nanoseconds;  // false for NaN: without a clock time does not count
  return a.bytes <= b.bytes && a.error.log_error <= b.error.log_error && !slower;
}

}  // namespace

const char* to_string(Representation r) noexcept {
  switch (r) {
    case Representation::single_lobe: return "single lobe";
    case Representation::lobes: return "lobes";
    case Representation::half_difference: return "half/difference";
    case Representation::slices: return "slices";
  }
  return "unknown";
}

std::vector<TradePoint> measure_trade(const Measurement& m, const TradeOptions& options, const Progress& progress) {
  if (!options.encode.profile) throw Error(ErrorCode::invalid_argument, "measure_trade: a trade needs a profile");
  if (options.sizes.empty()) throw Error(ErrorCode::invalid_argument, "measure_trade: no sizes are given");
  Measure measure(m, options);
  std::vector<TradePoint> points;
  // lobes alone for the smallest sizes, everything for all: which level a file is made for decides what its bytes are spent on
  constexpr std::uint64_t lobes_up_to = 200;
  std::vector<std::pair<std::uint64_t, EvalLevel>> made;
  for (const std::uint64_t size : options.sizes) {
    if (size <= lobes_up_to) made.emplace_back(size, EvalLevel::fast);
    made.emplace_back(size, EvalLevel::balanced);
  }
  std::optional<Error> unmet;
  for (std::size_t i = 0; i < made.size(); ++i) {
    EncodeOptions encode = options.encode;
    encode.target_error.reset();
    encode.target_size = made[i].first;
    encode.level = made[i].second;
    try {
      const Progress part = [&](std::string_view stage, double done) {
        return !progress || progress(stage, (static_cast<double>(i) + done) / static_cast<double>(made.size()));
      };
      measure.add(std::make_shared<const std::vector<std::byte>>(compress(m, encode, part).bytes), points);
    } catch (const Error& e) {
      if (e.code() != ErrorCode::target_not_met) throw;
      unmet = e;
    }
  }
  if (points.empty()) throw *unmet;
  std::stable_sort(points.begin(), points.end(), [](const TradePoint& a, const TradePoint& b) {
    return std::tie(a.bytes, a.error.log_error) < std::tie(b.bytes, b.error.log_error);
  });
  std::vector<TradePoint> kept;
  for (const TradePoint& p : points)
    if (std::none_of(kept.begin(), kept.end(), [&](const TradePoint& k) { return beats(k, p); })) kept.push_back(p);
  return kept;
}

}  // namespace brdf
