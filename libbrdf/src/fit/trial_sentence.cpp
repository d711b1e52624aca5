// SPDX-License-Identifier: Apache-2.0
#include "fit/trial_sentence.h"

#include <cstdio>

namespace brdf::fit {
namespace {

std::string number(const char* format, double v) {
  char text[64];
  std::snprintf(text, sizeof text, format, v);
  return text;
}

}  // namespace

const char* kind_name(LobeKind kind) noexcept {
  switch (kind) {
    case LobeKind::lambert: return "lambert";
    case LobeKind::ggx: return "ggx";
    case LobeKind::retro_ggx: return "retro_ggx";
  }
  return "unknown";
}

std::string trial_sentence(const Trial& trial, double required) {
  std::string text = kind_name(trial.kind);
  if (trial.kind != LobeKind::lambert) text += " alpha " + number("%.3g", trial.alpha);
  if (trial.instead_of_lambert) text += " in place of lambert";
  const std::string before = number("%.1f", trial.before), after = number("%.1f", trial.after);
  switch (trial.outcome) {
    case Trial::Outcome::kept: return text + ": BIC fell from " + before + " to " + after;
    case Trial::Outcome::refused:
      return text + " refused: BIC would go from " + before + " to " + after + ", but has to fall by " +
             number("%.0f", required) + (trial.screened ? " (judged on a part of the samples)" : "");
    case Trial::Outcome::removed: break;
  }
  return text + " removed again: BIC is " + before + " without it and " + after + " with it, less than " +
         number("%.0f", required) + " apart";
}

}  // namespace brdf::fit
