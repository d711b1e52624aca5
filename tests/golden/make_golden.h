// SPDX-License-Identifier: Apache-2.0
// The contents of data/golden: how its files were made.
#pragma once

#include "container/content.h"

#include <brdf/material.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace brdf::golden {

struct NamedContent {
  std::string name;
  container::Content content;
};

/// What the RGB files were made of: a formula on a table fine enough for its bumps.
Measurement golden_source();

/// A file of each kind that version 1 knows, compressed from formulas.
std::vector<NamedContent> make_contents();

/// One row of an expectation file: f at a pair, from a file cut after `refinements`.
struct Expectation {
  std::string level;  ///< fast, balanced, exact, or direct: the sum of the basis in double, without a table; pdf: of the stored tables
  int refinements = 0;
  Vec3f wi{0, 0, 0}, wo{0, 0, 0};
  std::vector<double> f;  ///< or the density of sampling
};

/// Fills in the values of rows as this library finds them.
void evaluate(std::span<const std::byte> bytes, std::vector<Expectation>& rows);

/// Every level, prefix and pair of a fixed list, evaluated.
std::vector<Expectation> expectations(std::span<const std::byte> bytes);

std::string to_text(const std::vector<Expectation>& rows);
std::vector<Expectation> from_text(const std::string& text);

}  // namespace brdf::golden
