// SPDX-License-Identifier: Apache-2.0
#include "counter_random.h"
#include "direction_planes.h"
#include "direction_text.h"
#include "row_writer.h"
#include "sampling_density.h"
#include "verb_options.h"
#include "verbs.h"

#include <algorithm>
#include <memory>

namespace brdf::cli {
namespace {

constexpr std::size_t block_rows = 16384;

struct Options {
  std::string material, wo;
  SourceOptions source;
  RowFormat format = RowFormat::csv;
  std::uint64_t count = 0, seed = 0;
};

/// Draws rows `first` to `first + n`: wi.xyz, pdf, weight of each channel.
class RowSampler {
 public:
  RowSampler(const MaterialSource& source, const Options& o)
      : source_(source),
        density_(sampling_density(source)),
        random_(o.seed),
        view_(parse_direction("--wo", o.wo)),
        channels_(static_cast<std::size_t>(source.channels().count)) {}

  std::size_t columns() const noexcept { return 4 + channels_; }

  void draw(std::uint64_t first, std::size_t n, std::span<float> rows) {
    wo_.resize(n);
    u_.resize(n);
    wi_.resize(n);
    pdf_.resize(n);
    weight_.resize(n * channels_);
    for (std::size_t i = 0; i < n; ++i) {
      wo_.set(i, view_);
      u_.set(i, {random_.uniform(first + i, 0), random_.uniform(first + i, 1), random_.uniform(first + i, 2)});
    }
    density_.sample(wo_.span(), u_.span(), wi_.span(), pdf_.data(), {weight_.data(), n});
    if (!source_.is_compressed()) weigh_by_measurement(n);
    for (std::size_t i = 0; i < n; ++i) {
      float* row = rows.data() + i * columns();
      const Vec3f wi = wi_.get(i);
      row[0] = wi.x;
      row[1] = wi.y;
      row[2] = wi.z;
      row[3] = pdf_[i];
      for (std::size_t c = 0; c < channels_; ++c) row[4 + c] = weight_[c * n + i];
    }
  }

 private:
  /// The density is that of fitted lobes; the value is the measured one.
  void weigh_by_measurement(std::size_t n) {
    std::vector<double> f(channels_);
    for (std::size_t i = 0; i < n; ++i) {
      if (!(pdf_[i] > 0)) continue;
      const Vec3f wi = wi_.get(i);
      source_.eval(Vec3d(wi), Vec3d(view_), f);
      const double scale = static_cast<double>(wi.z) / static_cast<double>(pdf_[i]);
      for (std::size_t c = 0; c < channels_; ++c) weight_[c * n + i] = static_cast<float>(f[c] * scale);
    }
  }

  const MaterialSource& source_;
  Material density_;
  CounterRandom random_;
  Vec3f view_;
  std::size_t channels_;
  DirectionPlanes wo_, u_, wi_;
  std::vector<float> pdf_, weight_;
};

ExitCode run(const Options& o) {
  parse_direction("--wo", o.wo);  // before any work
  const MaterialSource source = MaterialSource::open(o.material, o.source);
  RowSampler sampler(source, o);
  RowWriter out(o.format, sampler.columns());
  std::vector<float> rows(block_rows * sampler.columns());
  for (std::uint64_t done = 0; done < o.count;) {
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(block_rows, o.count - done));
    sampler.draw(done, n, rows);
    out.write(std::span(rows).first(n * sampler.columns()));
    done += n;
  }
  out.flush();
  return ExitCode::ok;
}

}  // namespace

Verb add_sample(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("sample", "Draw directions wi for a given wo");
  verb->add_option("MATERIAL", o->material, "A .brdfc or measured file")->required();
  verb->add_option("--wo", o->wo, "Direction towards the viewer, a unit vector")->type_name("X,Y,Z")->required();
  verb->add_option("-n,--count", o->count, "Rows to write")->check(natural_number())->type_name("N")->required();
  verb->add_option("--seed", o->seed, "Row i depends on the seed and i alone")
      ->check(natural_number())
      ->type_name("S")
      ->capture_default_str();
  add_row_format(*verb, o->format);
  add_eval_level(*verb, o->source.level);
  add_prefix(*verb, o->source.prefix);
  add_position(*verb, o->source.position);
  verb->footer(
      "stdout: rows of wi.x wi.y wi.z pdf weight..., where weight = f cos(wi) / pdf, one per channel. A rejected "
      "sample is\n"
      "a row of zeros and counts. The three random numbers of row i are 24-bit hashes of (seed, i, 0 to 2).\n"
      "A measured file is sampled by a few lobes that are fitted to it first; its weights hold the measured values.\n\n"
      "Examples:\n"
      "  brdf-compress sample gold.brdfc --wo 0.6,0,0.8 -n 5 --seed 1\n"
      "  brdf-compress sample gold.brdfc --wo=-0.6,0,0.8 -n 1000000 --seed 7 --format f32 > samples.f32");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
