// SPDX-License-Identifier: Apache-2.0
#include "row_reader.h"

#include "base/byte_reader.h"
#include "base/file_descriptor.h"
#include "exit_codes.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace brdf::cli {
namespace {

constexpr std::size_t read_step = std::size_t{1} << 18;
constexpr std::size_t longest_line = 4096;

Failure bad_row(const std::string& sentence) { return {ExitCode::bad_input, "standard input: " + sentence}; }

bool is_separator(char c) noexcept { return c == ',' || c == ' ' || c == '\t' || c == '\r'; }

/// `text` starts with a number or with something that is none; moves past it.
bool parse_number(const char*& at, const char* end, double& value) {
  if (at < end && *at == '+') ++at;
  const auto [rest, error] = std::from_chars(at, end, value);
  if (error == std::errc::result_out_of_range) {
    value = std::strtod(std::string(at, rest).c_str(), nullptr);  // 0 or infinity, as the sign of the exponent says
  } else if (error != std::errc{}) {
    return false;
  }
  at = rest;
  return at == end || is_separator(*at);
}

std::string excerpt(std::string_view line) {
  std::string text(line.substr(0, 40));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return "'" + text + (line.size() > 40 ? "...'" : "'");
}

}  // namespace

bool RowReader::fill() {
  if (ended_) return false;
  buffer_.erase(0, at_);
  at_ = 0;
  const std::size_t before = buffer_.size();
  buffer_.resize(before + read_step);
  ::ssize_t n = 0;
  do {
    n = ::read(descriptor_, buffer_.data() + before, read_step);
  } while (n < 0 && errno == EINTR);
  buffer_.resize(before + static_cast<std::size_t>(std::max<::ssize_t>(n, 0)));
  if (n < 0) throw Failure(ExitCode::bad_input, base::io_error("standard input", "read", errno).what());
  if (n == 0) ended_ = true;
  return n > 0;
}

std::size_t RowReader::read(std::span<float> out) {
  return format_ == RowFormat::csv ? read_text(out) : read_binary(out);
}

std::size_t RowReader::read_binary(std::span<float> out) {
  const std::size_t row_bytes = columns_ * sizeof(float), wanted = out.size() / columns_ * row_bytes;
  while (buffer_.size() - at_ < wanted && fill()) {
  }
  const std::size_t rows = std::min(buffer_.size() - at_, wanted) / row_bytes;
  if (rows == 0) {
    if (buffer_.size() != at_) {
      throw bad_row(std::to_string(buffer_.size() - at_) + " bytes are left after row " + std::to_string(row_) +
                    ", a row has " + std::to_string(row_bytes));
    }
    return 0;
  }
  const std::span bytes = std::as_bytes(std::span(buffer_)).subspan(at_, rows * row_bytes);
  for (std::size_t i = 0; i < rows * columns_; ++i) {
    const float v = base::load_little_endian<float>(bytes.subspan(i * sizeof(float), sizeof(float)));
    if (!std::isfinite(v)) {
      throw bad_row("row " + std::to_string(row_ + i / columns_ + 1) + " holds " + std::to_string(v) +
                    ", numbers must be finite");
    }
    out[i] = v;
  }
  at_ += rows * row_bytes;
  row_ += rows;
  return rows;
}

bool RowReader::next_line(std::string_view& line) {
  std::size_t searched = at_;
  for (;;) {
    const std::size_t end = buffer_.find('\n', searched);
    if (end != std::string::npos) {
      line = std::string_view(buffer_).substr(at_, end - at_);
      at_ = end + 1;
      break;
    }
    const std::size_t held = buffer_.size() - at_;
    if (held > longest_line) {
      throw bad_row("line " + std::to_string(line_ + 1) + " has more than " + std::to_string(longest_line) +
                    " characters; is this --format f32?");
    }
    if (!fill()) {
      if (held == 0) return false;
      line = std::string_view(buffer_).substr(at_);
      at_ = buffer_.size();
      break;
    }
    searched = at_ + held;
  }
  ++line_;
  return true;
}

void RowReader::parse(std::string_view line, std::span<float> row) const {
  const char *at = line.data(), *end = at + line.size();
  std::size_t found = 0;
  for (bool after_comma = false;;) {
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
    if (at == end && !after_comma) break;
    double value = 0;
    if (!parse_number(at, end, value)) {
      throw bad_row("line " + std::to_string(line_) + " is " + excerpt(line) + ", wanted are " +
                    std::to_string(columns_) + " numbers");
    }
    const auto number = static_cast<float>(value);
    if (!std::isfinite(number)) {
      throw bad_row("line " + std::to_string(line_) + " is " + excerpt(line) + ", numbers must be finite");
    }
    if (found < row.size()) row[found] = number;
    ++found;
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
    after_comma = at < end && *at == ',';
    if (after_comma) ++at;
  }
  if (found != columns_) {
    throw bad_row("line " + std::to_string(line_) + " has " + std::to_string(found) + " numbers, wanted are " +
                  std::to_string(columns_));
  }
}

std::size_t RowReader::read_text(std::span<float> out) {
  const std::size_t most = out.size() / columns_;
  std::size_t rows = 0;
  std::string_view line;
  while (rows < most && next_line(line)) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    parse(line, out.subspan(rows * columns_, columns_));
    ++rows;
  }
  row_ += rows;
  return rows;
}

}  // namespace brdf::cli
