// SPDX-License-Identifier: Apache-2.0
// eval, pdf and sample: rows as brdf-compress reads and writes them.
#include "direction_text.h"
#include "options.h"
#include "remote_material.h"
#include "row_options.h"
#include "row_queries.h"
#include "row_writer.h"
#include "verbs.h"

namespace brdf::query {
namespace {

constexpr std::size_t block_rows = 16384;

struct Options {
  MaterialOptions material;
  cli::RowFormat format = cli::RowFormat::csv;
  std::string wo;
  std::uint64_t count = 0, seed = 0;
};

CLI::App* add_verb(CLI::App& program, const std::string& name, const std::string& purpose, Options& o) {
  CLI::App* verb = program.add_subcommand(name, purpose);
  verb->add_option("MATERIAL", o.material.name, "Name of a material")->required();
  cli::add_row_format(*verb, o.format);
  cli::add_eval_level(*verb, o.material.level);
  cli::add_prefix(*verb, o.material.prefix);
  verb->add_flag("--local", o.material.local, "Fetch the material and evaluate here");
  return verb;
}

cli::ExitCode sample(const Connection& connection, const Options& o) {
  const Vec3f wo = cli::parse_direction("--wo", o.wo);
  RemoteMaterial material(connection, o.material);
  const std::size_t columns = 4 + static_cast<std::size_t>(material.channels());
  cli::RowWriter out(o.format, columns);
  std::vector<float> rows(block_rows * columns);
  for (std::uint64_t done = 0; done < o.count;) {
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(block_rows, o.count - done));
    material.sample(wo, o.seed, done, n, std::span(rows).first(n * columns));
    out.write(std::span(rows).first(n * columns));
    done += n;
  }
  out.flush();
  return cli::ExitCode::ok;
}

}  // namespace

Verb add_eval(CLI::App& program, const Connection& connection) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = add_verb(program, "eval", "Evaluate f(wi, wo) for rows of directions on stdin", *o);
  return {verb, [o, &connection] {
            RemoteMaterial material(connection, o->material);
            cli::answer_rows(material.eval_rows(), material.channels(), o->format);
            return cli::ExitCode::ok;
          }};
}

Verb add_pdf(CLI::App& program, const Connection& connection) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = add_verb(program, "pdf", "Density with which 'sample' draws wi given wo, for rows on stdin", *o);
  return {verb, [o, &connection] {
            RemoteMaterial material(connection, o->material);
            cli::answer_rows(material.pdf_rows(), 1, o->format);
            return cli::ExitCode::ok;
          }};
}

Verb add_sample(CLI::App& program, const Connection& connection) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = add_verb(program, "sample", "Draw directions wi for a given wo", *o);
  verb->add_option("--wo", o->wo, "Direction towards the viewer, a unit vector")->type_name("X,Y,Z")->required();
  verb->add_option("-n,--count", o->count, "Rows to write")->check(cli::natural_number())->type_name("N")->required();
  verb->add_option("--seed", o->seed, "Row i depends on the seed and i alone")->check(cli::natural_number())->type_name("S")->capture_default_str();
  return {verb, [o, &connection] { return sample(connection, *o); }};
}

}  // namespace brdf::query
