// SPDX-License-Identifier: Apache-2.0
#include "comparison_report.h"
#include "image/comparison_sheet.h"
#include "image/image_file.h"
#include "messages.h"
#include "options.h"
#include "output_file.h"
#include "standard_output.h"
#include "verbs.h"

#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  std::string reference, candidate, png;
  float exposure = 0;
  bool force = false;
  Reporting reporting;
};

/// Whatever is wrong with a picture is bad input.
render::Image read_picture(const std::string& path) {
  try {
    return render::read_image(path);
  } catch (const Error& e) {
    throw Failure(ExitCode::bad_input, e.what());
  }
}

ExitCode run(const Options& o) {
  if (!o.png.empty()) {
    for (const std::string& input : {o.reference, o.candidate}) check_output(o.png, input, o.force);
  }
  const render::Image reference = read_picture(o.reference), candidate = read_picture(o.candidate);
  render::ComparisonResult result;
  try {
    result = render::compare_images(reference, candidate, std::nullopt, o.exposure);
  } catch (const Error& e) {
    throw Failure(ExitCode::bad_input, o.candidate + ": " + e.what());
  }
  if (!o.png.empty()) {
    render::write_png(render::comparison_sheet(reference, candidate, result, {{o.reference}, {o.candidate}}, o.exposure), o.png, o.force);
  }
  if (!o.reporting.json) {
    print(comparison_table(result));
    return ExitCode::ok;
  }
  Json row;
  row["reference"] = o.reference;
  row["candidate"] = o.candidate;
  row["width"] = reference.width;
  row["height"] = reference.height;
  row["exposure"] = o.exposure;
  add_comparison(row, result);
  print(json_report("difference", Json::array({row})));
  return ExitCode::ok;
}

}  // namespace

Verb add_difference(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("difference", "Every figure on two OpenEXR pictures");
  verb->add_option("REFERENCE", o->reference, "An OpenEXR picture")->required();
  verb->add_option("CANDIDATE", o->candidate, "Another of the same size")->required();
  verb->add_option("--png", o->png, "Write both, their signed difference and the FLIP map as one picture")->type_name("OUT.png");
  verb->add_option("--exposure", o->exposure, "Stops at which a display shows the pictures: radiance is multiplied by 2^E")
      ->type_name("E")
      ->check(CLI::Range(-64.0, 64.0))
      ->capture_default_str();
  add_force(*verb, o->force);
  add_reporting(*verb, o->reporting);
  verb->footer(
      "PSNR, SSIM and FLIP are of what a display shows: exposed, clipped, sRGB. HDR-FLIP takes the exposures that the reference asks\n"
      "for. Relative MSE is of the exposed radiance, the largest and the mean difference of the radiance as it is.\n\n"
      "Examples:\n"
      "  brdf-render difference reference.exr candidate.exr\n"
      "  brdf-render difference reference.exr candidate.exr --exposure -1 --png both.png --json");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
