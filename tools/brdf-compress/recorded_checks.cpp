// SPDX-License-Identifier: Apache-2.0
#include "recorded_checks.h"

#include "compressed_file.h"
#include "exit_codes.h"
#include "text_table.h"

namespace brdf::cli {
namespace {

// Low efforts record what a fraction of the directions says, here all of them count.
constexpr double log_mae_factor = 1.15, log_mae_slack = 1e-4;
constexpr double psnr_slack = 0.75;
constexpr double psnr_cap = 60;

Check log_mae_check(const RecordedError& recorded, const ErrorReport& now, const std::string& where) {
  const double most = recorded.log_mae * log_mae_factor + log_mae_slack;
  return {"log_mae is as recorded", now.log_mae.all <= most, now.log_mae.all,
          "at most " + significant(most, 4) + " (recorded " + significant(recorded.log_mae, 4) + ")", where};
}

Check psnr_check(const RecordedError& recorded, const ErrorReport& now, const std::string& where) {
  const double least = std::min(recorded.psnr_env, psnr_cap) - psnr_slack;
  return {"psnr_env is as recorded", now.psnr_env >= least, now.psnr_env,
          "at least " + fixed(least, 2) + " (recorded " + fixed(recorded.psnr_env, 2) + ")", where};
}

}  // namespace

Checks recorded_checks(const MaterialSource& file, const MaterialSource& reference, int threads, ProgressBar& bar) {
  const MaterialInfo& info = file.material().info();
  if (reference.channels().count != info.channels.count) {
    throw Failure(ExitCode::bad_input, reference.path() + ": has " + std::to_string(reference.channels().count) +
                                           " channels, " + file.path() + " has " + std::to_string(info.channels.count));
  }
  Checks checks;
  bar.show("reference", 0.4);
  const Comparison comparison(reference.rows(), info.channels.count, 1.0, threads);
  const std::vector<std::uint64_t> ends = refinement_ends(file.bytes(), file.path());
  double done = 0;
  for (const RecordedError& recorded : info.errors) {
    bar.show("errors", 0.6 + 0.4 * done++ / static_cast<double>(info.errors.size()));
    const auto end = static_cast<std::size_t>(ends.at(static_cast<std::size_t>(recorded.refinement)));
    const Material m = decode_file(std::span(file.bytes()).first(end), recorded.level, true, file.path());
    const ErrorReport now = comparison.score(batch_rows(m));
    const std::string where = "refinement " + std::to_string(recorded.refinement) + " at " + to_string(recorded.level);
    checks.push_back(log_mae_check(recorded, now, where));
    checks.push_back(psnr_check(recorded, now, where));
  }
  return checks;
}

}  // namespace brdf::cli
