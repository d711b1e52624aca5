// SPDX-License-Identifier: Apache-2.0
#include "profile_report.h"

#include "ingest/printable_text.h"
#include "text_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace brdf::cli {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr int strip_rows = 12;  // theta_d, two bins each

double degrees_of(float radians) { return static_cast<double>(radians) * degrees; }

/// Shares of the sum.
template <class Sums>
Json shares(const Sums& sums) {
  double all = 0;
  for (const std::uint64_t s : sums) all += static_cast<double>(s);
  Json list = Json::array();
  for (const std::uint64_t s : sums) list.push_back(all > 0 ? static_cast<double>(s) / all : 0.0);
  return list;
}

/// [theta_d][theta_h], summed over phi_d.
Json over_h_d(const MaterialProfile& m) {
  Json rows = Json::array();
  const double all = std::max(m.contribution() * MaterialProfile::units, 1e-300);
  for (std::size_t d = 0; d < ProfileGrid::theta_d; ++d) {
    Json row = Json::array();
    for (std::size_t h = 0; h < ProfileGrid::theta_h; ++h) {
      double sum = 0;
      for (std::size_t p = 0; p < ProfileGrid::phi_d; ++p) sum += static_cast<double>(m.histogram[p + ProfileGrid::phi_d * (d + ProfileGrid::theta_d * h)]);
      row.push_back(sum / all);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Json material_row(const std::string& slot, const MaterialProfile& m, double share) {
  Json row;
  row["material"] = slot;
  row["share"] = share;
  row["contribution"] = m.contribution();
  row["transmitted"] = static_cast<double>(m.transmitted) / MaterialProfile::units;
  row["contributions"] = m.contributions;
  for (int k = 0; k < profile_operations; ++k) row["operations"][to_string(static_cast<ProfileOperation>(k))] = m.operations[static_cast<std::size_t>(k)];
  row["footprint_pixels"] = m.footprint_pixels();
  row["first_hits"] = m.first_hits;
  const bool any = m.range_i.least <= m.range_i.most;
  row["theta_i"] = any ? Json{degrees_of(m.range_i.least), degrees_of(m.range_i.most)} : Json();
  row["theta_o"] = any ? Json{degrees_of(m.range_o.least), degrees_of(m.range_o.most)} : Json();
  row["cells"] = std::count_if(m.histogram.begin(), m.histogram.end(), [](std::uint64_t c) { return c > 0; });
  row["theta_i_shares"] = shares(m.theta_i);
  row["theta_o_shares"] = shares(m.theta_o);
  row["phi_h_shares"] = shares(m.phi_h);
  row["theta_d_theta_h_shares"] = over_h_d(m);
  return row;
}

std::string range(const Json& angles) {
  return angles.is_null() ? "-" : fixed(angles[0], 1) + " to " + fixed(angles[1], 1);
}

/// Logarithmic shades, ten of them over four decades below the largest.
std::string strip(const Json& shares) {
  constexpr std::string_view shade = " .:-=+*#%@";
  std::vector<std::vector<double>> sums(strip_rows, std::vector<double>(ProfileGrid::theta_h, 0.0));
  double largest = 0;
  for (std::size_t d = 0; d < shares.size(); ++d)
    for (std::size_t h = 0; h < shares[d].size(); ++h) {
      double& s = sums[d * strip_rows / shares.size()][h];
      s += shares[d][h].get<double>();
      largest = std::max(largest, s);
    }
  if (!(largest > 0)) return "";
  std::string text;
  for (std::size_t i = 0; i < strip_rows; ++i) {
    const double edge = ProfileGrid::theta_d_edge(static_cast<int>(i) * ProfileGrid::theta_d / strip_rows) * degrees;
    std::string label = fixed(edge, 0);
    text += "  theta_d " + std::string(3 - std::min<std::size_t>(label.size(), 3), ' ') + label + " |";
    for (const double s : sums[i]) {
      const double level = s > 0 ? 9 + 9 * std::log10(s / largest) / 4 : 0;
      text += shade[static_cast<std::size_t>(std::clamp(std::lround(level), s > 0 ? 1L : 0L, 9L))];
    }
    text += "|\n";
  }
  std::string axis = "  theta_h      ";
  for (const int i : {0, 12, 24, 36}) {
    std::string label = significant(ProfileGrid::theta_h_edge(i) * degrees, 2);
    label.resize(12, ' ');
    axis += label;
  }
  return text + axis + "90\n";
}

}  // namespace

Json profile_rows(const Profile& profile) {
  Json rows = Json::array();
  for (const auto& [slot, asked] : profile.materials) rows.push_back(material_row(slot, asked, profile.share(slot)));
  std::stable_sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) { return a["share"].get<double>() > b["share"].get<double>(); });
  return rows;
}

std::string profile_text(const Json& rows) {
  TextTable table;
  table.header = {"material", "share", "footprint", "eval", "sample", "pdf", "transmission", "theta_i", "theta_o", "cells"};
  const auto count = [](const Json& n) { return std::to_string(n.get<std::uint64_t>()); };
  for (const Json& r : rows) {
    const Json& o = r["operations"];
    table.rows.push_back({ingest::printable_text(r["material"].get<std::string>()), significant(100 * r["share"].get<double>()) + " %",
                          significant(r["footprint_pixels"].get<double>(), 4) + " px", count(o["eval"]), count(o["sample"]), count(o["pdf"]),
                          count(o["transmission"]), range(r["theta_i"]), range(r["theta_o"]), std::to_string(r["cells"].get<std::int64_t>())});
  }
  std::string text = table.terminal();
  for (const Json& r : rows) {
    const std::string picture = strip(r["theta_d_theta_h_shares"]);
    if (!picture.empty()) text += "\n" + ingest::printable_text(r["material"].get<std::string>()) + ", degrees; each shade is a factor of 2.8\n" + picture;
  }
  return text;
}

}  // namespace brdf::cli
